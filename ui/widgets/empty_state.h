#pragma once
// What will appear here and how to get it. Honest: no pictures of data that is not there.

#include <QWidget>

#include "ui/widgets/icons.h"

class QLabel;
class QPushButton;

namespace zerodrift::ui {

class EmptyState : public QWidget {
  Q_OBJECT

 public:
  explicit EmptyState(QWidget* parent = nullptr);
  /// action may be empty: no button.
  void setContent(Icon icon, const QString& heading, const QString& sentence, const QString& action = {});
  QPushButton* action() const { return m_action; }

 Q_SIGNALS:
  void actionTriggered();

 private:
  QLabel* m_icon;
  QLabel* m_heading;
  QLabel* m_sentence;
  QPushButton* m_action;
};

}  // namespace zerodrift::ui

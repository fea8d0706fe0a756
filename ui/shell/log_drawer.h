#pragma once
// What happened, newest at the foot, copyable. Opens with Ctrl+L.

#include <QDateTime>
#include <QFrame>

#include "ui/widgets/colors.h"

class QLabel;
class QPlainTextEdit;
class QPushButton;

namespace zerodrift::ui {

class LogDrawer : public QFrame {
  Q_OBJECT

 public:
  explicit LogDrawer(QWidget* parent = nullptr);
  void append(const QDateTime& time, Judgement judgement, const QString& text);
  QString text() const;

 Q_SIGNALS:
  void closeRequested();

 protected:
  void changeEvent(QEvent* event) override;

 private:
  struct Entry {
    QDateTime time;
    Judgement judgement;
    QString text;
    int times = 1;  // told so often, one after the other
    QDateTime last{};
  };
  void retranslate();
  void showEntry(const Entry& entry, bool again = false);
  void showAll();

  QLabel* m_title;
  QPushButton* m_copy;
  QPushButton* m_close;
  QPlainTextEdit* m_lines;
  QVector<Entry> m_entries;
};

}  // namespace zerodrift::ui

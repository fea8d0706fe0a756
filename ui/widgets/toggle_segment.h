#pragma once
// Joined buttons of which exactly one is down: a time span, an axis, a view.

#include <QWidget>

class QButtonGroup;
class QHBoxLayout;

namespace zerodrift::ui {

class ToggleSegment : public QWidget {
  Q_OBJECT

 public:
  explicit ToggleSegment(QWidget* parent = nullptr);
  explicit ToggleSegment(const QStringList& items, QWidget* parent = nullptr);
  /// Keeps the current index when it still exists; emits nothing.
  void setItems(const QStringList& items);
  int currentIndex() const;
  void setCurrentIndex(int index);

 Q_SIGNALS:
  /// By the user or by setCurrentIndex, when the index really changed.
  void currentChanged(int index);

 private:
  QHBoxLayout* m_layout;
  QButtonGroup* m_group;
};

}  // namespace zerodrift::ui

#pragma once
// Titled panel: heading, small unit or count beside it, tools at the right, body below.

#include <QFrame>

class QHBoxLayout;
class QLabel;
class QVBoxLayout;

namespace zerodrift::ui {

class Card : public QFrame {
  Q_OBJECT

 public:
  explicit Card(QWidget* parent = nullptr);

  void setTitle(const QString& title);
  /// Small text right of the title: a unit, a count.
  void setSubtitle(const QString& subtitle);
  /// Buttons, segments at the right end of the heading.
  QHBoxLayout* tools() const { return m_tools; }
  QVBoxLayout* body() const { return m_body; }
  /// Plots and tables reach the card's edge; forms and text keep 16 px from it (the default).
  void setBodyMargins(int left, int top, int right, int bottom);

 private:
  QLabel* m_title;
  QLabel* m_subtitle;
  QHBoxLayout* m_tools;
  QVBoxLayout* m_body;
};

}  // namespace zerodrift::ui

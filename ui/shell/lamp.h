#pragma once
// A lamp of the footer: dot, text, state in words. A real control, so that keyboard and screen reader find it.

#include <QAbstractButton>

#include "ui/widgets/colors.h"

namespace zerodrift::ui {

class Lamp : public QAbstractButton {
  Q_OBJECT

 public:
  explicit Lamp(const QString& id, QWidget* parent = nullptr);
  /// judgement none: off. strong: the text is set heavier, for a state that matters to safety.
  void setState(const QString& text, Judgement judgement, bool strong = false);
  Judgement judgement() const { return m_judgement; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Judgement m_judgement = Judgement::none;
  bool m_strong = false;
};

}  // namespace zerodrift::ui

#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {

WrapLabel::WrapLabel(QWidget* parent) : QLabel(parent) {
  setWordWrap(true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

QSize WrapLabel::sizeHint() const {
  return minimumSizeHint();
}

QSize WrapLabel::minimumSizeHint() const {
  // Until the first layout a widget is 100 px wide: no figure to break lines by.
  return {60, text().isEmpty() ? 0 : QLabel::heightForWidth(width() > 100 ? width() : 320)};
}

void WrapLabel::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  if (event->oldSize().width() != width()) updateGeometry();
}

}  // namespace zerodrift::ui

#include "ui/widgets/fitted_text.h"

namespace zerodrift::ui {
namespace {

CutListener& cutListener() {
  static CutListener listener;
  return listener;
}

}  // namespace

QString fittedText(const QFontMetrics& metrics, const QString& text, int width_px, const QString& onHover,
                   Qt::TextElideMode mode) {
  QString shown = metrics.elidedText(text, mode, width_px);
  if (shown != text && cutListener()) cutListener()(text, onHover.contains(text));
  return shown;
}

void listenToCuts(CutListener listener) {
  cutListener() = std::move(listener);
}

}  // namespace zerodrift::ui

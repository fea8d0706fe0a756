#pragma once
// Painted text that may have to be cut. What is cut must be readable in whole on hover; a test listens to what is.

#include <QString>
#include <functional>

class QFontMetrics;

namespace zerodrift::ui {

/// The text, cut with an ellipsis where it is wider than so many pixels. onHover: what a tool tip there says.
QString fittedText(const QFontMetrics& metrics, const QString& text, int width_px, const QString& onHover,
                   Qt::TextElideMode mode = Qt::ElideRight);

/// For tests: called with every text that was cut, and whether it can be read on hover.
using CutListener = std::function<void(const QString& text, bool readable)>;
void listenToCuts(CutListener listener);

}  // namespace zerodrift::ui

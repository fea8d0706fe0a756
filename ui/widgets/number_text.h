#pragma once

#include <QString>
#include <QStringList>

namespace zerodrift::ui {

/// A number with so many decimals; what rounds to nothing has no sign: "0.0", never "-0.0".
QString fixedText(double value, int decimals);
/// "X, Y, Z" with the comma of the language.
QString listText(const QStringList& words);
/// One sentence after the other; after a full-width full stop, which brings its own room, without a space.
QString sentencesText(const QStringList& sentences);

}  // namespace zerodrift::ui

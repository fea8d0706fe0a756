#pragma once

#include <QString>

namespace zerodrift::ui {

/// A number with so many decimals; what rounds to nothing has no sign: "0.0", never "-0.0".
QString fixedText(double value, int decimals);

}  // namespace zerodrift::ui

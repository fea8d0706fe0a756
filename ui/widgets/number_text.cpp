#include "ui/widgets/number_text.h"

#include <cmath>

namespace zerodrift::ui {

QString fixedText(double value, int decimals) {
  const double least = 0.5 * std::pow(10.0, -decimals);
  return QString::number(std::abs(value) < least ? 0.0 : value, 'f', decimals);
}

}  // namespace zerodrift::ui

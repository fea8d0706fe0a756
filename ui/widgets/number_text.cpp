#include "ui/widgets/number_text.h"

#include <QCoreApplication>
#include <cmath>

namespace zerodrift::ui {

QString fixedText(double value, int decimals) {
  const double least = 0.5 * std::pow(10.0, -decimals);
  return QString::number(std::abs(value) < least ? 0.0 : value, 'f', decimals);
}

QString listText(const QStringList& words) {
  return words.join(QCoreApplication::translate("Lists", ", ", "between the words of a list"));
}

QString sentencesText(const QStringList& sentences) {
  constexpr char16_t first_full_width = 0x3000;
  QString text;
  for (const QString& sentence : sentences) {
    if (!text.isEmpty() && !sentence.isEmpty() && text.back() < QChar(first_full_width)) text += QLatin1Char(' ');
    text += sentence;
  }
  return text;
}

}  // namespace zerodrift::ui

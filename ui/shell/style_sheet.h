#pragma once
// The style sheet of the look. Widgets choose their part by the properties role, card, segment and primary.

#include <QString>

namespace zerodrift::ui {

struct Colors;

QString styleSheet(const Colors& colors);

}  // namespace zerodrift::ui

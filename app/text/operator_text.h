#pragma once
// What the person at a control without a link is to do, in words: the same in the window, on a terminal and for a
// program.

#include <QLocale>
#include <QString>

#include "core/controller/operator.h"

namespace zerodrift {

/// Figures as the locale writes them.
QString operatorText(const controller::OperatorRequest& request, const QLocale& locale = QLocale());

}  // namespace zerodrift

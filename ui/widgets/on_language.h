#pragma once
// Words that a widget sets once: said now and again whenever the language changes.

#include <functional>

class QWidget;

namespace zerodrift::ui {

void onLanguage(QWidget* widget, std::function<void()> say);

}  // namespace zerodrift::ui

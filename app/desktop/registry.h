#pragma once
// The pages of the wizard in their order, each with its presenter: one line a step.

#include <vector>

#include "app/desktop/presenter.h"

namespace zerodrift::ui {
class MainWindow;
}

namespace zerodrift::desktop {

class DemoMachine;

std::vector<Presenter*> makePages(Workbench& bench, ui::MainWindow& window, DemoMachine& demo);

}  // namespace zerodrift::desktop

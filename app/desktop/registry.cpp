#include "app/desktop/registry.h"

#include "app/desktop/steps/axis_errors_presenter.h"
#include "app/desktop/steps/calibrate_presenter.h"
#include "app/desktop/steps/compensator_presenter.h"
#include "app/desktop/steps/fit_presenter.h"
#include "app/desktop/steps/machine_presenter.h"
#include "app/desktop/steps/physics_presenter.h"
#include "app/desktop/steps/report_presenter.h"
#include "app/desktop/steps/sensors_presenter.h"
#include "app/desktop/steps/upload_presenter.h"
#include "app/desktop/steps/verify_presenter.h"
#include "app/desktop/steps/warmup_presenter.h"
#include "ui/pages/axis_page.h"
#include "ui/pages/calibrate_page.h"
#include "ui/pages/compensator_page.h"
#include "ui/pages/fit_page.h"
#include "ui/pages/machine_page.h"
#include "ui/pages/physics_page.h"
#include "ui/pages/report_page.h"
#include "ui/pages/sensors_page.h"
#include "ui/pages/upload_page.h"
#include "ui/pages/verify_page.h"
#include "ui/pages/warmup_page.h"
#include "ui/shell/main_window.h"

namespace zerodrift::desktop {
namespace {

template <class PresenterType, class PageType, class... More>
Presenter* make(Workbench& bench, ui::MainWindow& window, bool branch, More&... more) {
  auto* page = new PageType(&window);
  window.addPage(page, branch);
  return new PresenterType(bench, page, more...);
}

}  // namespace

std::vector<Presenter*> makePages(Workbench& bench, ui::MainWindow& window, DemoMachine& demo) {
  return {
      make<MachinePresenter, ui::MachinePage>(bench, window, false, demo),
      make<CalibratePresenter, ui::CalibratePage>(bench, window, false),
      make<WarmupPresenter, ui::WarmupPage>(bench, window, false),
      make<SensorsPresenter, ui::SensorsPage>(bench, window, false),
      make<FitPresenter, ui::FitPage>(bench, window, false),
      make<PhysicsPresenter, ui::PhysicsPage>(bench, window, false),
      make<UploadPresenter, ui::UploadPage>(bench, window, false),
      make<VerifyPresenter, ui::VerifyPage>(bench, window, false),
      make<ReportPresenter, ui::ReportPage>(bench, window, false),
      make<AxisErrorsPresenter, ui::AxisPage>(bench, window, true),
      make<CompensatorPresenter, ui::CompensatorPage>(bench, window, true),
  };
}

}  // namespace zerodrift::desktop

#pragma once
// The warm-up page: plan, live run, what was recorded.

#include <QUndoStack>

#include "app/desktop/run_presenter.h"
#include "core/acquisition/plan.h"

namespace zerodrift::ui {
class WarmupPage;
struct WarmupState;
}  // namespace zerodrift::ui

namespace zerodrift::desktop {

class WarmupPresenter : public RunPresenter {
  Q_OBJECT

 public:
  WarmupPresenter(Workbench& bench, ui::WarmupPage* page);
  void refresh() override;
  void forget() override;
  void tour(std::function<void(bool good)> done) override;
  void undo() override;
  void setPlan(const acquisition::Plan& plan);
  /// A further run, planned elsewhere.
  void propose(const acquisition::Plan& plan);

 Q_SIGNALS:
  void importWanted();

 private:
  void primary();
  void secondary(const QString& action);
  void start(std::function<void(bool good)> done);
  void fillRun(ui::WarmupState& state);
  void fillImported(ui::WarmupState& state, const nlohmann::json& body);
  void fillKept(ui::WarmupState& state, const nlohmann::json& body);
  void fillInterrupted(ui::WarmupState& state);
  void finishInterrupted();
  void loadPlan();
  void savePlan();
  void exportRun();

  ui::WarmupPage* m_page;
  std::vector<acquisition::Plan> m_presets;
  acquisition::Plan m_plan;
  std::vector<acquisition::Plan> m_undo;
  int m_preset = 0;
  std::optional<flow::RecordedRun> m_interrupted;  // as it was drawn last
};

}  // namespace zerodrift::desktop

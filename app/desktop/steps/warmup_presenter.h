#pragma once
// The warm-up page: plan, live run, what was recorded.

#include <QUndoStack>

#include "app/desktop/run_presenter.h"
#include "core/acquisition/plan.h"
#include "core/flow/steps/recordings_step.h"

namespace zerodrift::ui {
class WarmupPage;
enum class RecordingUse;
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
  /// The same, planned here.
  void planFurtherRun();
  /// Beside the run of a job from files only.
  void addRecording(const recording::Recording& run, const QString& name, const nlohmann::json& how,
                    ui::RecordingUse use);

 Q_SIGNALS:
  void importWanted();

 private:
  void primary();
  void secondary(const QString& action);
  void start(std::function<void(bool good)> done) override;
  Result<std::optional<flow::RecordedRun>> readInterrupted() const override;
  const acquisition::Plan& comingPlan();
  void fillRun(ui::WarmupState& state);
  void fillImported(ui::WarmupState& state, const nlohmann::json& body);
  void fillRecordings(ui::WarmupState& state);
  void changeRecordings(const std::vector<flow::FurtherRecording>& recordings);
  void changeRecording(int index, const std::function<void(flow::FurtherRecording&)>& change);
  void wireRecordings();
  std::vector<flow::FurtherRecording> recordings() const;
  void fillKept(ui::WarmupState& state, const nlohmann::json& body);
  void fillInterrupted(ui::WarmupState& state);
  void finishInterrupted();
  void loadPlan();
  void savePlan();
  void exportRun();

  ui::WarmupPage* m_page;
  std::vector<acquisition::Plan> m_presets;
  acquisition::Plan m_plan;
  acquisition::Plan m_runningPlan;
  std::vector<acquisition::Plan> m_undo;
  int m_preset = 0;
  int m_recording = 0;  // that is shown; 0: the run itself
  std::vector<std::vector<flow::FurtherRecording>> m_recordingsBefore;
};

}  // namespace zerodrift::desktop

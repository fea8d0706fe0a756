#pragma once
// The sensors page: clusters, correlations, which sensors are kept.

#include <optional>

#include "app/desktop/presenter.h"
#include "core/flow/steps/sensors_step.h"

namespace zerodrift::ui {
class SensorsPage;
struct SensorsState;
}  // namespace zerodrift::ui

namespace zerodrift::desktop {

class SensorsPresenter : public Presenter {
  Q_OBJECT

 public:
  SensorsPresenter(Workbench& bench, ui::SensorsPage* page);
  void refresh() override;
  void forget() override;
  void enter() override;
  void tour(std::function<void(bool good)> done) override;
  void undo() override;

 private:
  /// What the job's choice was asked for; the defaults without one.
  flow::SensorsOptions asked();
  /// For Ctrl+Z: what is chosen now, before it is changed.
  void rememberChoice();
  void run(const flow::SensorsOptions& options, std::function<void(bool good)> done);
  std::vector<std::string> errorsOf(const nlohmann::json& body) const;
  void fill(ui::SensorsState& state, const nlohmann::json& body) const;
  QString proposalInWords(const nlohmann::json& body) const;
  QString conditionInWords(const nlohmann::json& condition, int proposed, bool oneCycle) const;
  void fillSeries(ui::SensorsState& state) const;

  ui::SensorsPage* m_page;
  std::optional<bool> m_absolute;  // which sum is shown; none: the one that the clusters were judged by
  std::vector<flow::SensorsOptions> m_undo;
};

}  // namespace zerodrift::desktop

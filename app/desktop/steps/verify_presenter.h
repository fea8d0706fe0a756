#pragma once
// The verify page: the compensated run live, figures before and after, the correction and its upload.

#include "app/desktop/presenter.h"
#include "app/desktop/run_feed.h"
#include "core/flow/steps/verify_step.h"

namespace zerodrift::ui {
class VerifyPage;
struct VerifyState;
}  // namespace zerodrift::ui

namespace zerodrift::desktop {

class VerifyPresenter : public Presenter {
  Q_OBJECT

 public:
  VerifyPresenter(Workbench& bench, ui::VerifyPage* page);
  void refresh() override;
  void tour(std::function<void(bool good)> done) override;

 Q_SIGNALS:
  /// Writes the table (it asks first) and tells how that ended.
  void correctionWanted(const zerodrift::compensation::Table& table, std::function<void(bool good)> done);

 private:
  void primary();
  void secondary(const QString& action);
  void start(std::function<void(bool good)> done);
  void applyCorrection(std::function<void(bool good)> done);
  void fillRun(ui::VerifyState& state);
  void fillResult(ui::VerifyState& state, const nlohmann::json& body);
  void fillCorrection(ui::VerifyState& state);
  void showKept(const nlohmann::json& body);
  void compute(long long verification);

  ui::VerifyPage* m_page;
  RunFeed* m_feed;
  double m_threshold_um;
  bool m_running = false;
  bool m_again = false;
  bool m_skipped = false;
  long long m_shown = 0;     // series drawn now
  long long m_computed = 0;  // verification the correction is of
  double m_measured_s = -1.0;
  flow::VerificationResiduals m_residuals;
  std::optional<compensation::Correction> m_correction;
};

}  // namespace zerodrift::desktop

#pragma once
// The verify page: the compensated run live, figures before and after, the correction and its upload.

#include <QTimer>

#include "app/desktop/run_presenter.h"
#include "core/flow/steps/verify_step.h"
#include "ui/pages/verify_page.h"

namespace zerodrift::desktop {

class VerifyPresenter : public RunPresenter {
  Q_OBJECT

 public:
  VerifyPresenter(Workbench& bench, ui::VerifyPage* page);
  void refresh() override;
  void forget() override;
  /// A run that failed is no step that is done; one that left more than was promised is done, with a mark.
  Standing standing() const override;
  void tour(std::function<void(bool good)> done) override;

 Q_SIGNALS:
  /// Writes the table (it asks first) and tells how that ended.
  void correctionWanted(const zerodrift::compensation::Table& table, std::function<void(bool good)> done);
  /// Going back to this version is to be looked at, where transactions are.
  void rollbackWanted(int version);
  /// A further warm-up run is to be planned.
  void furtherRunWanted();

 private:
  void primary();
  void secondary(const QString& action);
  void start(std::function<void(bool good)> done) override;
  Result<std::optional<flow::RecordedRun>> readInterrupted() const override;
  void finishInterrupted();
  void fillInterrupted(ui::VerifyState& state);
  void applyCorrection(std::function<void(bool good)> done);
  void fillRun(ui::VerifyState& state);
  void fillResult(ui::VerifyState& state, const nlohmann::json& body);
  void fillCorrection(ui::VerifyState& state);
  void compare(const nlohmann::json& body);
  void fillAxes(ui::VerifyState& state, const nlohmann::json& body);
  void compute(const commissioning::Artefact& verification);
  void fillCurves(const std::string& axis, ui::AxisCorrection& row) const;
  /// The correction of the kept run by the threshold that is set now, into the job: page and report say the same.
  void judgeAgain();
  bool ofAnotherTable();

  ui::VerifyPage* m_page;
  QTimer m_judging;       // the threshold rests before it is used
  double m_threshold_um;  // of a part error, above which a correction is proposed
  bool m_skipped = false;
  long long m_computed = 0;  // verification the correction is of
  flow::VerificationResiduals m_residuals;
  std::optional<compensation::Table> m_corrected;
  QVector<ui::AxisResult> m_axes;  // of the verification m_axesOf
  long long m_axesOf = 0;
  double m_compared_s = 0.0;
  bool m_sameRun = false;
};

}  // namespace zerodrift::desktop

#pragma once
// The fit page: measured against predicted, the methods compared, what can be attained.

#include "app/desktop/presenter.h"

namespace zerodrift::ui {
class FitPage;
struct FitState;
}  // namespace zerodrift::ui

namespace zerodrift::desktop {

class FitPresenter : public Presenter {
  Q_OBJECT

 public:
  FitPresenter(Workbench& bench, ui::FitPage* page);
  void refresh() override;
  void forget() override { m_undo.clear(); }
  void enter() override;
  void tour(std::function<void(bool good)> done) override;
  void undo() override;
  /// The model of the job corrected by a recording (CSV) of a newer, short run.
  void update(const std::string& recording, std::function<void(bool good)> done);

 private:
  void run(const std::string& method, std::function<void(bool good)> done);
  void fill(ui::FitState& state);
  /// The method that the job's model was asked for; "auto" without one.
  std::string asked();

  ui::FitPage* m_page;
  std::vector<std::string> m_undo;  // methods asked for before
};

}  // namespace zerodrift::desktop

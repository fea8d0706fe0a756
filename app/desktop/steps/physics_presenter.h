#pragma once
// The physics page: simulation over recording, where heat is missing, what explains it, blind trials.

#include "app/desktop/physics_search.h"
#include "app/desktop/presenter.h"
#include "core/acquisition/plan.h"

namespace zerodrift::ui {
class PhysicsPage;
struct PhysicsState;
}  // namespace zerodrift::ui

namespace zerodrift::desktop {

class PhysicsPresenter : public Presenter {
  Q_OBJECT

 public:
  PhysicsPresenter(Workbench& bench, ui::PhysicsPage* page);
  void refresh() override;
  void tour(std::function<void(bool good)> done) override;

 Q_SIGNALS:
  /// The run that would decide between rivals, for the plan editor.
  void planProposed(const zerodrift::acquisition::Plan& plan);

 private:
  void find(std::function<void(bool good)> done);
  void judge(const QString& effect, bool adopt, bool reject);
  void tryBlind();
  void proposePlan();

  ui::PhysicsPage* m_page;
  int m_component = 0;
  int m_nextTrial = 1;
  std::vector<Trial> m_trials;
};

}  // namespace zerodrift::desktop

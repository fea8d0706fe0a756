#pragma once
// The sensors page: clusters, correlations, which sensors are kept.

#include <optional>

#include "app/desktop/presenter.h"

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
  void enter() override;
  void tour(std::function<void(bool good)> done) override;
  void undo() override;

 private:
  struct Choice {
    int clusters = 5;
    std::vector<std::string> chosen;  // by hand; empty: as proposed
  };
  /// For Ctrl+Z: what is chosen now, before it is changed.
  void rememberChoice();
  void run(int clusters, const std::vector<std::string>& chosen, std::function<void(bool good)> done);
  void fill(ui::SensorsState& state, const nlohmann::json& body) const;
  void fillSeries(ui::SensorsState& state) const;

  ui::SensorsPage* m_page;
  int m_clusters = 5;
  std::optional<bool> m_absolute;  // which sum is shown; none: the one that the clusters were judged by
  std::vector<Choice> m_undo;
};

}  // namespace zerodrift::desktop

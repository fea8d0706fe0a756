#pragma once
// The page of the host compensator: starts it after a question, shows every turn, stops it.

#include <QTimer>
#include <memory>

#include "app/desktop/presenter.h"
#include "core/flow/live_compensation.h"
#include "ui/pages/compensator_page.h"

namespace zerodrift::desktop {

class CompensatorPresenter : public Presenter {
  Q_OBJECT

 public:
  CompensatorPresenter(Workbench& bench, ui::CompensatorPage* page);
  void refresh() override;
  void forget() override;
  Standing standing() const override;
  void tour(std::function<void(bool good)> done) override { done(true); }
  bool running() const { return m_running; }

 protected:
  bool cancellable() const override { return false; }  // Stop is the page's own button

 private:
  struct Shared;
  void start();
  bool agreed(bool signs_seen);
  bool signsSeen() const;
  void drain();
  void forgetMeasured();
  void ended(const Result<controller::CompensatorSummary>& summary);

  ui::CompensatorPage* m_page;
  ui::CompensatorState m_state;
  std::shared_ptr<Shared> m_shared;
  QTimer m_timer;
  bool m_running = false;
};

}  // namespace zerodrift::desktop

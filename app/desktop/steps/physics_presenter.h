#pragma once
// The physics page: simulation over recording, where heat is missing, what explains it, blind trials.

#include <QTimer>

#include "app/desktop/physics_search.h"
#include "app/desktop/physics_view.h"
#include "app/desktop/presenter.h"
#include "core/acquisition/plan.h"
#include "ui/pages/physics_page.h"

namespace zerodrift::desktop {

class MachineForm;

class PhysicsPresenter : public Presenter {
  Q_OBJECT

 public:
  PhysicsPresenter(Workbench& bench, ui::PhysicsPage* page);
  void refresh() override;
  void forget() override;
  void tour(std::function<void(bool good)> done) override;
  void undo() override;
  /// Takes the description of the machine from this file into the job.
  void describe(const QString& path);

 Q_SIGNALS:
  /// The run that would decide between rivals, for the plan editor.
  void planProposed(const zerodrift::acquisition::Plan& plan);

 private:
  void find(std::function<void(bool good)> done);
  void takeDescription(const nlohmann::json& machine, const QString& file);
  void chooseDescription();
  void describeByLumps();
  void describeByForm();
  void judge(const QString& effect, bool adopt, bool reject);
  void keepJudgements(const Judgements& judgements);
  void tryBlind();
  void watchTrial();
  void searchTrial();
  void openTrial();
  void fillTrials(ui::PhysicsState& state) const;
  void proposePlan();
  void findRegion();
  QString regionInWords();
  const Compared& compared();

  ui::PhysicsPage* m_page;
  MachineForm* m_form = nullptr;
  int m_component = 0;
  bool m_regionAsked = false;
  std::vector<Judgements> m_undo;
  Compared m_compared;
  std::pair<long long, long long> m_comparedOf;  // warm-up and physics artefact it was read from
  // The blind trial on the screen, and those that were opened.
  QTimer m_watching;
  TrialCase m_trial;
  TrialAnswer m_trialAnswer;
  ui::BlindTrial m_shownTrial;  // without its words
  struct FinishedTrial {
    std::string hidden, answer;  // ids: the language may change
    double improvement_percent = 0.0;
  };
  QVector<FinishedTrial> m_finishedTrials;
};

}  // namespace zerodrift::desktop

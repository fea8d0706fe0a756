#include "app/desktop/steps/physics_presenter.h"

#include <QCoreApplication>
#include <QDir>
#include <algorithm>
#include <cmath>

#include "app/desktop/physics_view.h"
#include "core/flow/steps/diagnose_step.h"
#include "ui/pages/physics_page.h"

namespace zerodrift::desktop {

using nlohmann::json;

namespace {

ui::PhysicsVerdict verdict_of(const std::string& name) {
  if (name == "consistent") return ui::PhysicsVerdict::consistent;
  if (name == "missing_effect") return ui::PhysicsVerdict::missingEffect;
  return ui::PhysicsVerdict::unexplained;
}

/// Root mean square over the temperatures of {channel: rms}; NaN when there is none.
double over_temperatures(const json& by_channel) {
  double sum = 0.0;
  int count = 0;
  for (const auto& [channel, value] : by_channel.items()) {
    if (!value.is_number() || recording::kind_of(channel) != recording::ChannelKind::temperature) continue;
    sum += value.get<double>() * value.get<double>();
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : std::nan("");
}

void fill_search(const json& body, ui::PhysicsState& state) {
  const json diagnosis = body.at("diagnosis");
  state.verdict = verdict_of(diagnosis.value("verdict", ""));
  state.verdictSentence = sentences_of(diagnosis);
  const json experiment = diagnosis.value("suggested_experiment", json());
  if (experiment.is_object())
    state.nextExperiment = sentence_of(experiment.value("said", json()), experiment.value("text", ""));
  const json rmse = diagnosis.value("rmse", json::object());
  state.noise_K = over_temperatures(rmse.value("noise", json::object()));
  const bool adopted = !body.value("adopted", json::array()).empty();
  state.rmse_K = over_temperatures(rmse.value(adopted ? "after" : "before", json::object()));
  state.held_K = over_temperatures(rmse.value("held_out_after", json::object()));
  if (state.verdict != ui::PhysicsVerdict::consistent) {
    state.missing_W = diagnosis.value("mismatch", json::object()).value("missing_heat_W", std::nan(""));
  }
}

}  // namespace

PhysicsPresenter::PhysicsPresenter(Workbench& bench, ui::PhysicsPage* page) : Presenter(bench, page), m_page(page) {
  connect(page, &ui::PhysicsPage::componentChosen, this, [this](int index) {
    m_component = index;
    refresh();
  });
  connect(page, &ui::PhysicsPage::adopted, this,
          [this](const QString& effect, bool adopt) { judge(effect, adopt, false); });
  connect(page, &ui::PhysicsPage::rejected, this, [this](const QString& effect) { judge(effect, false, true); });
  connect(page, &ui::PhysicsPage::experimentRequested, this, &PhysicsPresenter::proposePlan);
  connect(page, &ui::Page::primaryTriggered, this, [this] {
    if (m_page->state().verdict == ui::PhysicsVerdict::none) {
      find({});
    } else {
      Q_EMIT nextRequested();
    }
  });
  connect(page, &ui::Page::secondaryTriggered, this, [this](const QString& action) {
    if (action == QStringLiteral("trial")) {
      tryBlind();
    } else if (action == QStringLiteral("region") && this->bench().has("physics")) {
      m_page->showView(0);
    } else {
      find({});
    }
  });
}

void PhysicsPresenter::find(std::function<void(bool good)> done) {
  const auto* job = bench().job();
  if (job == nullptr) return;
  runStep(
      tr("Looking for what the simulation lacks"),
      [job](const TaskContext& context) { return flow::find_missing(*job, context); }, std::move(done));
}

void PhysicsPresenter::judge(const QString& effect, bool adopt, bool reject) {
  if (bench().job() == nullptr) return;
  const auto made = judged(*bench().job(), effect.toStdString(), adopt, reject);
  const Status kept = made ? bench().keep(*made) : Status(fail(made.error()));
  if (!kept) show(kept.error());
}

void PhysicsPresenter::tryBlind() {
  m_page->showView(2);
  const QString program = QDir(QCoreApplication::applicationDirPath()).filePath(QStringLiteral("zerodrift-machine"));
  const int seed = m_nextTrial++;
  runTask<Trial>(
      tr("Blind trial %1").arg(seed),
      [program, seed](const TaskContext& context) { return blind_trial(program, seed, context); },
      [this](Result<Trial> trial) {
        if (trial) {
          m_trials.push_back(*trial);
          bench().log(LogKind::note, tr("Blind trial: hidden %1, answered %2, seal %3")
                                         .arg(effect_name(trial->hidden), effect_name(trial->answer),
                                              trial->sealed ? tr("whole") : tr("broken")));
        }
        refresh();
      });
}

void PhysicsPresenter::proposePlan() {
  const json experiment =
      bench().body("physics").value("diagnosis", json::object()).value("suggested_experiment", json());
  if (!experiment.is_object()) return;
  const auto plan = acquisition::plan_from_json(experiment.at("plan"), "the proposed run");
  if (!plan) {
    show(plan.error());
    return;
  }
  Q_EMIT planProposed(*plan);
}

void PhysicsPresenter::refresh() {
  ui::PhysicsState state;
  const auto* job = bench().job();
  if (job == nullptr || !bench().has("warmup")) {
    state.blocked = tr("Record a warm-up run first: it is what the simulation is compared with.");
    m_page->setState(state);
    return;
  }
  const json document = bench().body("machine").value("profile", json());
  const auto profile = controller::profile_from_json(document, "the job's profile");
  if (!profile || profile->machine == nullptr) {
    state.blocked = tr("The profile holds no machine description, so there is nothing to simulate.");
    m_page->setState(state);
    return;
  }
  const auto machine = physics::machine_from_json(*profile->machine, profile->machine_file);
  if (!machine) {
    m_page->setState(state);
    show(machine.error());
    return;
  }
  const json body = bench().body("physics");
  const Compared runs = compared_of(*job);
  state.components = components_of(*machine, body);
  state.component = m_component < state.components.size() ? m_component : 0;
  state.channels = channels_of(runs, *profile, body);
  std::vector<std::string> rods;
  for (const auto& component : machine->components) {
    if (!component.lump) rods.push_back(component.id);
  }
  if (!rods.empty()) state.missingHeat = heat_of(body, *machine, rods[static_cast<std::size_t>(state.component)], runs);
  if (body.is_object()) {
    state.verdictSentence = sentences_of(body);
    state.rmse_K = over_temperatures(body.at("rmse").value("before", json::object()));
    if (body.contains("diagnosis")) {
      fill_search(body, state);
      fill_explanations(body, runs, state);
    }
  }
  for (const auto& trial : m_trials) {
    state.trials.append({effect_name(trial.hidden), effect_name(trial.answer), trial.hidden == trial.answer,
                         trial.improvement_percent});
  }
  m_page->setState(state);
}

void PhysicsPresenter::tour(std::function<void(bool good)> done) {
  find(std::move(done));
}

}  // namespace zerodrift::desktop

#include "app/desktop/steps/physics_presenter.h"

#include <QCoreApplication>
#include <QDir>
#include <QRandomGenerator>
#include <QRegularExpression>
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/desktop/physics_view.h"
#include "app/text/core_text.h"
#include "app/text/error_text.h"
#include "core/base/error_json.h"
#include "core/flow/steps/describe_step.h"
#include "core/flow/steps/diagnose_step.h"
#include "ui/pages/physics_page.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {

using nlohmann::json;

namespace {

constexpr int watch_ms = 5000;  // a run of hours is watched in so long
constexpr int watch_tick_ms = 100;
constexpr double smallest_heat_W = 0.5;

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
  const json& diagnosis = body.at("diagnosis");
  state.verdict = verdict_of(diagnosis.value("verdict", ""));
  state.verdictSentence = sentences_of(diagnosis);
  const json experiment = diagnosis.value("suggested_experiment", json());
  if (experiment.is_object()) {
    state.nextExperiment = sentence_of(experiment.value("said", json()), experiment.value("text", ""));
    state.nextIsWarmupRun = experiment.value("plan", json()).is_object();
  }
  const json rmse = diagnosis.value("rmse", json::object());
  state.noise_K = over_temperatures(rmse.value("noise", json::object()));
  const bool adopted = !body.value("adopted", json::array()).empty();
  state.rmse_K = over_temperatures(rmse.value(adopted ? "after" : "before", json::object()));
  state.adopted = adopted;
  state.held_K = over_temperatures(rmse.value(adopted ? "held_out_after" : "held_out_before", json::object()));
  if (state.verdict != ui::PhysicsVerdict::consistent) {
    const double missing_W = diagnosis.value("mismatch", json::object()).value("missing_heat_W", std::nan(""));
    if (std::abs(missing_W) >= smallest_heat_W) state.missing_W = missing_W;  // else it is no heat that is missing
  }
}

/// The letters of formulas, "g = -5.1 µm/K", say nothing to who does not know the formula; the unit tells what it is.
QString without_letters(QString text) {
  static const QRegularExpression letter(
      QStringLiteral("(?<![\\w])[\\p{L}][\\p{L}_]{0,2}(\\([^()]*\\))? = (?=[-+−]?\\d)"));
  return text.remove(letter);
}

}  // namespace

PhysicsPresenter::PhysicsPresenter(Workbench& bench, ui::PhysicsPage* page) : Presenter(bench, page), m_page(page) {
  m_watching.setInterval(watch_tick_ms);
  connect(&m_watching, &QTimer::timeout, this, &PhysicsPresenter::watchTrial);
  connect(page, &ui::PhysicsPage::componentChosen, this, [this](int index) {
    m_component = index;
    refresh();
  });
  connect(page, &ui::PhysicsPage::adopted, this,
          [this](const QString& effect, bool adopt) { judge(effect, adopt, false); });
  connect(page, &ui::PhysicsPage::rejected, this, [this](const QString& effect) { judge(effect, false, true); });
  connect(page, &ui::PhysicsPage::experimentRequested, this, &PhysicsPresenter::proposePlan);
  connect(page, &ui::Page::emptyActionTriggered, this, &PhysicsPresenter::describeByForm);
  connect(page, &ui::Page::primaryTriggered, this, [this] {
    if (m_page->state().undescribed) return describeByForm();
    if (m_page->state().verdict == ui::PhysicsVerdict::none) {
      find({});
    } else {
      Q_EMIT nextRequested();
    }
  });
  connect(page, &ui::Page::secondaryTriggered, this, [this](const QString& action) {
    if (action == QStringLiteral("open")) {
      m_page->showView(2);
      openTrial();
    }
    if (action == QStringLiteral("describe")) describeByForm();
    if (action == QStringLiteral("load")) chooseDescription();
    if (action == QStringLiteral("lumps")) describeByLumps();
    if (action == QStringLiteral("trial")) tryBlind();
    if (action == QStringLiteral("region")) findRegion();
    if (action == QStringLiteral("find")) find({});
  });
}

void PhysicsPresenter::forget() {
  m_component = 0;
  m_regionAsked = false;
  m_undo.clear();
  m_compared = {};
  m_comparedOf = {};
  m_watching.stop();
  m_trial = {};
  m_trialAnswer = {};
  m_shownTrial = {};
  m_finishedTrials.clear();
}

void PhysicsPresenter::find(std::function<void(bool good)> done) {
  if (bench().job() == nullptr) return;
  m_undo.clear();  // judgements of explanations that are made anew
  runStep(
      tr("Looking for what the simulation lacks"),
      [](commissioning::Job& job, const TaskContext& context) { return flow::find_missing(job, context); },
      std::move(done));
}

/// The region is computed with the simulation; here it is brought before the eyes, on its component and in words.
void PhysicsPresenter::findRegion() {
  if (!bench().has("physics")) {
    find([this](bool good) {
      if (good) findRegion();
    });
    return;
  }
  m_regionAsked = true;
  m_page->showView(0);
  const json placement = bench().body("physics").value("placement", json());
  const auto& components = m_page->state().components;
  for (int i = 0; placement.is_object() && i < components.size(); ++i) {
    if (components[i].regionTo_mm > components[i].regionFrom_mm) m_component = i;
  }
  refresh();
}

QString PhysicsPresenter::regionInWords() {
  const json placement = bench().body("physics").value("placement", json());
  if (!placement.is_object()) {
    return tr("No sensor region could be found: the machine description has no rod whose deformation was simulated.");
  }
  const double middle_mm = 0.5 * (placement.value("from_mm", 0.0) + placement.value("to_mm", 0.0));
  json best = json::object();
  double nearest_mm = std::numeric_limits<double>::infinity();
  const json along = placement.value("along", json::array());
  for (const auto& place : along) {
    const double distance_mm = std::abs(place.value("position_mm", 0.0) - middle_mm);
    if (distance_mm < nearest_mm) best = place, nearest_mm = distance_mm;
  }
  QString words = tr("A sensor between %1 and %2 mm from the fixed end of the %3 follows the deformation best")
                      .arg(placement.value("from_mm", 0.0), 0, 'f', 1)
                      .arg(placement.value("to_mm", 0.0), 0, 'f', 1)
                      .arg(coreText(placement.value("component", "component")));
  if (best.contains("correlation") && best["correlation"].is_number()) {
    words += tr(" (r = %1").arg(best["correlation"].get<double>(), 0, 'f', 4);
    if (best.contains("residual_um") && best["residual_um"].is_number()) {
      words += tr(", %1 µm left by a straight line").arg(best["residual_um"].get<double>(), 0, 'f', 2);
    }
    words += QLatin1Char(')');
  }
  return tr("%1.", "a whole sentence").arg(words);
}

void PhysicsPresenter::judge(const QString& effect, bool adopt, bool reject) {
  const Judgements before = judgements_of(bench().body("physics"));
  Judgements after = before;
  const std::string id = effect.toStdString();
  const auto put = [&id](std::vector<std::string>& ids, bool inside) {
    std::erase(ids, id);
    if (inside) ids.push_back(id);
  };
  put(after.adopted, adopt);
  put(after.rejected, reject);
  m_undo.push_back(before);
  keepJudgements(after);
}

void PhysicsPresenter::keepJudgements(const Judgements& judgements) {
  const auto kept = bench().takeIn(
      "physics", [&judgements](commissioning::Job& job, const TaskContext&) { return judged(job, judgements); });
  if (!kept) show(kept.error());
}

void PhysicsPresenter::undo() {
  if (m_undo.empty()) return;
  const Judgements before = m_undo.back();
  m_undo.pop_back();
  keepJudgements(before);
}

void PhysicsPresenter::tryBlind() {
  m_page->showView(2);
  const QString program = QDir(QCoreApplication::applicationDirPath()).filePath(QStringLiteral("zerodrift-machine"));
  const int seed = QRandomGenerator::global()->bounded(1, 1 << 20);  // nobody knows what will be hidden
  runTask<TrialCase>(
      tr("Blind trial"), [program, seed](const TaskContext& context) { return make_trial(program, seed, context); },
      [this](Result<TrialCase> made) {
        if (!made) return;
        m_trial = std::move(*made);
        m_shownTrial = {};
        m_shownTrial.stage = ui::TrialStage::sealed;
        m_shownTrial.seal = QString::fromStdString(m_trial.seal);
        m_shownTrial.curves = trial_curves(m_trial.recorded, m_trial.simulated, {});
        m_shownTrial.shown = 0.0;
        bench().log(LogKind::note, tr("Blind trial: sealed %1").arg(m_shownTrial.seal));
        m_watching.start();
        refresh();
      });
}

void PhysicsPresenter::watchTrial() {
  m_shownTrial.shown = std::min(1.0, m_shownTrial.shown + static_cast<double>(watch_tick_ms) / watch_ms);
  if (m_shownTrial.shown >= 1.0) {
    m_watching.stop();
    whenIdle([this] {
      if (m_shownTrial.stage == ui::TrialStage::sealed) searchTrial();  // it may be forgotten by then
    });
  }
  refresh();
}

void PhysicsPresenter::searchTrial() {
  m_shownTrial.stage = ui::TrialStage::searching;
  refresh();
  runTask<TrialAnswer>(
      tr("Searching what is hidden"),
      [trial = m_trial](const TaskContext& context) { return answer_trial(trial, context); },
      [this](Result<TrialAnswer> answer) {
        m_shownTrial.stage = answer ? ui::TrialStage::answered : ui::TrialStage::none;
        if (answer) {
          m_trialAnswer = std::move(*answer);
          m_shownTrial.curves = trial_curves(m_trial.recorded, m_trial.simulated, m_trialAnswer.refined);
        }
        refresh();
      });
}

void PhysicsPresenter::openTrial() {
  const auto opened = open_trial(m_trial);
  if (!opened) {
    show(opened.error());
    return;
  }
  m_shownTrial.stage = ui::TrialStage::opened;
  m_shownTrial.kept = opened->kept;
  m_finishedTrials.append({opened->hidden, m_trialAnswer.effects, m_trialAnswer.improvement_percent});
  bench().log(LogKind::note, tr("Blind trial: hidden %1, answered %2, seal %3")
                                 .arg(effect_name(opened->hidden), effects_in_words(m_trialAnswer.effects),
                                      opened->kept ? tr("whole") : tr("broken")));
  refresh();
}

void PhysicsPresenter::proposePlan() {
  const json& body = bench().body("physics");
  if (!body.is_object()) return;
  const json experiment = body.value("diagnosis", json::object()).value("suggested_experiment", json());
  if (!experiment.is_object()) return;
  const auto plan = acquisition::plan_from_json(experiment.at("plan"), "the proposed run");
  if (!plan) {
    show(plan.error());
    return;
  }
  Q_EMIT planProposed(*plan);
}

/// The curves of whole runs stand in the job as text: they are read when there are others, not each time.
const Compared& PhysicsPresenter::compared() {
  const auto id_of = [this](const char* kind) -> long long {
    const auto latest = bench().job()->latest(kind);
    return latest && *latest ? (*latest)->id : 0;
  };
  const std::pair of(id_of("warmup"), id_of("physics"));
  if (of != m_comparedOf) m_compared = compared_of(*bench().job(), bench().warmupRun());
  m_comparedOf = of;
  return m_compared;
}

void PhysicsPresenter::refresh() {
  ui::PhysicsState state;
  const auto job = bench().job();
  if (job == nullptr || !bench().has("warmup")) {
    state.blocked = tr("Record a warm-up run first: it is what the simulation is compared with.");
    m_page->setState(state);
    return;
  }
  const auto described = flow::description_of(*job);
  if (!described || !*described) {
    state.undescribed = true;
    m_page->setState(state);
    if (!described) show(described.error());
    return;
  }
  state.description = QFileInfo(QString::fromStdString((*described)->file)).fileName();
  const auto machine = physics::machine_from_json((*described)->machine, (*described)->file);
  if (!machine) {
    m_page->setState(state);
    show(machine.error());
    return;
  }
  const json& body = bench().body("physics");
  const Compared& runs = compared();
  state.components = components_of(*machine, body);
  state.component = m_component < state.components.size() ? m_component : 0;
  state.channels = channels_of(runs, *machine, body);
  for (auto& channel : state.channels) channel.tag = bench().tagOf(channel.id.toStdString());
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
    for (const auto& problem : body.value("problems", json::array())) {
      const auto error = error_from_json(problem);
      if (!error) continue;
      state.verdictSentence =
          ui::sentencesText({state.verdictSentence, tr("What the simulation lacks was not searched."), lineOf(*error)});
    }
  }
  if (m_regionAsked && body.is_object()) state.region = regionInWords();
  const auto plain = [this](QString& text) { text = without_letters(bench().inWords(text.toStdString())); };
  plain(state.verdictSentence);
  plain(state.nextExperiment);
  for (auto& card : state.explanations) {
    for (QString* text : {&card.sentence, &card.magnitude, &card.rivals, &card.couldDetect}) plain(*text);
  }
  fillTrials(state);
  m_page->setState(state);
}

void PhysicsPresenter::fillTrials(ui::PhysicsState& state) const {
  for (const auto& finished : m_finishedTrials) {
    state.trials.append({effect_name(finished.hidden), effects_in_words(finished.answer),
                         same_effect(finished.hidden, finished.answer), finished.improvement_percent});
  }
  state.trial = m_shownTrial;
  const bool opened = m_shownTrial.stage == ui::TrialStage::opened;
  if (opened || m_shownTrial.stage == ui::TrialStage::answered) {
    state.trial.answer = effects_in_words(m_trialAnswer.effects);
    if (m_trialAnswer.confidence > 0) {
      state.trial.answer += tr(", %1 %").arg(100.0 * m_trialAnswer.confidence, 0, 'f', 0);
    }
  }
  if (opened) {
    state.trial.hidden = state.trials.last().effect;
    state.trial.right = state.trials.last().right;
  }
}

void PhysicsPresenter::tour(std::function<void(bool good)> done) {
  find(std::move(done));
}

}  // namespace zerodrift::desktop

#include "app/desktop/run_presenter.h"

#include <QInputDialog>
#include <nlohmann/json.hpp>

#include "app/desktop/ask.h"
#include "app/desktop/pin_dialog.h"
#include "ui/pages/run_view.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/progress_strip.h"

namespace zerodrift::desktop {

RunPresenter::RunPresenter(Workbench& bench, ui::Page* page, ui::RunView* view)
    : Presenter(bench, page), m_feed(new RunFeed(bench, view, this)) {
  connect(m_feed, &RunFeed::updated, this, [this] {
    if (const QString waits = waitsFor(); !waits.isEmpty()) this->page()->setWaiting(waits);
  });
}

const std::optional<flow::RecordedRun>& RunPresenter::interrupted() {
  if (m_interrupted || bench().job() == nullptr || m_running) return m_interrupted;
  m_interrupted = readInterrupted().value_or(std::nullopt);
  return m_interrupted;
}

void RunPresenter::showInterrupted() {
  if (!m_interrupted || !showSeries(m_interrupted->series)) return;
  m_feed->showHappened(m_interrupted->happened, m_interrupted->summary.measurements, m_interrupted->summary.refused);
}

void RunPresenter::resumeToFinish() {
  connect(
      m_feed, &RunFeed::updated, this, [this] { m_feed->finish(); }, Qt::SingleShotConnection);
  start({});
}

void RunPresenter::dropInterrupted() {
  if (!m_interrupted || m_running || bench().job() == nullptr) return;
  const Status closed = bench().job()->finish_series(m_interrupted->series, commissioning::SeriesState::aborted);
  if (!closed) return show(closed.error());
  forgetRun();
  refresh();
}

QString RunPresenter::silentSince() const {
  return m_running ? m_feed->silentSince().toString(QStringLiteral("HH:mm:ss")) : QString();
}

QString RunPresenter::waitsFor() const {
  return m_running && m_feed->silentSince().isValid() ? tr("Controller lost") : QString();
}

void RunPresenter::record(const QString& name, const acquisition::Plan& plan, Step step,
                          std::function<void(bool good)> done) {
  const auto profile = bench().profile();
  if (!profile || bench().job() == nullptr || m_running) {
    if (!profile)
      show(Error{ErrorCode::step_blocked, {{"step", id().toStdString()}, {"needs", "a connected machine"}}});
    if (done) done(false);
    return;
  }
  const auto permit = permit_for(bench(), page(), name);
  if (!permit) {
    if (done) done(false);
    return;
  }
  flow::RunOptions options;
  options.plan = plan;
  options.anew = std::exchange(m_again, false);
  const auto begun = options.anew ? std::nullopt : interrupted();
  m_running = true;
  const auto stored = begun ? bench().job()->read_series(begun->series) : Result<recording::Recording>{};
  if (begun && stored) {
    m_feed->goOn(*stored, bench().job()->events(begun->series).value_or(std::vector<commissioning::Event>{}));
  } else {
    m_feed->begin();
  }
  options.observer = m_feed->observer();
  options.control = m_feed->control();
  options.cameras = m_feed->cameras();
  refresh();
  runStep(
      name,
      [profile = *profile, options, permit = *permit, step = std::move(step), questions = bench().questions()](
          commissioning::Job& job, const TaskContext& context) -> Result<commissioning::NewArtefact> {
        ZD_TRY(auto devices, flow::Devices::open(profile, true, permit, questions->of(profile, context.stop)));
        return step(job, devices, options, context);
      },
      [this, done = std::move(done)](bool good) {
        m_feed->stop();
        m_running = false;
        m_shown = 0;
        m_interrupted.reset();
        refresh();
        if (done) done(good);
      });
}

void RunPresenter::languageChanged() {
  themeChanged();
  m_shown = 0;  // the finished run is told again, in the language there is now
  Presenter::languageChanged();
}

void RunPresenter::themeChanged() {
  if (m_feed->named()) m_feed->nameChannels();  // else there is nothing yet that has a name or a colour
}

void RunPresenter::pauseOrResume() {
  if (m_feed->paused()) {
    m_feed->resume();
  } else {
    m_feed->pause();
  }
}

bool RunPresenter::agreed(const acquisition::Plan& plan) {
  double fastest_rpm = 0.0;
  bool path = false;
  bool coolant = false;
  for (const auto& step : plan.steps) {
    fastest_rpm = std::max(fastest_rpm, step.spindle_rpm);
    path = path || step.path_cycle;
    coolant = coolant || step.coolant_on;
  }
  QStringList deeds{tr("all axes go to the measuring position, again and again")};
  if (fastest_rpm > 0.0) deeds.prepend(tr("the spindle turns at up to %1 rpm").arg(fastest_rpm, 0, 'f', 0));
  if (path) deeds << tr("the axes run their path in between");
  if (coolant) deeds << tr("the coolant runs");
  return ask(page(), tr("Start the run? The machine will move."),
             tr("For %1 of machine time: %2. Is the work area clear, the door closed and the tool fit for this speed?")
                 .arg(ui::durationText(plan.duration_s()), ui::listText(deeds)),
             tr("Start"));
}

bool RunPresenter::steer(const QString& action) {
  if (action == QStringLiteral("finish")) {
    const QString text = bench().lost()
                             ? tr("The run ends here and what was recorded is kept and used. The controller does not "
                                  "answer, so nothing is stopped from here: look whether the spindle stands.")
                             : tr("The run ends here and what was recorded is kept and used. The spindle, the path and "
                                  "the coolant stop.");
    if (m_running && ask(page(), tr("Finish the run?"), text, tr("Finish"))) {
      m_feed->finish();
    }
    return true;
  }
  if (action == QStringLiteral("abort")) {
    if (m_running && ask(page(), tr("Abort the run?"),
                         tr("The machine stops and this run is not used. Its samples stay in the job, but the step "
                            "counts as not done. To keep the run, finish it instead."),
                         tr("Abort"))) {
      m_feed->abort();
    }
    return true;
  }
  if (action != QStringLiteral("note")) return false;
  const double now_s = m_feed->now().time_s;  // the run goes on while somebody writes
  const QString text = QInputDialog::getText(page(), tr("Note"), tr("What happened?"));
  if (text.isEmpty() || m_feed->note(text, now_s)) return true;
  tell([text] {
    return ui::Problem{ui::ProblemKind::warning,
                       tr("The run ended before this note was kept: %1").arg(text),
                       tr("Copy it from here if it matters."),
                       {}};
  });
  return true;
}

void RunPresenter::forget() {
  m_again = false;
  forgetRun();
}

void RunPresenter::forgetRun() {
  m_feed->forget();
  m_interrupted.reset();
  m_shown = 0;
}

void RunPresenter::showKept(const nlohmann::json& body) {
  if (!body.is_object()) return;
  m_feed->setImported(body.value("source", "") == "file");
  if (!showSeries(body.at("series").get<long long>())) return;
  m_feed->showHappened(acquisition::happenings_from_json(body.value("happened", nlohmann::json())),
                       body.value("measurements", 0), body.value("refused", 0));
}

bool RunPresenter::showSeries(long long series) {
  if (series == m_shown) return false;
  const auto run = bench().job()->read_series(series);
  if (!run) return false;
  m_shown = series;
  m_feed->showRecording(*run, bench().job()->events(series).value_or(std::vector<commissioning::Event>{}));
  return true;
}

QString RunPresenter::wallTime(double machine_s) const {
  const auto& profile = bench().profile();
  if (!profile || profile->time_factor <= 1.0 || !(machine_s >= 0.0)) return {};
  return tr("%1 on the wall").arg(ui::durationText(machine_s / profile->time_factor));
}

}  // namespace zerodrift::desktop

#include "app/desktop/run_feed.h"

#include <algorithm>
#include <cmath>

#include "app/desktop/run_words.h"
#include "app/desktop/steps/calibrate_presenter.h"
#include "app/text/core_text.h"
#include "app/text/error_text.h"
#include "app/text/happening_text.h"
#include "ui/pages/run_view.h"

namespace zerodrift::desktop {

using acquisition::RunUpdate;

namespace {

constexpr int drains_per_s = 15;
constexpr double trail_enlargement = 20.0;

/// The recorder is without its machine and asks again.
bool is_silence(const Error& problem) {
  return problem.code == ErrorCode::machine_silent || problem.code == ErrorCode::machine_link_lost ||
         problem.code == ErrorCode::machine_unreachable || problem.code == ErrorCode::machine_gateway;
}

int decimals_of(recording::ChannelKind kind) {
  switch (kind) {
    case recording::ChannelKind::temperature:
    case recording::ChannelKind::ambient:
      return 2;
    case recording::ChannelKind::error:
      return 1;
    default:
      return 0;
  }
}

}  // namespace

ui::RunChannel channel_of(const std::string& name, const QString& label) {
  const auto kind = recording::kind_of(name);
  ui::RunChannel channel;
  channel.id = QString::fromStdString(name);
  channel.tag = channel.id.section(QLatin1Char('_'), 0, 0);
  if (kind == recording::ChannelKind::error && channel.tag.startsWith(QLatin1Char('d'))) channel.tag.remove(0, 1);
  if (kind == recording::ChannelKind::ambient) channel.tag = coreText(QStringLiteral("Room"));
  channel.label = label;
  channel.unit = QString::fromUtf8(recording::unit_of(kind).data());
  if (channel.unit == QStringLiteral("C")) channel.unit = QStringLiteral("°C");
  if (channel.unit == QStringLiteral("um")) channel.unit = QStringLiteral("µm");
  channel.decimals = decimals_of(kind);
  return channel;
}

RunFeed::RunFeed(Workbench& bench, ui::RunView* view, QObject* parent) : QObject(parent), m_bench(bench), m_view(view) {
  m_timer.setInterval(1000 / drains_per_s);
  connect(&m_timer, &QTimer::timeout, this, &RunFeed::drain);
}

void RunFeed::nameChannels() {
  m_named = true;
  if (m_imported) return nameImported();
  m_view->setCameraShown(true);
  QVector<ui::RunChannel> temperatures;
  QVector<ui::RunChannel> errors;
  QVector<ui::RunChannel> inputs;
  if (const auto& profile = m_bench.profile()) {
    for (const auto& sensor : profile->sensors) {
      temperatures.append(channel_of(sensor.channel, coreText(sensor.label)));
    }
  }
  temperatures.append(channel_of("ambient_C", tr("Room")));
  // What is left of each direction first: in a low window the rest scrolls.
  for (int axis = 0; axis < 3; ++axis) {
    const std::string letter(1, "XYZ"[axis]);
    auto channel = channel_of("d" + letter + "_um", m_compensated ? tr("Left over") : tr("Error at the nose"));
    channel.color = ui::axisColor(axis);
    if (m_compensated) channel.tag = tr("%1 left").arg(QString::fromStdString(letter));
    errors.append(channel);
  }
  for (int axis = 0; m_compensated && axis < 3; ++axis) {
    const std::string letter(1, "XYZ"[axis]);
    auto channel = channel_of("without_" + letter + "_um", tr("Without the compensation"));
    channel.tag = tr("%1 without").arg(QString::fromStdString(letter));
    channel.color = ui::axisColor(axis);
    channel.dashed = true;
    errors.append(channel);
    channel = channel_of("applied_" + letter + "_um", tr("Applied by the controller"));
    channel.tag = tr("%1 applied").arg(QString::fromStdString(letter));
    channel.color = ui::mix(ui::colors().panel, ui::axisColor(axis), 0.45);
    errors.append(channel);
  }
  inputs.append(channel_of("spindle_rpm", tr("Spindle speed")));
  m_view->setChannels(temperatures, errors, inputs);
}

/// The words stand beside the line; a long note is cut there and whole in the report.
void RunFeed::mark(double at_s, const QString& text) {
  constexpr int longest = 28;
  const QString shown = text.size() > longest ? text.left(longest - 1) + QChar(0x2026) : text;
  m_marks.append({at_s, shown, ui::Judgement::none});
  std::sort(m_marks.begin(), m_marks.end(), [](const auto& one, const auto& other) { return one.at < other.at; });
  m_view->setMarks(m_marks);
}

void RunFeed::markPause(double at_s) {
  m_pauses.append(at_s);
  mark(at_s, tr("Pause"));
}

void RunFeed::forget() {
  {
    const std::scoped_lock lock(m_shared->mutex);
    m_shared->updates.clear();
    m_shared->states.clear();
  }
  m_now = {};
  m_speeds = {};
  m_longestHole_s = 0.0;
  m_lastRow_s = -1.0;
  m_largest_um = 0.0;
  m_measuredAt_s = -1.0;
  m_largestAxis.clear();
  m_received = false;
  m_silentSince = {};
  m_marks.clear();
  m_pauses.clear();
  m_pausing = false;
  m_badSensors.clear();
  m_view->clear();
  m_view->setTrouble({});
}

void RunFeed::begin() {
  forget();
  m_imported = false;
  nameChannels();
  m_timer.start();
}

void RunFeed::goOn(const recording::Recording& run, const std::vector<commissioning::Event>& events) {
  begin();
  showRecording(run, events);
  m_view->setCameraShown(true);
}

void RunFeed::stop() {
  drain();
  m_timer.stop();
  m_silentSince = {};
}

void RunFeed::noteRow(double time_s) {
  if (m_lastRow_s >= 0.0) m_longestHole_s = std::max(m_longestHole_s, time_s - m_lastRow_s);
  m_lastRow_s = time_s;
}

void RunFeed::noteErrors(const std::string& channel, double value) {
  if (recording::kind_of(channel) != recording::ChannelKind::error || (!m_imported && channel[0] != 'd')) {
    return;
  }
  if (!(std::abs(value) > m_largest_um)) return;
  m_largest_um = std::abs(value);
  m_largestAxis = m_imported ? m_bench.tagOf(channel) : QString::fromStdString(channel.substr(1, 1));
}

void RunFeed::appendCompensation(const std::vector<std::string>& names, const QVector<double>& times,
                                 const std::vector<QVector<double>>& values) {
  const auto column = [&](const std::string& name) {
    const auto at = std::find(names.begin(), names.end(), name);
    return at == names.end() ? -1 : static_cast<int>(at - names.begin());
  };
  QVector<ui::RunValue> last;
  for (const char axis : {'X', 'Y', 'Z'}) {
    const std::string letter(1, axis);
    const int applied_nm = column("applied_" + letter + "_nm");
    const int left_um = column("d" + letter + "_um");
    if (applied_nm < 0 || left_um < 0) continue;
    QVector<double> applied;
    QVector<double> measured_at;
    QVector<double> without;
    for (qsizetype r = 0; r < times.size(); ++r) {
      applied.append(values[static_cast<std::size_t>(applied_nm)][r] / 1000.0);
      const double left = values[static_cast<std::size_t>(left_um)][r];
      if (std::isnan(left) || std::isnan(applied.back())) continue;
      measured_at.append(times[r]);
      without.append(left - applied.back());  // what is left is the error plus the compensation
    }
    const QString id = QString::fromStdString("applied_" + letter + "_um");
    const QString without_id = QString::fromStdString("without_" + letter + "_um");
    m_view->append(id, times, applied);
    if (!applied.isEmpty()) last.append({id, applied.back(), {}, ui::Judgement::none});
    if (without.isEmpty()) continue;
    m_view->append(without_id, measured_at, without);
    last.append({without_id, without.back(), {}, ui::Judgement::none});
  }
  m_view->setValues(last);
}

void RunFeed::showRegimes(const recording::Recording& run) {
  const auto* speed = run.find("spindle_rpm");
  const auto* coolant = run.find("coolant_on");
  if (speed == nullptr || run.rows() < 2) return;
  QVector<ui::Regime> regimes;
  double fastest = 1000.0;
  for (std::size_t r = 0; r + 1 < run.rows(); ++r) {
    // Rounded, so that a spindle settling does not make a hundred bands.
    const double rpm = 100.0 * std::round((std::isnan(speed->values[r]) ? 0.0 : speed->values[r]) / 100.0);
    const bool wet = coolant != nullptr && coolant->values[r] > 0.5;
    fastest = std::max(fastest, rpm);
    if (!regimes.isEmpty() && regimes.back().speed_rpm == rpm && regimes.back().coolant == wet) {
      regimes.back().to_s = run.time_s[r + 1];
    } else {
      regimes.append({run.time_s[r], run.time_s[r + 1], rpm, wet});
    }
  }
  m_view->setRegimes(regimes, fastest);
}

std::function<void(const RunUpdate&)> RunFeed::observer() {
  return [shared = m_shared](const RunUpdate& update) {
    const std::scoped_lock lock(shared->mutex);
    shared->updates.push_back(update);
    if (update.measured && shared->cameras != nullptr) shared->states = shared->cameras->states();
  };
}

std::function<void(acquisition::RunControl*)> RunFeed::control() {
  return [shared = m_shared](acquisition::RunControl* control) {
    const std::scoped_lock lock(shared->mutex);
    shared->control = control;
  };
}

std::function<void(vision::CameraErrorSource*)> RunFeed::cameras() {
  return [shared = m_shared](vision::CameraErrorSource* cameras) {
    const std::scoped_lock lock(shared->mutex);
    shared->cameras = cameras;
  };
}

void RunFeed::pause() {
  const std::scoped_lock lock(m_shared->mutex);
  if (m_shared->control != nullptr) m_shared->control->pause();
}

void RunFeed::resume() {
  const std::scoped_lock lock(m_shared->mutex);
  if (m_shared->control != nullptr) m_shared->control->resume();
}

void RunFeed::finish() {
  const std::scoped_lock lock(m_shared->mutex);
  if (m_shared->control != nullptr) m_shared->control->finish();
}

void RunFeed::abort() {
  const std::scoped_lock lock(m_shared->mutex);
  if (m_shared->control != nullptr) m_shared->control->abort();
}

bool RunFeed::note(const QString& text, double time_s) {
  {
    const std::scoped_lock lock(m_shared->mutex);
    if (m_shared->control == nullptr) return false;
    m_shared->control->note(text.toStdString(), time_s);
  }
  mark(time_s, text);
  return true;
}

bool RunFeed::paused() const {
  const std::scoped_lock lock(m_shared->mutex);
  return m_shared->control != nullptr && m_shared->control->paused();
}

void RunFeed::appendRows(const std::vector<RunUpdate>& updates) {
  std::vector<std::string> names;
  QVector<double> times;
  std::vector<QVector<double>> values;
  for (const auto& update : updates) {
    if (update.row.empty()) continue;
    if (names.empty()) {
      names = update.channels;
      values.resize(names.size());
    }
    times.append(update.time_s);
    noteRow(update.time_s);
    for (std::size_t c = 0; c < names.size() && c < update.row.size(); ++c) {
      values[c].append(update.row[c]);
      noteErrors(names[c], update.row[c]);
    }
  }
  if (times.isEmpty()) return;
  QVector<ui::RunValue> last;
  for (std::size_t c = 0; c < names.size(); ++c) {
    const QString id = QString::fromStdString(names[c]);
    if (recording::kind_of(names[c]) != recording::ChannelKind::error) {
      m_view->append(id, times, values[c]);
      const auto bad = m_badSensors.find(names[c]);
      const bool good = bad == m_badSensors.end();
      last.append(
          {id, values[c].back(), good ? QString() : bad->second, good ? ui::Judgement::none : ui::Judgement::bad});
      continue;
    }
    const auto sigma = std::find(names.begin(), names.end(), sigma_channel(names[c]));
    for (qsizetype r = 0; r < times.size(); ++r) {  // errors are sparse: only what was measured makes the curve
      if (std::isnan(values[c][r])) continue;
      m_view->append(id, {times[r]}, {values[c][r]});
      const double sigma_nm =
          sigma == names.end() ? std::nan("") : values[static_cast<std::size_t>(sigma - names.begin())][r];
      last.append({id, values[c][r], uncertainty_text(sigma_nm), ui::Judgement::none});
    }
  }
  m_view->setValues(last);
  if (m_compensated) appendCompensation(names, times, values);
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (names[c] != "spindle_rpm" && names[c] != "coolant_on") continue;
    auto& channel = m_speeds.ensure(names[c]);
    channel.values.insert(channel.values.end(), values[c].begin(), values[c].end());
  }
  m_speeds.time_s.insert(m_speeds.time_s.end(), times.begin(), times.end());
  showRegimes(m_speeds);
}

void RunFeed::showPicture() {
  std::vector<vision::ViewState> states;
  {
    const std::scoped_lock lock(m_shared->mutex);
    states = m_shared->states;
  }
  if (states.empty() || states.front().frame == nullptr) return;
  const auto& view = states.front();
  ui::CameraMarks marks;
  for (std::size_t k = 0; k < view.marks.size(); ++k) {
    const auto& at = view.marks[k];
    const bool lost = k < view.references.size() && !view.references[k].ok;
    marks.references.append({QRectF(at.x, at.y, at.width, at.height), std::nullopt, lost});
  }
  if (view.location.ok) {
    marks.target = QPointF(view.location.point.x_px, view.location.point.y_px);
    marks.sigmaMajor_px = std::max(view.location.sigma_x_px, view.location.sigma_y_px);
    marks.sigmaMinor_px = std::min(view.location.sigma_x_px, view.location.sigma_y_px);
    marks.enlargement = 5000.0;
    marks.trailEnlargement = trail_enlargement;
    for (const auto& point : view.trail) {
      marks.trail.append(QPointF(view.location.point.x_px - view.location.x_px + point.x_px,
                                 view.location.point.y_px - view.location.y_px + point.y_px));
    }
    marks.message = coreText(view.lost_marks);
    marks.judgement = view.lost_marks.empty() ? ui::Judgement::ok : ui::Judgement::warn;
  } else {
    marks.message = coreText(view.problem);
    marks.judgement = ui::Judgement::warn;
  }
  m_view->setFrame(image_of(view.frame->image), marks);
}

QStringList RunFeed::inWords(const std::vector<acquisition::Happening>& happened, int measurements, int refused) const {
  QStringList lines;
  for (const auto& one : happened) lines << m_bench.inWords(textOf(one).toStdString());
  if (refused > 0) lines << tr("%1 of %2 measurements without all directions").arg(refused).arg(measurements);
  return lines;
}

void RunFeed::showTrouble() {
  ui::RunTrouble trouble;
  if (!m_now.problems.empty()) trouble.now = m_bench.inWords(lineOf(m_now.problems.front()).toStdString());
  trouble.so_far = inWords(m_now.happened, m_now.measurements, m_now.refused);
  m_view->setTrouble(trouble);
}

void RunFeed::noteSensors(const std::vector<Error>& problems) {
  m_badSensors.clear();
  for (const auto& problem : problems) {
    const auto sensor = problem.context.find("sensor");
    if (sensor == problem.context.end()) continue;
    m_badSensors[sensor->second] = markOf(problem.code);
  }
}

/// Nothing is measured in a pause: no line leads over it.
void RunFeed::beginPause(double at_s, const std::vector<std::string>& channels) {
  markPause(at_s);
  for (const auto& name : channels) {
    if (recording::kind_of(name) != recording::ChannelKind::error) continue;
    m_view->append(QString::fromStdString(name), {at_s}, {std::nan("")});
  }
}

void RunFeed::drain() {
  std::vector<RunUpdate> updates;
  {
    const std::scoped_lock lock(m_shared->mutex);
    updates.swap(m_shared->updates);
  }
  if (updates.empty()) return;
  m_received = true;
  const auto& problems = updates.back().problems;
  const bool silent = std::any_of(problems.begin(), problems.end(), is_silence);
  if (!silent) m_silentSince = {};
  if (silent && !m_silentSince.isValid()) m_silentSince = QDateTime::currentDateTime();
  m_bench.tellController(!silent);
  noteSensors(problems);
  appendRows(updates);
  for (const auto& update : updates) {
    const bool pausing = update.phase == acquisition::RunPhase::paused;
    if (pausing && !m_pausing) beginPause(update.time_s, update.channels);
    m_pausing = pausing;
  }
  bool measured = false;
  for (const auto& update : updates) {
    if (!update.measured.has_value()) continue;
    measured = true;
    m_measuredAt_s = update.time_s;
  }
  if (measured) showPicture();
  // What is lost of a run that waits for its controller is known when it answers: until then the count stands.
  const auto lost_before = m_now.lost_samples;
  m_now = std::move(updates.back());
  if (silent) m_now.lost_samples = lost_before;
  showTrouble();
  Q_EMIT updated();
}

}  // namespace zerodrift::desktop

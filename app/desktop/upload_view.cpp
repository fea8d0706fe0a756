#include "app/desktop/upload_view.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/desktop/moment.h"
#include "app/text/core_text.h"
#include "core/base/time_text.h"
#include "core/controller/table_words.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {

using compensation::Approach;
using controller::UploadState;
using nlohmann::json;

namespace {

constexpr std::size_t curve_points = 400;

struct UploadView {
  Q_DECLARE_TR_FUNCTIONS(UploadView)
};

QString name_of_sensor(const controller::Profile& profile, const std::string& channel) {
  QString name = QString::fromStdString(channel).remove(QStringLiteral("_C"));
  for (const auto& sensor : profile.sensors) {
    if (sensor.channel == channel) return name + QLatin1Char(' ') + coreText(sensor.label);
  }
  return channel == "ambient_C" ? UploadView::tr("Room") : name;
}

const compensation::AxisTable* axis_in(const compensation::Table& table, const std::string& name) {
  const auto at = table.axes.find(name);
  return at == table.axes.end() ? nullptr : &at->second;
}

QVector<ui::TableTerm> terms_of(const compensation::AxisTable* before, const compensation::AxisTable* after,
                                const controller::Profile& profile) {
  QVector<ui::TableTerm> rows;
  const auto row = [&](const QString& name, const QString& unit) -> ui::TableTerm& {
    for (auto& one : rows) {
      if (one.name == name) return one;
    }
    rows.append({name, unit});
    return rows.last();
  };
  const auto add = [&](const compensation::AxisTable* axis, bool is_new) {
    if (axis == nullptr) return;
    const auto put = [&](const QString& name, const QString& unit, double error) {
      auto& term = row(name, unit);
      (is_new ? term.after : term.before) = error;
    };
    put(UploadView::tr("Constant"), QStringLiteral("µm"), axis->offset_um);
    for (const auto& term : axis->terms)
      put(name_of_sensor(profile, term.sensor), QStringLiteral("µm/K"), term.um_per_K);
    for (const auto& point : axis->points) {
      put(UploadView::tr("Point %1 mm").arg(ui::fixedText(point.position_mm, 1)), QStringLiteral("µm"),
          point.error_up_um);
    }
  };
  add(before, false);
  add(after, true);
  return rows;
}

/// What the table's sensors read in the rows of a run.
class TableTemperatures {
 public:
  TableTemperatures(const recording::Recording& run, const compensation::Table& table) {
    for (const auto& sensor : compensation::sensors_of(table)) m_sensors.emplace_back(sensor, run.find(sensor));
  }
  const compensation::Temperatures& at(std::size_t row) {
    for (const auto& [sensor, channel] : m_sensors) {
      m_now[sensor] = channel == nullptr ? std::nan("") : channel->values[row];
    }
    return m_now;
  }

 private:
  std::vector<std::pair<std::string, const recording::Channel*>> m_sensors;
  compensation::Temperatures m_now;
};

double value_or_zero(const compensation::AxisTable* axis, double position_mm, const compensation::Temperatures& now) {
  if (axis == nullptr) return 0.0;
  return compensation::compensation_um(*axis, position_mm, Approach::up, now).value_or(std::nan(""));
}

bool has_terms(const compensation::AxisTable* axis) {
  return axis != nullptr && !axis->terms.empty();
}

void over_run(ui::AxisTable& out, const compensation::AxisTable* before, const compensation::AxisTable* after,
              const compensation::Table& old_table, const compensation::Table& new_table, double position_mm,
              const recording::Recording& run) {
  out.overTime = true;
  out.abscissa = UploadView::tr("time of the warm-up run");
  const std::size_t stride = run.rows() / curve_points + 1;
  TableTemperatures old_C(run, old_table);
  TableTemperatures new_C(run, new_table);
  for (std::size_t r = 0; r < run.rows(); r += stride) {
    const double old_um = value_or_zero(before, position_mm, old_C.at(r));
    const double new_um = value_or_zero(after, position_mm, new_C.at(r));
    if (std::isnan(old_um) || std::isnan(new_um)) continue;
    out.x.append(run.time_s[r]);
    out.before_um.append(old_um);
    out.after_um.append(new_um);
  }
}

void over_position(ui::AxisTable& out, const compensation::AxisTable* before, const compensation::AxisTable* after,
                   const compensation::Table& old_table, const compensation::Table& new_table) {
  out.abscissa = UploadView::tr("position / mm");
  std::vector<double> positions;
  for (const auto* axis : {before, after}) {
    if (axis == nullptr) continue;
    for (const auto& point : axis->points) positions.push_back(point.position_mm);
  }
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  for (const double position : positions) {
    out.x.append(position);
    out.before_um.append(value_or_zero(before, position, compensation::reference_temperatures(old_table)));
    out.after_um.append(value_or_zero(after, position, compensation::reference_temperatures(new_table)));
  }
}

QString stage_text(UploadState state) {
  switch (state) {
    case UploadState::checking:
      return UploadView::tr("Machine ready, table within its limits");
    case UploadState::saving_old:
      return UploadView::tr("Old table read and kept");
    case UploadState::switching_off:
      return UploadView::tr("Compensation off");
    case UploadState::staging:
      return UploadView::tr("New table staged");
    case UploadState::reading_back:
      return UploadView::tr("Read back and compared");
    case UploadState::announcing:
      return UploadView::tr("Count and check sum announced");
    case UploadState::committing:
      return UploadView::tr("Committed");
    case UploadState::waiting:
      return UploadView::tr("Checked by the controller");
    case UploadState::comparing:
      return UploadView::tr("Active table compared");
    case UploadState::switching_on:
      return UploadView::tr("Compensation on");
    case UploadState::ramping:
      return UploadView::tr("Ramped in");
    case UploadState::done:
      return UploadView::tr("Done");
    case UploadState::restoring:
      return UploadView::tr("Restoring the old table");
    case UploadState::restored:
      return UploadView::tr("The old table is active");
    case UploadState::restore_failed:
      return UploadView::tr("The old table could not be restored");
  }
  return {};
}

QString content_of(const controller::TableEntry& entry, const controller::Profile& profile) {
  if (!entry.words) return UploadView::tr("content not kept");
  const auto table = controller::decode_table(*entry.words, profile);
  if (!table) return UploadView::tr("%1 registers, not readable").arg(entry.words->size());
  if (table->axes.empty()) return UploadView::tr("no compensation");
  QStringList axes;
  for (const auto& [name, axis] : table->axes) axes << QString::fromStdString(name);
  return UploadView::tr("%1, %2 registers").arg(axes.join(QLatin1Char(' '))).arg(entry.words->size());
}

/// How a table came to be active.
QString how_active(const controller::TableEntry& entry, const controller::TableLog& log) {
  const auto* of = entry.of.empty() ? nullptr : log.find(entry.of);
  switch (entry.origin) {
    case controller::TableOrigin::found:
      return entry.words && entry.words->size() <= 2 ? UploadView::tr("empty at the start")
                                                     : UploadView::tr("found in the machine");
    case controller::TableOrigin::upload:
      return UploadView::tr("upload");
    case controller::TableOrigin::correction:
      return UploadView::tr("correction");
    case controller::TableOrigin::rollback:
      return of == nullptr ? UploadView::tr("rollback") : UploadView::tr("rollback to %1").arg(of->version);
    case controller::TableOrigin::restored:
      return UploadView::tr("restored after a failed upload");
  }
  return {};
}

}  // namespace

QVector<ui::AxisTable> axes_of(const compensation::Table& old_table, const compensation::Table& new_table,
                               const controller::Profile& profile, const recording::Recording& run) {
  QVector<ui::AxisTable> axes;
  for (const char* name : {"X", "Y", "Z"}) {
    const auto* before = axis_in(old_table, name);
    const auto* after = axis_in(new_table, name);
    if (before == nullptr && after == nullptr) continue;
    ui::AxisTable axis;
    axis.axis = QString::fromLatin1(name);
    axis.limit_um = profile.max_um;
    axis.terms = terms_of(before, after, profile);
    const auto at = profile.measure_position_mm.find(name);
    const double position_mm = at == profile.measure_position_mm.end() ? 0.0 : at->second;
    if ((has_terms(before) || has_terms(after)) && run.rows() > 1) {
      over_run(axis, before, after, old_table, new_table, position_mm, run);
    } else {
      over_position(axis, before, after, old_table, new_table);
    }
    axes.append(axis);
  }
  return axes;
}

double steepest_um_per_K(const compensation::Table& table) {
  double steepest = 0.0;
  for (const auto& [name, axis] : table.axes) {
    for (const auto& term : axis.terms) steepest = std::max(steepest, std::abs(term.um_per_K));
  }
  return steepest;
}

QVector<ui::Stage> stages_of(const std::vector<controller::UploadStep>& steps, bool running, bool failed) {
  QVector<ui::Stage> stages;
  for (int i = static_cast<int>(UploadState::checking); i <= static_cast<int>(UploadState::ramping); ++i) {
    stages.append({stage_text(static_cast<UploadState>(i))});
  }
  int last = -1;
  for (const auto& step : steps) {
    const int index = static_cast<int>(step.state);
    if (index < stages.size()) {
      stages[index].state = ui::StageState::done;
      stages[index].detail = coreText(step.detail);
      last = index;
    } else if (step.state != UploadState::done) {
      const bool worst = step.state == UploadState::restore_failed;
      stages.append(
          {stage_text(step.state), worst ? ui::StageState::failed : ui::StageState::done, coreText(step.detail)});
    }
  }
  if (last < 0) return stages;
  if (failed) stages[last].state = ui::StageState::failed;
  if (running) stages[last].state = ui::StageState::running;
  if (!running) {
    for (auto& stage : stages) {
      if (stage.state == ui::StageState::waiting) stage.state = ui::StageState::skipped;
    }
  }
  return stages;
}

ui::SignCheckResult sign_of(const controller::SignCheckRecord& record) {
  return sign_of(controller::to_json(record));
}

ui::SignCheckResult sign_of(const json& sign_check) {
  ui::SignCheckResult result;
  if (!sign_check.is_object()) return result;
  const auto number = [](const json& row, const char* key, std::size_t axis) {
    const json values = row.value(key, json::array());
    return values.size() > axis && values[axis].is_number() ? values[axis].get<double>() : 0.0;
  };
  for (const auto& row : sign_check.value("axes", json::array())) {
    ui::SignCheckAxis axis;
    axis.axis = QString::fromStdString(row.value("axis", ""));
    const std::size_t own = axis.axis == QStringLiteral("X") ? 0 : axis.axis == QStringLiteral("Y") ? 1 : 2;
    axis.commanded_um = row.value("commanded_um", 0.0);
    axis.watched = row.value("watched", false);
    axis.seen_um = number(row, "seen_um", own);
    axis.sigma_um = number(row, "sigma_um", own);
    result.measured = result.measured || axis.watched;
    result.axes.append(axis);
  }
  const bool passed = sign_check.value("passed", false);
  result.word = passed ? UploadView::tr("same direction and size") : UploadView::tr("not as commanded");
  result.judgement = passed ? ui::Judgement::ok : ui::Judgement::bad;
  return result;
}

QVector<ui::TableVersion> history_of(const controller::TableLog& kept,
                                     const std::optional<controller::ActiveTable>& active,
                                     const controller::Profile& profile) {
  controller::TableLog log = kept;
  if (active) log = controller::with_active(kept, *active, to_text(SystemClock().utc()));
  const auto* proposed = active ? controller::before_last(log) : nullptr;
  QVector<ui::TableVersion> rows;
  for (std::size_t i = log.entries.size(); i-- > 0;) {
    const controller::TableEntry& entry = log.entries[i];
    ui::TableVersion row;
    row.id = QString::fromStdString(entry.id);
    row.version = entry.version;
    row.when = shortMomentText(entry.time);
    row.who = QString::fromStdString(entry.who);
    row.how = how_active(entry, log);
    row.what = content_of(entry, profile);
    row.note = coreText(entry.note);
    row.active = active && i + 1 == log.entries.size();
    row.proposed = proposed == &entry;
    if (row.active) {
      row.blocked = UploadView::tr("Version %1 is active; choose a former one.").arg(entry.version);
    } else if (!entry.words) {
      row.blocked = UploadView::tr("An older program kept only the check sum of version %1.").arg(entry.version);
    } else if (active && controller::holds(entry, *active)) {
      row.blocked = UploadView::tr("Version %1 is the same table as the active one.").arg(entry.version);
    }
    rows.append(row);
  }
  return rows;
}

}  // namespace zerodrift::desktop

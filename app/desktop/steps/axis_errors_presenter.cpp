#include "app/desktop/steps/axis_errors_presenter.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <algorithm>
#include <cmath>
#include <set>

#include "app/desktop/column_question.h"
#include "app/desktop/table_export.h"
#include "app/text/core_text.h"
#include "core/base/file.h"
#include "core/base/resources.h"
#include "core/compensation/axis_map.h"
#include "core/compensation/positioning.h"
#include "core/controller/exports/export_format.h"
#include "ui/pages/axis_page.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {

using compensation::Criterion;
using compensation::Segmentation;

namespace {

constexpr int round_trip_points = 2000;
constexpr std::size_t largest_file = std::size_t{256} << 20;
constexpr const char* table_format = "zerodrift-table";

double error_of(const compensation::Segment& segment, double position_mm) {
  return ((segment.a - 1.0) * position_mm + segment.b_mm) * 1000.0;
}

/// Each point is looked at once: both lists ascend.
QVector<ui::AxisSegment> segments_of(const Segmentation& cut, const std::vector<double>& position_mm,
                                     const std::vector<double>& error_um) {
  QVector<ui::AxisSegment> rows;
  std::size_t next = 0;
  for (const auto& segment : cut.segments) {
    ui::AxisSegment row;
    row.from_mm = segment.from_mm;
    row.to_mm = segment.to_mm;
    row.a = segment.a;
    row.b_mm = segment.b_mm;
    row.r = segment.r;
    row.points = segment.points;
    // A point on a joint belongs to the segment that ends there.
    for (; next < position_mm.size() && position_mm[next] <= segment.to_mm; ++next) {
      row.largestResidual_um =
          std::max(row.largestResidual_um, std::abs(error_um[next] - error_of(segment, position_mm[next])));
    }
    rows.append(row);
  }
  return rows;
}

}  // namespace

AxisErrorsPresenter::AxisErrorsPresenter(Workbench& bench, ui::AxisPage* page) : Presenter(bench, page), m_page(page) {
  connect(page, &ui::AxisPage::segmentationChanged, this,
          [this](int criterion, double threshold, int startPoints, double tolerance_um) {
            constexpr std::array criteria = {Criterion::coordinates, Criterion::errors, Criterion::tolerance};
            m_options.criterion = criteria.at(static_cast<std::size_t>(std::clamp(criterion, 0, 2)));
            m_options.threshold = threshold;
            m_options.start_points = startPoints;
            m_options.tolerance_um = tolerance_um;
            cut();
          });
  connect(page, &ui::AxisPage::ruleChosen, this, [this](bool optimal) {
    m_useOptimal = optimal;
    refresh();
  });
  connect(page, &ui::AxisPage::formatChosen, this, [this](int index) {
    m_format = index;
    refresh();
  });
  connect(page, &ui::Page::emptyActionTriggered, this, &AxisErrorsPresenter::open);
  connect(page, &ui::Page::primaryTriggered, this, [this] {
    if (m_position_mm.empty()) {
      open();
    } else {
      use();
    }
  });
  connect(page, &ui::Page::secondaryTriggered, this, [this](const QString& action) {
    if (action == QStringLiteral("open")) open();
    if (action == QStringLiteral("columns")) askAgain();
    if (action == QStringLiteral("onePoint")) exportTable(true);
    if (action == QStringLiteral("export")) exportTable(false);
  });
  connect(page, &ui::AxisPage::axisChosen, this, [this](int index) {
    if (m_report.axes.size() < 2) {  // one table: whose it is may be said
      m_named = QStringLiteral("XYZ").mid(index, 1).toStdString();
      return refresh();
    }
    if (index < 0 || index >= static_cast<int>(m_report.axes.size())) return;
    m_how.axis = m_report.axes[static_cast<std::size_t>(index)];
    read();
  });
}

void AxisErrorsPresenter::open() {
  const QString path = QFileDialog::getOpenFileName(m_page, tr("Laser report"), bench().folder(),
                                                    tr("Laser reports (*.csv *.rtl *.REN *.ren *.pos);;All files (*)"));
  if (!path.isEmpty()) load(path);
}

bool AxisErrorsPresenter::load(const QString& path) {
  auto bytes = read_file(path.toStdString(), largest_file);
  if (!bytes) {
    show(bytes.error());
    return false;
  }
  m_file = path;
  m_bytes = std::move(*bytes);
  m_how = {};
  m_named.clear();
  const auto preview = compensation::preview_laser(m_bytes, path.toStdString());
  m_preview = preview ? std::optional(*preview) : std::nullopt;
  if (m_preview) m_how.mapping = remembered_mapping(*m_preview);
  if (m_how.mapping) bench().log(LogKind::note, tr("Columns as for the last file of this make"));
  return read();
}

bool AxisErrorsPresenter::read() {
  m_page->clearProblem();
  auto report = compensation::parse_laser(m_bytes, m_file.toStdString(), m_how);
  if (!report && report.error().code == ErrorCode::data_does_not_fit && m_how.axis.empty()) {
    // Several axes in one file: the first of them first.
    auto first = m_how;
    for (const char* axis : {"X", "Y", "Z"}) {
      first.axis = axis;
      if (auto one = compensation::parse_laser(m_bytes, m_file.toStdString(), first)) {
        m_how = first;
        report = std::move(one);
        break;
      }
    }
  }
  const auto is_one_of = [&](std::initializer_list<ErrorCode> codes) {
    return std::find(codes.begin(), codes.end(), report.error().code) != codes.end();
  };
  const bool other_form = !report && is_one_of({ErrorCode::csv_bad_header, ErrorCode::csv_cell_count,
                                                ErrorCode::csv_bad_number, ErrorCode::column_unclear});
  if (other_form && m_preview && m_asking) {
    m_how.mapping = ask_columns(m_page, m_bytes, m_file.toStdString(), *m_preview);
    if (!m_how.mapping) return false;
    report = compensation::parse_laser(m_bytes, m_file.toStdString(), m_how);
  }
  if (!report) {
    show(report.error());
    return false;
  }
  m_report = std::move(*report);
  m_position_mm.clear();
  m_error_um.clear();
  for (const auto& point : compensation::points_of(m_report)) {
    m_position_mm.push_back(point.position_mm);
    m_error_um.push_back(0.5 * (point.error_up_um + point.error_down_um));
  }
  bench().log(LogKind::note, tr("Laser report %1").arg(m_file));
  for (const auto& warning : m_report.warnings) bench().log(LogKind::warning, coreText(warning));
  if (!m_report.warnings.empty()) {
    tell([warning = m_report.warnings.front()] {
      return ui::Problem{ui::ProblemKind::note, coreText(warning), {}, {}};
    });
  }
  cut();
  Q_EMIT standingChanged();
  return !m_position_mm.empty();
}

/// No step of the job: a laser is there or it is not.
Presenter::Standing AxisErrorsPresenter::standing() const {
  if (const auto& body = bench().body("axis_table"); body.is_object()) {
    if (const auto kept = compensation::table_from_json(body.at("table"), "the axis table")) {
      QStringList axes;
      for (const auto& axis : kept->axes) axes << QString::fromStdString(axis.first);
      return {tr("In the table: %1").arg(ui::listText(axes)), ui::StepState::current};
    }
  }
  if (!m_position_mm.empty()) return {tr("%1 loaded").arg(QString::fromStdString(axisName()))};
  return {tr("When needed")};
}

void AxisErrorsPresenter::askAgain() {
  if (!m_preview) return;
  const auto mapping = ask_columns(m_page, m_bytes, m_file.toStdString(), *m_preview);
  if (!mapping) return;
  m_how.mapping = mapping;
  read();
}

void AxisErrorsPresenter::cut() {
  if (m_position_mm.empty()) return;
  compensation::SegmentationOptions published = m_options;
  if (published.criterion == Criterion::tolerance) published.criterion = Criterion::errors;
  compensation::SegmentationOptions optimal = m_options;
  optimal.criterion = Criterion::tolerance;
  const auto rule = compensation::segment_errors(m_position_mm, m_error_um, published);
  const auto fewest = compensation::segment_errors(m_position_mm, m_error_um, optimal);
  if (!rule || !fewest) {
    show(rule ? fewest.error() : rule.error());
    m_position_mm.clear();
    refresh();
    return;
  }
  m_published = *rule;
  m_optimal = *fewest;
  refresh();
}

std::string AxisErrorsPresenter::axisName() const {
  if (!m_named.empty()) return m_named;
  const char letter =
      m_report.axis.empty() ? 'X' : static_cast<char>(std::toupper(static_cast<unsigned char>(m_report.axis.front())));
  return std::string(1, letter == 'Y' || letter == 'Z' ? letter : 'X');
}

compensation::Table AxisErrorsPresenter::table() const {
  compensation::Table made;
  made.version = 1;
  auto& axis = made.axes[axisName()];
  axis.segments = chosen().segments;
  axis.points = compensation::points_of(m_report);
  const auto& profile = bench().profile();
  if (!profile) return made;
  made.machine = profile->name;
  const auto at = profile->measure_position_mm.find(axisName());
  if (at == profile->measure_position_mm.end()) return made;
  compensation::AxisTable bare;
  bare.points = axis.points;
  const double here_um = compensation::error_um(bare, at->second, compensation::Approach::up, {}).value_or(0.0);
  for (auto& point : axis.points) {
    point.error_up_um -= here_um;
    point.error_down_um -= here_um;
  }
  for (auto& segment : axis.segments) segment.b_mm -= here_um / 1000.0;
  return made;
}

void AxisErrorsPresenter::forget() {
  m_file.clear();
  m_bytes.clear();
  m_how = {};
  m_named.clear();
  m_preview.reset();
  m_report = {};
  m_position_mm.clear();
  m_error_um.clear();
  m_options = {};
  m_published = {};
  m_optimal = {};
  m_useOptimal = true;
  m_format = 0;
}

void AxisErrorsPresenter::use() {
  nlohmann::json notes = nlohmann::json::array();
  for (const auto& note : chosen().notes) notes.push_back(note);
  // The axes of earlier reports stay; this one takes the place of its own.
  compensation::Table all = table();
  const nlohmann::json statistics = compensation::to_json(compensation::positioning_figures(m_report));
  nlohmann::json by_axis = {{axisName(), statistics}};
  if (const auto before = bench().body("axis_table"); before.is_object()) {
    const auto kept = compensation::table_from_json(before.at("table"), "the axis table");
    if (kept && (kept->machine == all.machine || kept->machine.empty())) {
      for (const auto& [name, axis] : kept->axes) all.axes.try_emplace(name, axis);
      const auto figures = before.value("statistics_by_axis", nlohmann::json::object());
      for (const auto& [name, one] : figures.items()) {
        if (!by_axis.contains(name)) by_axis[name] = one;
      }
    }
  }
  const nlohmann::json body = {{"table", compensation::to_json(all)},
                               {"statistics", statistics},
                               {"statistics_by_axis", by_axis},
                               {"file", QFileInfo(QString::fromStdString(m_report.file)).fileName().toStdString()},
                               {"largest_residual_um", chosen().largest_residual_um},
                               {"notes", notes}};
  const auto kept = bench().takeIn("axis", [&body](commissioning::Job&, const TaskContext&) {
    return Result<commissioning::NewArtefact>(commissioning::NewArtefact::of("axis_table", body));
  });
  if (!kept) {
    show(kept.error());
    return;
  }
  Q_EMIT pageRequested(QStringLiteral("upload"));
}

void AxisErrorsPresenter::exportTable(bool one_point) {
  const auto& formats = controller::export_formats();
  const auto complain = [this](const Error& error) { show(error); };
  const auto* format = m_format == 0 ? nullptr : &formats.at(static_cast<std::size_t>(m_format - 1));
  export_with_question(m_page, bench(), table(), format, one_point, complain);
}

void AxisErrorsPresenter::fillMeasurement(ui::AxisState& state) const {
  std::set<std::pair<int, bool>> runs;
  for (const auto& reading : m_report.readings)
    runs.insert({reading.run, reading.approach == compensation::Approach::up});
  for (const auto& [number, upwards] : runs) {
    ui::LaserRun run;
    run.upwards = upwards;
    std::vector<std::pair<double, double>> points;
    for (const auto& reading : m_report.readings) {
      if (reading.run != number || (reading.approach == compensation::Approach::up) != upwards) continue;
      points.emplace_back(m_report.targets_mm[reading.target], reading.deviation_um);
    }
    std::sort(points.begin(), points.end());
    for (const auto& [position, error] : points) {
      run.position_mm.append(position);
      run.error_um.append(error);
    }
    state.runs.append(run);
  }
  state.position_mm = QVector<double>(m_position_mm.begin(), m_position_mm.end());
  state.mean_um = QVector<double>(m_error_um.begin(), m_error_um.end());
  state.fileNotes = ui::listText({tr("%1: %n target(s)", nullptr, static_cast<int>(m_report.targets_mm.size()))
                                      .arg(QFileInfo(QString::fromStdString(m_report.file)).fileName()),
                                  tr("%n run(s)", nullptr, static_cast<int>(runs.size()))});
}

void AxisErrorsPresenter::fillFigures(ui::AxisState& state) const {
  const auto figures = compensation::positioning_figures(m_report);
  for (const auto& target : figures.targets) {
    state.meanUp_um.append(target.runs_up > 0 ? target.mean_up_um : target.mean_down_um);
    state.sigmaUp_um.append(target.runs_up > 1 ? target.s_up_um : 0.0);
    if (!m_report.bidirectional()) continue;
    state.meanDown_um.append(target.mean_down_um);
    state.sigmaDown_um.append(target.runs_down > 1 ? target.s_down_um : 0.0);
  }
  state.iso = {{QStringLiteral("A"), tr("accuracy, both directions"), figures.A_um},
               {QStringLiteral("A↑"), tr("accuracy upwards"), figures.A_up_um},
               {QStringLiteral("A↓"), tr("accuracy downwards"), figures.A_down_um},
               {QStringLiteral("E"), tr("systematic deviation"), figures.E_um},
               {QStringLiteral("R"), tr("repeatability, both directions"), figures.R_um},
               {QStringLiteral("R↑"), tr("repeatability upwards"), figures.R_up_um},
               {QStringLiteral("R↓"), tr("repeatability downwards"), figures.R_down_um},
               {QStringLiteral("B"), tr("reversal, largest"), figures.B_um},
               {QStringLiteral("B̄"), tr("reversal, mean"), figures.B_mean_um},
               {QStringLiteral("M"), tr("range of the mean deviation"), figures.M_um}};
  state.vdi = {{QStringLiteral("P"), tr("positional uncertainty"), figures.P_um},
               {QStringLiteral("Pa"), tr("positional deviation"), figures.Pa_um},
               {QStringLiteral("Ps"), tr("scatter, largest"), figures.Ps_max_um},
               {QStringLiteral("Ps mean"), tr("scatter, mean"), figures.Ps_mean_um},
               {QStringLiteral("U"), tr("reversal, largest"), figures.U_max_um},
               {QStringLiteral("U mean"), tr("reversal, mean"), figures.U_mean_um}};
  state.before_um = std::isnan(figures.A_um) ? figures.E_um : figures.A_um;
  if (std::isnan(state.before_um)) {
    const auto [low, high] = std::minmax_element(m_error_um.begin(), m_error_um.end());
    state.before_um = *high - *low;
  }
  // What is left: the scatter of the runs as it is, and what the segments do not follow.
  compensation::LaserReport after = m_report;
  compensation::AxisTable axis;
  axis.segments = chosen().segments;
  const auto map = compensation::AxisMap::from(axis);
  if (!map) return;
  for (auto& reading : after.readings) {
    const double target_mm = after.targets_mm[reading.target];
    reading.deviation_um -= (map->forward(target_mm) - target_mm) * 1000.0;
  }
  const auto then = compensation::positioning_figures(after);
  state.after_um = !std::isnan(figures.A_um)   ? then.A_um
                   : !std::isnan(figures.E_um) ? then.E_um
                                               : 2.0 * chosen().largest_residual_um;
}

void AxisErrorsPresenter::fillSegments(ui::AxisState& state) const {
  constexpr std::array shown = {ui::SegmentCriterion::errors, ui::SegmentCriterion::coordinates,
                                ui::SegmentCriterion::tolerance};
  state.criterion = shown.at(static_cast<std::size_t>(m_options.criterion));
  state.threshold = m_options.threshold;
  state.startPoints = m_options.start_points;
  state.tolerance_um = m_options.tolerance_um;
  state.published = segments_of(m_published, m_position_mm, m_error_um);
  state.optimal = segments_of(m_optimal, m_position_mm, m_error_um);
  state.useOptimal = m_useOptimal;
  compensation::AxisTable axis;
  axis.segments = chosen().segments;
  const auto map = compensation::AxisMap::from(axis);
  state.monotonic = map.has_value();
  if (!map) return;
  double largest_mm = 0.0;
  const double from = m_position_mm.front();
  const double to = m_position_mm.back();
  for (int i = 0; i <= round_trip_points; ++i) {
    const double p = from + (to - from) * i / round_trip_points;
    largest_mm = std::max(largest_mm, std::abs(map->forward(map->inverse(p)) - p));
  }
  state.roundTrip_nm = 1e6 * largest_mm;
}

void AxisErrorsPresenter::fillFormat(ui::AxisState& state) const {
  const auto& formats = controller::export_formats();
  state.formats = {QString::fromLatin1(table_format)};
  for (const auto& format : formats) state.formats << name_of_format(format);
  state.format = m_format;
  if (m_format <= 0 || m_format > static_cast<int>(formats.size())) return;
  const auto made = formats.at(static_cast<std::size_t>(m_format - 1)).write(table(), {});
  if (!made) {
    state.formatLoss = tr("this table cannot be written in it");
    return;
  }
  QStringList losses;
  for (const auto& loss : made->losses) losses << coreText(loss);
  state.formatLoss = losses.join(QStringLiteral("; "));
  state.formatLoss_um = made->loss_um;
  QStringList confirm;
  for (const auto& line : made->confirm) confirm << coreText(line);
  state.formatConfirm = confirm.join(QStringLiteral("; "));
}

void AxisErrorsPresenter::refresh() {
  ui::AxisState state;
  if (!m_position_mm.empty()) {
    state.axis = QString::fromStdString(axisName());
    state.axes = {QStringLiteral("X"), QStringLiteral("Y"), QStringLiteral("Z")};
    state.chosenAxis = static_cast<int>(state.axes.indexOf(state.axis));
    if (m_report.axes.size() > 1) {
      state.axes.clear();
      for (std::size_t i = 0; i < m_report.axes.size(); ++i) {
        state.axes << QString::fromStdString(m_report.axes[i]);
        if (m_report.axes[i] == m_report.axis) state.chosenAxis = static_cast<int>(i);
      }
    }
    state.columnsAsked = m_how.mapping.has_value() || !m_report.warnings.empty();
    state.file = QString::fromStdString(m_report.file);
    fillMeasurement(state);
    fillFigures(state);
    fillSegments(state);
    fillFormat(state);
  }
  m_page->setState(state);
}

void AxisErrorsPresenter::tour(std::function<void(bool good)> done) {
  const auto sample = find_resource("samples/axis-x-laser.csv");
  if (!sample) {
    show(sample.error());
    done(false);
    return;
  }
  const bool good = load(QString::fromStdString(sample->string()));
  m_page->showView(1);
  done(good);
}

}  // namespace zerodrift::desktop

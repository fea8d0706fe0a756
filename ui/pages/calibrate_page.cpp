#include "ui/pages/calibrate_page.h"

#include <cmath>
#include <tuple>

#include "ui/plots/xy_plot.h"
#include "ui/widgets/card.h"
#include "ui/widgets/figure_card.h"
#include "ui/widgets/level_bar.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/progress_strip.h"
#include "ui/widgets/toggle_segment.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

constexpr double darkest_exposure = 0.35;  // of white: below it the noise grows
constexpr double brightest_exposure = 0.97;

PartStyle pointStyle(const QString& tag, const QColor& color, bool hollow, double size) {
  PartStyle style;
  style.tag = tag;
  style.unit = "mm";
  style.color = color;
  style.line = false;
  style.points = true;
  style.hollow = hollow;
  style.pointSize = size;
  return style;
}

PartStyle lineStyle(const QString& tag, const QColor& color, bool dashed) {
  PartStyle style;
  style.tag = tag;
  style.unit = "mm";
  style.color = color;
  style.dashed = dashed;
  return style;
}

/// Corners of a rectangle about the origin, closed.
QPair<QVector<double>, QVector<double>> frame(double halfWidth, double halfHeight) {
  return {{-halfWidth, halfWidth, halfWidth, -halfWidth, -halfWidth},
          {-halfHeight, -halfHeight, halfHeight, halfHeight, -halfHeight}};
}

}  // namespace

CalibratePage::CalibratePage(QWidget* parent) : Page("calibrate", parent) {
  auto* row = new QHBoxLayout;
  row->setSpacing(16);
  row->addWidget(makeImageCard(), 5);
  auto* right = new QVBoxLayout;
  right->setSpacing(16);
  right->addWidget(makePlanCard(), 1);
  right->addWidget(makeMoves());
  row->addLayout(right, 4);
  content()->addLayout(row, 1);
  refresh();
}

Card* CalibratePage::makeImageCard() {
  m_imageCard = new Card(this);
  m_camera = new ToggleSegment(m_imageCard);
  m_region = new QPushButton(m_imageCard);
  m_region->setObjectName("drawRegion");
  m_region->setCheckable(true);
  m_imageCard->tools()->addWidget(m_region);
  m_marks = new QPushButton(m_imageCard);
  m_marks->setObjectName("marks");
  m_marksMenu = new QMenu(m_marks);
  m_marks->setMenu(m_marksMenu);
  connect(m_marksMenu, &QMenu::aboutToShow, this, &CalibratePage::fillMarksMenu);
  m_imageCard->tools()->addWidget(m_marks);
  m_imageCard->tools()->addWidget(m_camera);
  m_view = new CameraView(m_imageCard);
  m_focus = new LevelBar(m_imageCard);
  m_exposure = new LevelBar(m_imageCard);
  auto* bars = new QHBoxLayout;
  bars->setSpacing(24);
  bars->addWidget(m_focus);
  bars->addWidget(m_exposure);
  m_imageCard->body()->addWidget(m_view, 1);
  m_imageCard->body()->addLayout(bars);
  connect(m_camera, &ToggleSegment::currentChanged, this, &CalibratePage::cameraChosen);
  connect(m_region, &QPushButton::toggled, this, [this](bool on) {
    if (on || m_drawing == CameraView::Drawing::target) {
      setDrawing(on ? CameraView::Drawing::target : CameraView::Drawing::none);
    }
  });
  connect(m_view, &CameraView::regionDrawn, this, [this](const QRectF& region) {
    const bool mark = m_drawing == CameraView::Drawing::reference;
    setDrawing(CameraView::Drawing::none);
    if (mark) {
      Q_EMIT markDrawn(region);
    } else {
      Q_EMIT regionDrawn(region);
    }
  });
  return m_imageCard;
}

void CalibratePage::setDrawing(CameraView::Drawing drawing) {
  m_drawing = drawing;
  m_view->setDrawing(drawing);
  const QSignalBlocker quiet(m_region);
  m_region->setChecked(drawing == CameraView::Drawing::target);
  renderMarks();
}

Card* CalibratePage::makePlanCard() {
  m_planCard = new Card(this);
  m_planCard->setBodyMargins(6, 0, 6, 8);
  m_planView = new ToggleSegment(m_planCard);
  m_planCard->tools()->addWidget(m_planView);
  m_plan = new XyPlot(m_planCard);
  m_plan->setEqualScale(true);
  m_residuals = new XyPlot(m_planCard);
  m_residuals->setEqualScale(true);
  m_plots = new QStackedWidget(m_planCard);
  m_plots->addWidget(m_plan);
  m_plots->addWidget(m_residuals);
  m_planNote = new WrapLabel(m_planCard);
  m_planNote->setProperty("role", "caption");
  m_planNote->setContentsMargins(10, 0, 10, 0);
  m_planCard->body()->addWidget(m_plots, 1);
  m_planCard->body()->addWidget(m_planNote);
  connect(m_planView, &ToggleSegment::currentChanged, this, [this](int index) {
    m_plots->setCurrentIndex(index);
    render();
  });
  return m_planCard;
}

QWidget* CalibratePage::makeMoves() {
  m_moveCard = new Card(this);
  m_clear = new QCheckBox(m_moveCard);
  m_clear->setObjectName("areaClear");
  m_moveNote = new WrapLabel(m_moveCard);
  m_moveNote->setProperty("role", "caption");
  m_moveCard->body()->addWidget(m_clear);
  m_moveCard->body()->addWidget(m_moveNote);
  connect(m_clear, &QCheckBox::toggled, this, [this] { refresh(); });
  return m_moveCard;
}

const QWidget* CalibratePage::keepInSight() const {
  return m_moveCard;
}

bool CalibratePage::takeConsent() {
  const bool given = m_clear->isEnabled() && m_clear->isChecked();
  m_clear->setChecked(false);
  return given;
}

void CalibratePage::hideEvent(QHideEvent* event) {
  // Who looks elsewhere does not see whether the area is still clear.
  m_clear->setChecked(false);
  Page::hideEvent(event);
}

void CalibratePage::setState(const CalibrateState& state) {
  // A finished measurement shows its residuals by itself, once.
  if (state.solved && !m_state.solved) m_planView->setCurrentIndex(1);
  if (!state.solved && m_state.solved) m_planView->setCurrentIndex(0);
  // What was agreed to is these moves at this moment, and no others.
  const auto moves = [](const CalibrateState& s) {
    return std::tie(s.moveCamera, s.moveNumber, s.moveAxes, s.movePosition, s.span_mm, s.running, s.waiting, s.solved,
                    s.camera, s.blocked);
  };
  if (moves(state) != moves(m_state)) {
    const QSignalBlocker quiet(m_clear);
    m_clear->setChecked(false);
  }
  m_state = state;
  refresh();
}

void CalibratePage::setFrame(const QImage& image, const CameraMarks& marks) {
  m_view->setImage(image);
  m_view->setMarks(marks);
}

void CalibratePage::setQuality(const ImageQuality& quality) {
  m_quality = quality;
  renderQuality();
}

int CalibratePage::measured() const {
  return static_cast<int>(std::count_if(m_state.points.begin(), m_state.points.end(),
                                        [](const CalibrationPoint& p) { return p.state == PointState::measured; }));
}

QString CalibratePage::title() const {
  return tr("Calibrate");
}

QString CalibratePage::sentence() const {
  if (!m_state.blocked.isEmpty()) return notYet();
  if (!m_state.templateTaken)
    return tr("Point the camera at the target, set focus and light, then draw the target's region.");
  if (m_state.waiting)
    return tr("Camera %1 comes next: confirm that its axes may move, then measure.").arg(m_state.moveCamera);
  if (m_state.running) return tr("The axes go from position to position. Keep hands and doors away.");
  if (m_state.accepted) return tr("This camera is calibrated. Measure again when it was touched.");
  if (m_state.solved) return tr("Judge the residuals: they must be small and without pattern. Then accept.");
  return tr("Confirm that the axes may move, then measure the positions.");
}

PageAction CalibratePage::primary() const {
  if (!m_state.blocked.isEmpty()) return {"primary", tr("Measure positions"), false, m_state.blocked};
  if (!m_state.templateTaken) {
    return {"primary",
            tr("Take the template"),
            true,
            {},
            tr("Pictures of the target at rest, with which all later ones are compared")};
  }
  if (m_state.solved && !m_state.accepted) {
    const bool good = m_state.rms_um <= 1.25 * m_state.rmsLimit_um;
    return {"primary", tr("Accept"), good,
            tr("The residual is above the limit. Measure again, slower or with better light."),
            tr("Keeps scale and directions of the cameras in the job")};
  }
  if (m_state.accepted) return {"primary", tr("Go on"), true, {}};
  const bool moving = m_state.running && !m_state.waiting;
  if (!moving && !m_state.offline.isEmpty()) return {"primary", tr("Measure positions"), false, m_state.offline};
  return {"primary", tr("Measure positions"), m_clear->isChecked() && !moving,
          moving ? tr("The positions are being measured.") : tr("Confirm first that the axes may move."),
          tr("Moves the axes by some millimetres at most and finds how many µm a pixel is")};
}

QVector<PageAction> CalibratePage::secondary() const {
  if (!m_state.blocked.isEmpty() || !m_state.templateTaken) return {};
  // Every measurement begins with a new template at rest.
  if (!m_state.solved) return {};
  return {{"repeat", tr("Measure again"), m_clear->isChecked() && !m_state.running && m_state.offline.isEmpty(),
           !m_state.offline.isEmpty() ? m_state.offline
           : m_state.running          ? tr("The positions are being measured.")
                                      : tr("Confirm first that the axes may move."),
           tr("Takes a new template and measures all positions anew")}};
}

QVector<Figure> CalibratePage::figures() const {
  Figure scale = figureOf(tr("Scale"), m_state.umPerPx, 3, tr("µm/px"));
  if (!std::isnan(m_state.umPerPxSigma)) scale.limit = QStringLiteral("± %1").arg(m_state.umPerPxSigma, 0, 'f', 4);
  Figure rotation = figureOf(tr("Camera rotation"), m_state.rotation_deg, 2, QStringLiteral("°"));
  rotation.tip = tr("Taken out by the calibration; it needs no turning of the camera.");
  Figure time = figureOf(tr("Positions"), measured(), 0, tr("of %1").arg(m_state.points.size()));
  if (m_state.points.isEmpty()) time.value.clear();
  if (!std::isnan(m_state.timeLeft_s)) time.limit = tr("%1 left").arg(durationText(m_state.timeLeft_s));
  const int decimals = m_state.uncertainty_um < 0.1 ? 3 : 2;  // never a bare zero
  return {scale, rotation, figureAtMost(tr("Residual, rms"), m_state.rms_um, 2, "µm", m_state.rmsLimit_um),
          figureAtMost(tr("Uncertainty"), m_state.uncertainty_um, decimals, "µm", m_state.uncertaintyLimit_um), time};
}

void CalibratePage::render() {
  if (!m_state.blocked.isEmpty()) {
    showEmpty(Icon::camera, tr("No camera to calibrate"), m_state.blocked);
    return;
  }
  showContent();
  setFigures(figures());
  m_imageCard->setTitle(tr("Live image"));
  {
    const QSignalBlocker quiet(m_camera);
    m_camera->setItems(m_state.cameras);
    m_camera->setCurrentIndex(m_state.camera);
    m_camera->setVisible(m_state.cameras.size() > 1);
  }
  m_region->setText(tr("Draw region"));
  m_region->setToolTip(tr("Draw a box around the target in the image"));
  m_region->setEnabled(!m_state.running);
  m_view->setPlaceholder(tr("Waiting for the camera"));
  m_planCard->setTitle(m_planView->currentIndex() == 1 ? tr("Residuals") : tr("Measuring positions"));
  m_planCard->setSubtitle(QStringLiteral("mm"));
  m_planView->setItems({tr("Plan"), tr("Residuals")});
  renderMarks();
  renderPlan();
  renderResiduals();
  renderQuality();
  renderMoves();
}

void CalibratePage::renderPlan() {
  const Colors& c = colors();
  m_plan->clear();
  m_plan->setPlaceholder(tr("The positions are proposed after the template"));
  const auto named = [](const QString& axis) { return axis + QStringLiteral(" / mm"); };
  for (XyPlot* plot : {m_plan, m_residuals}) plot->setAxisLabels(named(m_state.axisRight), named(m_state.axisUp));
  if (m_state.points.isEmpty()) return;
  if (m_state.fieldRight_mm > 0.0) {
    const auto [x, y] = frame(m_state.fieldRight_mm / 2.0, m_state.fieldUp_mm / 2.0);
    m_plan->setPart("0field", x, y, lineStyle(tr("Field of view"), c.muted, true));
  }
  if (m_state.driftRight_mm > 0.0) {
    const auto [x, y] = frame(m_state.driftRight_mm, m_state.driftUp_mm);
    m_plan->setPart("1drift", x, y, lineStyle(tr("Expected drift"), c.accent, false));
  }
  const auto put = [this](const QString& id, PointState state, const PartStyle& style) {
    QVector<double> x;
    QVector<double> y;
    for (const CalibrationPoint& p : m_state.points) {
      if (p.state != state) continue;
      x.append(p.right_mm);
      y.append(p.up_mm);
    }
    if (!x.isEmpty()) m_plan->setPart(id, x, y, style);
  };
  put("2planned", PointState::planned, pointStyle(tr("Planned"), c.muted, true, 10));
  put("3moving", PointState::moving, pointStyle(tr("Now"), c.accent, false, 13));
  put("4measured", PointState::measured, pointStyle(tr("Measured"), c.ok, false, 10));
  put("5refused", PointState::refused, pointStyle(tr("Refused"), c.bad, true, 11));
}

void CalibratePage::renderResiduals() {
  m_residuals->clear();
  m_residuals->setPlaceholder(tr("Shown when the positions are measured"));
  const bool shown = m_planView->currentIndex() == 1;
  m_planNote->setText(
      sentencesText({tr("Dashed: field of view. Blue: expected drift; the positions must enclose it."), ownDrift()}));
  if (!m_state.solved || m_state.points.isEmpty()) return;
  double largest_um = 1e-6;
  double extent_mm = 1e-6;
  for (const CalibrationPoint& p : m_state.points) {
    largest_um = std::max(largest_um, std::hypot(p.residualRight_um, p.residualUp_um));
    extent_mm = std::max({extent_mm, std::abs(p.right_mm), std::abs(p.up_mm)});
  }
  // The longest vector gets a third of the plan; the factor is rounded, so that it can be said.
  const double raw = 0.4 * extent_mm * 1000.0 / largest_um;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double factor = power * (raw / power >= 5.0 ? 5.0 : raw / power >= 2.0 ? 2.0 : 1.0);
  QVector<double> x;
  QVector<double> y;
  QStringList words;
  int index = 0;
  for (const CalibrationPoint& p : m_state.points) {
    if (p.state != PointState::measured) continue;
    x.append(p.right_mm);
    y.append(p.up_mm);
    words.append(tr("%1 µm").arg(std::hypot(p.residualRight_um, p.residualUp_um), 0, 'f', 2));
    m_residuals->setPart(
        QStringLiteral("v%1").arg(index++), {p.right_mm, p.right_mm + factor * p.residualRight_um / 1000.0},
        {p.up_mm, p.up_mm + factor * p.residualUp_um / 1000.0}, lineStyle(tr("Residual"), colors().bad, false));
  }
  m_residuals->setPart("points", x, y, pointStyle(tr("Position"), colors().ok, false, 7), words);
  if (shown) {
    m_planNote->setText(
        sentencesText({tr("Residual vectors drawn %1 times larger.").arg(factor, 0, 'f', 0), ownDrift()}));
  }
}

/// What the fixed marks take out of the camera's own drift, and what stays.
QString CalibratePage::ownDrift() const {
  if (m_state.takeOff == MarksTakeOff::nothing) {
    return tr(
        "Without a reference mark the camera's own drift stays in the errors: some 2 µm for each K that 100 mm of "
        "its aluminium bracket warm up.");
  }
  if (m_state.takeOff == MarksTakeOff::shiftTurnScale) {
    return tr(
        "The reference marks take out that the camera shifts, turns or changes its scale. A mark that "
        "itself moves would still be in the errors.");
  }
  const QString stays = std::isnan(m_state.markDistance_mm)
                            ? tr("That it turns or changes its scale stays in the errors.")
                            : tr("That it turns or changes its scale stays in the errors: %1 µm for 0.1 mrad or 1 in "
                                 "10 000.")
                                  .arg(fixedText(0.1 * m_state.markDistance_mm, 2));
  return sentencesText({m_state.marks == 1 ? tr("The reference mark takes out that the camera shifts.")
                                           : tr("The reference marks stand too close together: they take out only that "
                                                "the camera shifts."),
                        stays});
}

void CalibratePage::renderMarks() {
  const bool drawing = m_drawing == CameraView::Drawing::reference;
  m_imageCard->setSubtitle(drawing              ? tr("draw a box around the mark")
                           : m_state.marks == 0 ? tr("no reference mark")
                                                : tr("%n reference mark(s)", "", m_state.marks));
  m_marks->setText(tr("Marks"));
  m_marks->setToolTip(
      tr("Fixed marks on the table, which show the camera's own drift; two, well apart, show its turn too"));
  m_marks->setEnabled(!m_state.running);
}

void CalibratePage::fillMarksMenu() {
  using Drawing = CameraView::Drawing;
  m_marksMenu->clear();
  auto* add = m_marksMenu->addAction(tr("Add a mark"));
  add->setCheckable(true);
  add->setChecked(m_drawing == Drawing::reference);
  connect(add, &QAction::triggered, this, [this](bool on) { setDrawing(on ? Drawing::reference : Drawing::none); });
  for (int k = 0; k < m_state.marks; ++k) {
    const QString text = m_state.marks == 1 ? tr("Remove the mark") : tr("Remove mark %1").arg(k + 1);
    m_marksMenu->addAction(text, this, [this, k] { Q_EMIT markRemoved(k); });
  }
}

void CalibratePage::renderQuality() {
  const auto word = [](double level, double from, double to, const QString& low, const QString& high) {
    if (std::isnan(level)) return CalibratePage::tr("unknown");
    return level < from ? low : level > to ? high : CalibratePage::tr("good");
  };
  const auto judge = [](double level, double from, double to) {
    if (std::isnan(level)) return Judgement::none;
    return level < from || level > to ? Judgement::warn : Judgement::ok;
  };
  m_focus->setLevel(tr("Focus"), m_quality.focus, 0.6, 1.0, word(m_quality.focus, 0.6, 1.0, tr("blurred"), {}),
                    judge(m_quality.focus, 0.6, 1.0));
  const bool glare = m_quality.saturated_percent > 1.0;
  m_exposure->setLevel(
      tr("Exposure"), m_quality.exposure, darkest_exposure, brightest_exposure,
      glare ? tr("%1 % too bright").arg(m_quality.saturated_percent, 0, 'f', 0)
            : word(m_quality.exposure, darkest_exposure, brightest_exposure, tr("too dark"), tr("too bright")),
      glare ? Judgement::warn : judge(m_quality.exposure, darkest_exposure, brightest_exposure));
}

void CalibratePage::renderMoves() {
  m_moveCard->setTitle(tr("Moves"));
  m_moveCard->setSubtitle(
      m_state.moveOf > 1 ? tr("camera %1, %2 of %3").arg(m_state.moveCamera).arg(m_state.moveNumber).arg(m_state.moveOf)
                         : QString());
  const QString axes = m_state.moveAxes.isEmpty() ? tr("%1 and %2").arg(m_state.axisRight, m_state.axisUp)
                                                  : m_state.moveAxes.join(tr(" and "));
  m_clear->setText(tr("%1 may move by ±%2 mm; the area is clear.").arg(axes).arg(m_state.span_mm / 2.0, 0, 'f', 1));
  m_clear->setEnabled(!m_state.running || m_state.waiting);
  QStringList notes;
  if (!m_state.movePosition.isEmpty() && !m_state.running) {
    notes << tr("First the machine drives to %1; an axis not named here stays where it is.").arg(m_state.movePosition);
  }
  if (m_state.moveNumber < m_state.moveOf) notes << tr("Before the next camera is calibrated, you are asked again.");
  m_moveNote->setText(sentencesText(notes));
  m_moveNote->setVisible(!notes.isEmpty());
}

}  // namespace zerodrift::ui

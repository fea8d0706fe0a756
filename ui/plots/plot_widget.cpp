#include "ui/plots/plot_widget.h"

#include <QSvgGenerator>
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/plots/custom_plot.h"

namespace zerodrift::ui {
namespace {

constexpr double hoverReach_px = 28.0;
constexpr std::size_t mark_rows = 2;
constexpr int mark_row_px = 14;

/// Hours and minutes for any length of run; seconds only when the view is short.
class ElapsedTicker : public QCPAxisTickerTime {
 public:
  ElapsedTicker() { setTimeFormat("%h:%m"); }

 protected:
  double getTickStep(const QCPRange& range) override {
    setTimeFormat(range.size() < 600.0 ? "%h:%m:%s" : "%h:%m");
    return QCPAxisTickerTime::getTickStep(range);
  }
};

}  // namespace

PlotWidget::PlotWidget(QWidget* parent) : QWidget(parent) {
  m_plot = new QCustomPlot(this);
  m_plot->setMinimumSize(8, 8);  // it paints into buffers of its size: there is no buffer of none
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(m_plot);
  setFocusPolicy(Qt::StrongFocus);
  m_plot->setFocusPolicy(Qt::NoFocus);
  m_plot->setNoAntialiasingOnDrag(true);
  m_plot->setPlottingHint(QCP::phFastPolylines, true);
  m_plot->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  m_plot->setContextMenuPolicy(Qt::CustomContextMenu);
  m_plot->setMouseTracking(true);
  m_plot->addLayer("spans", m_plot->layer("background"), QCustomPlot::limAbove);
  m_plot->addLayer("hover", m_plot->layer("axes"), QCustomPlot::limAbove);
  m_plot->layer("hover")->setMode(QCPLayer::lmBuffered);

  // One left margin for all plots, so that stacked time axes line up.
  m_plot->axisRect()->setAutoMargins(QCP::msBottom);
  m_plot->axisRect()->setMargins(QMargins(58, 10, 26, 30));
  m_plot->axisRect()->setMinimumMargins(QMargins(58, 10, 26, 24));

  m_hoverPoint = new QCPItemTracer(m_plot);
  m_hoverPoint->setStyle(QCPItemTracer::tsCircle);
  m_hoverPoint->setSize(8);
  m_hoverText = new QCPItemText(m_plot);
  m_hoverText->setPadding(QMargins(7, 4, 7, 4));
  for (QCPAbstractItem* item :
       {static_cast<QCPAbstractItem*>(m_hoverPoint), static_cast<QCPAbstractItem*>(m_hoverText)}) {
    item->setLayer("hover");
    item->setVisible(false);
  }
  m_hoverPoint->position->setType(QCPItemPosition::ptPlotCoords);
  connect(m_plot, &QCustomPlot::beforeReplot, this, [this] {
    placeSpanTexts();
    placeMarkTexts();
  });
  m_placeholder = new QCPItemText(m_plot);
  m_placeholder->setText({});  // QCustomPlot writes "text" into a new one
  m_placeholder->position->setType(QCPItemPosition::ptAxisRectRatio);
  m_placeholder->position->setCoords(0.5, 0.45);
  m_placeholder->setVisible(false);

  connect(m_plot, &QCustomPlot::mouseMove, this, [this](QMouseEvent* e) { showHover(e->position()); });
  connect(m_plot, &QCustomPlot::mousePress, this, [this](QMouseEvent* e) { m_pressed = e->pos(); });
  connect(m_plot, &QCustomPlot::mouseRelease, this, [this](QMouseEvent* e) {
    if (e->button() != Qt::LeftButton || (e->pos() - m_pressed).manhattanLength() > 4) return;
    const Near near = nearest(e->position());
    const bool hit = near.distance_px < hoverReach_px;
    Q_EMIT clicked(hit ? near.id : QString(), xAxis()->pixelToCoord(e->position().x()),
                   yAxis()->pixelToCoord(e->position().y()));
  });
  connect(m_plot, &QCustomPlot::mouseDoubleClick, this, [this](QMouseEvent* e) {
    if (m_notesWanted) return Q_EMIT noteRequested(xAxis()->pixelToCoord(e->position().x()));
    fit();
  });
  connect(m_plot, &QWidget::customContextMenuRequested, this, &PlotWidget::openMenu);
  const auto moved = [this] {
    hideHover();
    Q_EMIT viewChanged(xAxis()->range().lower, xAxis()->range().upper);
  };
  connect(m_plot, &QCustomPlot::mouseWheel, this, [moved] { QTimer::singleShot(0, moved); });
  connect(m_plot, &QCustomPlot::mouseMove, this, [moved](QMouseEvent* e) {
    if (e->buttons() & Qt::LeftButton) moved();
  });
  styleFrame();
}

PlotWidget::~PlotWidget() = default;

QSize PlotWidget::sizeHint() const {
  return {480, 260};
}

QSize PlotWidget::minimumSizeHint() const {
  return {160, 90};
}

QCPAxis* PlotWidget::xAxis() const {
  return m_plot->xAxis;
}

QCPAxis* PlotWidget::yAxis() const {
  return m_plot->yAxis;
}

void PlotWidget::setAxisLabels(const QString& x, const QString& y) {
  xAxis()->setLabel(x);
  yAxis()->setLabel(y);
  const QMargins margins(y.isEmpty() ? 58 : 72, 10, 26, 24);
  m_plot->axisRect()->setMinimumMargins(margins);
  m_plot->axisRect()->setMargins(margins);
  replot();
}

void PlotWidget::setTimeAxis(bool time) {
  m_time = time;
  if (time) {
    xAxis()->setTicker(QSharedPointer<QCPAxisTicker>(new ElapsedTicker));
  } else {
    xAxis()->setTicker(QSharedPointer<QCPAxisTicker>(new QCPAxisTicker));
  }
}

void PlotWidget::setVerticalZoom(bool vertical) {
  m_plot->axisRect()->setRangeZoom(vertical ? Qt::Horizontal | Qt::Vertical : Qt::Horizontal);
  m_plot->axisRect()->setRangeDrag(vertical ? Qt::Horizontal | Qt::Vertical : Qt::Horizontal);
}

QString PlotWidget::xText(double x) const {
  return m_time ? elapsedText(x) : QString::number(x, 'g', 6);
}

QCPAxisTicker* PlotWidget::elapsedTicker() {
  return new ElapsedTicker;
}

QString elapsedText(double elapsed_s) {
  const auto seconds = static_cast<qint64>(std::llround(elapsed_s));
  return QStringLiteral("%1:%2:%3")
      .arg(seconds / 3600)
      .arg(seconds / 60 % 60, 2, 10, QChar('0'))
      .arg(seconds % 60, 2, 10, QChar('0'));
}

void PlotWidget::setSpans(const QVector<Span>& spans) {
  m_spans = spans;
  for (auto* item : m_spanItems) m_plot->removeItem(item);
  for (auto* item : m_spanTexts) m_plot->removeItem(item);
  m_spanItems.clear();
  m_spanTexts.clear();
  for (const Span& span : spans) {
    auto* box = new QCPItemRect(m_plot);
    box->setLayer("spans");
    box->setClipToAxisRect(true);
    box->topLeft->setTypeX(QCPItemPosition::ptPlotCoords);
    box->topLeft->setTypeY(QCPItemPosition::ptAxisRectRatio);
    box->bottomRight->setTypeX(QCPItemPosition::ptPlotCoords);
    box->bottomRight->setTypeY(QCPItemPosition::ptAxisRectRatio);
    box->topLeft->setCoords(span.from, 0.0);
    box->bottomRight->setCoords(span.to, 1.0);
    box->setPen(Qt::NoPen);
    box->setBrush(span.color);
    m_spanItems.append(box);
    if (span.label.isEmpty()) continue;
    auto* text = new QCPItemText(m_plot);
    text->setLayer("axes");  // above the grid, whose lines would strike it out
    text->setClipToAxisRect(true);
    text->position->setTypeX(QCPItemPosition::ptPlotCoords);
    text->position->setTypeY(QCPItemPosition::ptAxisRectRatio);
    text->position->setCoords(span.from, 0.0);
    text->setPositionAlignment(Qt::AlignTop | Qt::AlignLeft);
    text->setPadding(QMargins(5, 3, 0, 0));
    text->setProperty("span", static_cast<int>(m_spanItems.size()) - 1);
    text->setText(span.label);
    text->setFont(uiFont(11));
    text->setColor(colors().muted);
    m_spanTexts.append(text);
  }
  replot();
}

/// The words of marks stand in two rows, below the names of the spans, beside their line: to its right, at the end of
/// the plot to its left. What fits into neither row keeps its line alone.
void PlotWidget::placeMarkTexts() {
  const QRect inside = m_plot->axisRect()->rect();
  const int first_px = inside.top() + (hasSpanLabels() ? 18 : 2);
  std::array<double, mark_rows> free_px{};
  free_px.fill(inside.left());
  for (auto* text : m_markTexts) {
    const double x = text->position->coords().x();
    const double at_px = xAxis()->coordToPixel(x);
    const QMargins padding = text->padding();
    const double width_px =
        QFontMetrics(text->font()).horizontalAdvance(text->text()) + padding.left() + padding.right();
    const bool left = at_px + width_px > inside.right();
    const double from_px = left ? at_px - width_px : at_px;
    const auto row = std::find_if(free_px.begin(), free_px.end(), [&](double free) { return from_px >= free; });
    const bool seen = row != free_px.end() && at_px <= inside.right();
    text->setVisible(seen);
    if (!seen) continue;
    text->setPositionAlignment(Qt::AlignTop | (left ? Qt::AlignRight : Qt::AlignLeft));
    text->position->setCoords(x, first_px + mark_row_px * static_cast<int>(row - free_px.begin()));
    *row = from_px + width_px + 3;
  }
}

/// A name stands in the visible part of its span, and only where it fits: next to it stands another one.
void PlotWidget::placeSpanTexts() {
  const QCPRange range = xAxis()->range();
  for (auto* text : m_spanTexts) {
    const Span& span = m_spans[text->property("span").toInt()];
    const double from = std::max(span.from, range.lower);
    const double room_px = xAxis()->coordToPixel(std::min(span.to, range.upper)) - xAxis()->coordToPixel(from);
    const QMargins padding = text->padding();
    const int needed_px = QFontMetrics(text->font()).horizontalAdvance(text->text()) + padding.left() + padding.right();
    text->position->setCoords(from, 0.0);
    text->setVisible(room_px >= needed_px);
  }
}

void PlotWidget::setLimits(const QVector<Limit>& limits) {
  m_limits = limits;
  styleFrame();
}

void PlotWidget::setMarks(const QVector<Mark>& marks) {
  m_marks = marks;
  styleFrame();
}

void PlotWidget::setPlaceholder(const QString& text) {
  m_placeholder->setText(text);
}

void PlotWidget::showPlaceholder(bool shown) {
  m_placeholder->setVisible(shown && !m_placeholder->text().isEmpty());
}

void PlotWidget::styleFrame() {
  const Colors& c = colors();
  m_plot->setBackground(c.panel);
  for (QCPAxis* axis : {xAxis(), yAxis()}) {
    axis->setBasePen(axis == xAxis() ? QPen(c.line) : Qt::NoPen);
    axis->setTickPen(Qt::NoPen);
    axis->setSubTickPen(Qt::NoPen);
    axis->setTickLabelColor(c.muted);
    axis->setLabelColor(c.muted);
    axis->setTickLabelFont(uiFont(12));
    axis->setLabelFont(uiFont(12));
    axis->setLabelPadding(2);
    axis->grid()->setPen(QPen(c.grid, 1));
    axis->grid()->setZeroLinePen(QPen(c.line, 1));
    axis->grid()->setSubGridVisible(false);
  }
  m_hoverText->setFont(uiFont(12));
  m_hoverText->setColor(c.text);
  m_hoverText->setBrush(c.panel);
  m_hoverText->setPen(QPen(mix(c.line, c.muted, 0.4)));
  m_placeholder->setFont(uiFont(13));
  m_placeholder->setColor(c.muted);

  for (auto* item : m_lines) m_plot->removeItem(item);
  for (auto* item : m_lineTexts) m_plot->removeItem(item);
  m_lines.clear();
  m_lineTexts.clear();
  m_markTexts.clear();
  const auto line = [&](const QPointF& a, const QPointF& b, const QColor& color) {
    auto* item = new QCPItemStraightLine(m_plot);
    item->point1->setCoords(a);
    item->point2->setCoords(b);
    item->setPen(QPen(color, 1, Qt::DashLine));
    m_lines.append(item);
  };
  const auto write = [&](const QPointF& at, const QColor& color, const QString& text, bool upright) {
    if (text.isEmpty()) return;
    auto* word = new QCPItemText(m_plot);
    word->setText(text);
    word->setFont(uiFont(11));
    word->setColor(color);
    word->setClipToAxisRect(true);
    word->setClipAxisRect(m_plot->axisRect());
    word->position->setTypeX(upright ? QCPItemPosition::ptPlotCoords : QCPItemPosition::ptAxisRectRatio);
    word->position->setTypeY(upright ? QCPItemPosition::ptAbsolute : QCPItemPosition::ptPlotCoords);
    word->position->setCoords(at);
    word->setPositionAlignment(Qt::AlignBottom | Qt::AlignLeft);
    word->setPadding(upright ? QMargins(4, 0, 3, 0) : QMargins(5, 2, 2, 2));
    if (upright) word->setBrush(c.panel);  // or the lines of other marks would strike it out
    m_lineTexts.append(word);
    if (upright) m_markTexts.append(word);
  };
  for (const Limit& limit : m_limits) line({0, limit.value}, {1, limit.value}, c.ink(limit.judgement));
  for (const Mark& mark : m_marks) line({mark.at, 0}, {mark.at, 1}, c.ink(mark.judgement));
  for (const Limit& limit : m_limits) write({0.0, limit.value}, c.ink(limit.judgement), limit.label, false);
  for (const Mark& mark : m_marks) write({mark.at, 0.0}, c.ink(mark.judgement), mark.text, true);
  for (auto* text : m_spanTexts) text->setColor(c.muted);
  replot();
}

void PlotWidget::showHover(const QPointF& pixel) {
  if (QApplication::mouseButtons() != Qt::NoButton) return hideHover();
  const Near near = m_plot->axisRect()->rect().contains(pixel.toPoint()) ? nearest(pixel) : Near{};
  if (near.distance_px > hoverReach_px) return hideHover();
  m_hoverPoint->position->setCoords(near.x, near.y);
  m_hoverPoint->setPen(QPen(colors().panel, 1.5));
  m_hoverPoint->setBrush(near.color);
  m_hoverText->setText(near.text);
  const bool right = pixel.x() > width() * 0.6;
  m_hoverText->setPositionAlignment((right ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignBottom);
  m_hoverText->position->setType(QCPItemPosition::ptAbsolute);
  m_hoverText->position->setCoords(xAxis()->coordToPixel(near.x) + (right ? -10 : 10),
                                   std::max(34.0, yAxis()->coordToPixel(near.y) - 8));
  m_hoverPoint->setVisible(true);
  m_hoverText->setVisible(true);
  m_plot->layer("hover")->replot();
  Q_EMIT hovered(near.id, near.x, near.y);
}

void PlotWidget::hideHover() {
  if (!m_hoverText->visible()) return;
  m_hoverPoint->setVisible(false);
  m_hoverText->setVisible(false);
  m_plot->layer("hover")->replot();
  Q_EMIT hovered({}, 0, 0);
}

void PlotWidget::replot() {
  // However many setters are called, one replot follows, at most 30 a second.
  if (m_queued) return;
  m_queued = true;
  QTimer::singleShot(33, this, [this] {
    m_queued = false;
    // Without a size there is nothing to paint on; the first size brings a replot of its own.
    if (m_plot->width() > 1 && m_plot->height() > 1) m_plot->replot(QCustomPlot::rpQueuedReplot);
  });
}

void PlotWidget::fit() {
  m_plot->rescaleAxes(true);
  replot();
}

bool PlotWidget::savePng(const QString& path) const {
  return m_plot->savePng(path, 0, 0, 2.0);
}

bool PlotWidget::saveSvg(const QString& path) const {
  QSvgGenerator svg;
  svg.setFileName(path);
  svg.setSize(m_plot->size());
  svg.setViewBox(QRect(QPoint(), m_plot->size()));
  QCPPainter painter;
  if (!painter.begin(&svg)) return false;
  painter.setMode(QCPPainter::pmVectorized);
  painter.setMode(QCPPainter::pmNoCaching);
  m_plot->toPainter(&painter, m_plot->width(), m_plot->height());
  return painter.end();
}

bool PlotWidget::saveCsv(const QString& path) const {
  QSaveFile file(path);
  if (!file.open(QIODevice::WriteOnly)) return false;
  file.write(csv().toUtf8());
  return file.commit();
}

QImage PlotWidget::image(int width, int height) const {
  return m_plot->toPixmap(width, height).toImage();
}

void PlotWidget::openMenu(const QPoint& at) {
  QMenu menu(this);
  menu.addAction(tr("Fit to the data"), this, &PlotWidget::fit);
  if (m_notesWanted) {
    const double x = xAxis()->pixelToCoord(at.x());
    menu.addAction(tr("Add a note here"), this, [this, x] { Q_EMIT noteRequested(x); });
  }
  menu.addSeparator();
  menu.addAction(tr("Save picture (PNG)"), this, [this] { exportAs("png"); });
  menu.addAction(tr("Save drawing (SVG)"), this, [this] { exportAs("svg"); });
  menu.addAction(tr("Save visible values (CSV)"), this, [this] { exportAs("csv"); });
  menu.addAction(tr("Copy picture"), this, [this] { QGuiApplication::clipboard()->setPixmap(m_plot->toPixmap()); });
  menu.exec(m_plot->mapToGlobal(at));
}

void PlotWidget::exportAs(const QString& kind) {
  const QString path = QFileDialog::getSaveFileName(this, tr("Save"), "plot." + kind, "*." + kind);
  if (path.isEmpty()) return;
  if (kind == "png") savePng(path);
  if (kind == "svg") saveSvg(path);
  if (kind == "csv") saveCsv(path);
}

void PlotWidget::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  // Labels need room: about one tick every 42 px upwards and 90 px sideways.
  yAxis()->ticker()->setTickCount(std::clamp((height() - 40) / 42, 2, 9));
  xAxis()->ticker()->setTickCount(std::clamp((width() - 90) / 90, 2, 9));
}

void PlotWidget::changeEvent(QEvent* event) {
  const auto type = event->type();
  if (type == QEvent::PaletteChange || type == QEvent::StyleChange || type == QEvent::LanguageChange) {
    restyle();
    styleFrame();
  }
  QWidget::changeEvent(event);
}

bool PlotWidget::event(QEvent* event) {
  if (event->type() == QEvent::Leave) hideHover();
  return QWidget::event(event);
}

}  // namespace zerodrift::ui

#include "ui/shell/rail.h"

#include "ui/widgets/colors.h"
#include "ui/widgets/fitted_text.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::ui {
namespace {

constexpr double discX = 34.0;
constexpr double discRadius = 11.0;

/// A foot button in the rail's own colours, which are dark in both themes.
QString railButtonSheet() {
  const Colors& c = colors();
  return QStringLiteral(
             "QPushButton{background:transparent;border:1px solid transparent;border-radius:4px;color:%1;"
             "min-height:38px;padding:0 6px;text-align:left;font-size:12px;outline:0}"
             "QPushButton:hover{background:%2;color:%3}"
             "QPushButton:focus{border:2px solid %4;min-height:36px;padding:0 5px}")
      .arg(c.railMuted.name(), mix(c.rail, c.railText, 0.1).name(), c.railText.name(), QColor("#4BA3F0").name());
}

}  // namespace

StepButton::StepButton(QString id, int number, QWidget* parent)
    : QAbstractButton(parent), m_id(std::move(id)), m_number(number) {
  setObjectName("step-" + m_id);
  setCheckable(true);
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::PointingHandCursor);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  connect(this, &QAbstractButton::toggled, this, &StepButton::describe);
}

QSize StepButton::sizeHint() const {
  return {236, 60};
}

QSize StepButton::minimumSizeHint() const {
  return {236, 44};
}

void StepButton::setTitle(const QString& title) {
  setText(title);
  describe();
  update();
}

void StepButton::setState(StepState state, const QString& words) {
  m_state = state;
  m_words = words;
  describe();
  update();
}

void StepButton::describe() {
  const QString here = isChecked() ? tr("current page") : QString();
  QStringList parts = {text(), m_words, here};
  parts.removeAll(QString());
  setAccessibleName(listText(parts));
  setToolTip(m_words.isEmpty() ? text() : text() + ": " + m_words);
}

void StepButton::setConnectors(bool above, bool below, bool aboveDone, bool belowDone) {
  m_above = above;
  m_below = below;
  m_aboveDone = aboveDone;
  m_belowDone = belowDone;
  update();
}

void StepButton::enterEvent(QEnterEvent* event) {
  update();
  QAbstractButton::enterEvent(event);
}

void StepButton::leaveEvent(QEvent* event) {
  update();
  QAbstractButton::leaveEvent(event);
}

void StepButton::paintConnectors(QPainter& painter, const QPointF& centre) const {
  const QColor waiting = mix(colors().rail, colors().railMuted, 0.55);
  const QColor done = lightColors().ok;
  const double gap = discRadius + 2.0;
  if (m_above) {
    painter.setPen(QPen(m_aboveDone ? done : waiting, 2));
    painter.drawLine(QPointF(discX, 0), QPointF(discX, centre.y() - gap));
  }
  if (m_below) {
    painter.setPen(QPen(m_belowDone ? done : waiting, 2));
    painter.drawLine(QPointF(discX, centre.y() + gap), QPointF(discX, height()));
  }
}

void StepButton::paintDisc(QPainter& painter, const QPointF& centre) const {
  const Colors& c = colors();
  const QRectF disc(centre.x() - discRadius, centre.y() - discRadius, 2 * discRadius, 2 * discRadius);
  const auto number = [&](const QColor& ink) {
    painter.setPen(ink);
    painter.setFont(uiFont(12, QFont::DemiBold));
    painter.drawText(disc, Qt::AlignCenter, m_number > 0 ? QString::number(m_number) : QStringLiteral("•"));
  };
  painter.setPen(Qt::NoPen);
  if (m_state == StepState::current) {
    painter.setBrush(lightColors().ok);
    painter.drawEllipse(disc);
    painter.setPen(QPen(Qt::white, 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.setBrush(Qt::NoBrush);
    painter.drawPolyline(
        QPolygonF({centre + QPointF(-4.5, 0.3), centre + QPointF(-1.2, 3.8), centre + QPointF(5, -3.6)}));
  } else if (m_state == StepState::stale || m_state == StepState::failed) {
    painter.setBrush(m_state == StepState::stale ? lightColors().warn : lightColors().bad);
    painter.drawEllipse(disc);
    painter.setPen(QPen(Qt::white, 2.2, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(centre + QPointF(0, -5.2), centre + QPointF(0, 1.2));
    painter.drawPoint(centre + QPointF(0, 5.0));
  } else if (m_state == StepState::notNeeded) {
    painter.setPen(QPen(isChecked() ? c.railText : c.railMuted, 2, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(centre + QPointF(-5, 0), centre + QPointF(5, 0));
  } else if (isChecked() || m_state == StepState::running) {
    painter.setBrush(lightColors().accent);
    painter.drawEllipse(disc);
    number(Qt::white);
  } else {
    const QColor ring = m_state == StepState::ready ? c.railText : mix(c.rail, c.railMuted, 0.85);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(ring, 1.5));
    painter.drawEllipse(disc.adjusted(0.75, 0.75, -0.75, -0.75));
    number(ring);
  }
}

void StepButton::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  const Colors& c = colors();
  if (isChecked()) {
    painter.fillRect(rect(), mix(c.rail, c.railText, 0.12));
    painter.fillRect(QRect(0, 0, 3, height()), darkColors().accent);
  } else if (underMouse()) {
    painter.fillRect(rect(), mix(c.rail, c.railText, 0.06));
  }
  const QPointF centre(discX, height() / 2.0);
  paintConnectors(painter, centre);
  paintDisc(painter, centre);

  const int left = 58;
  const int room = width() - left - 10;
  painter.setFont(uiFont(14, isChecked() ? QFont::DemiBold : QFont::Medium));
  const bool faint = m_state == StepState::blocked || m_state == StepState::notNeeded;
  painter.setPen(faint && !isChecked() ? mix(c.railMuted, c.railText, 0.45) : c.railText);
  painter.drawText(QRectF(left, height() / 2.0 - 20, room, 20), Qt::AlignVCenter,
                   fittedText(painter.fontMetrics(), text(), room, toolTip()));
  painter.setFont(uiFont(12));
  painter.setPen(m_state == StepState::stale     ? QColor("#F0A63C")
                 : m_state == StepState::failed  ? QColor("#FF8D9B")
                 : m_state == StepState::running ? c.railText
                                                 : c.railMuted);
  painter.drawText(QRectF(left, height() / 2.0, room, 18), Qt::AlignVCenter,
                   fittedText(painter.fontMetrics(), m_words, room, toolTip()));
  if (hasFocus()) {
    painter.setPen(QPen(darkColors().accent, 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(QRectF(rect()).adjusted(4, 2, -4, -2), 4, 4);
  }
}

StepRail::StepRail(QWidget* parent) : QWidget(parent) {
  setFixedWidth(236);
  m_stepLayout = new QVBoxLayout;
  m_stepLayout->setSpacing(0);
  const auto foot = [this](const char* name) {
    auto* button = new QPushButton(this);
    button->setObjectName(name);
    button->setFocusPolicy(Qt::TabFocus);
    return button;
  };
  m_job = foot("railJob");
  m_language = foot("railLanguage");
  m_theme = foot("railTheme");
  m_help = foot("railHelp");
  connect(m_job, &QPushButton::clicked, this, &StepRail::jobClicked);
  connect(m_language, &QPushButton::clicked, this, &StepRail::languageClicked);
  connect(m_theme, &QPushButton::clicked, this, &StepRail::themeClicked);
  connect(m_help, &QPushButton::clicked, this, &StepRail::helpClicked);

  auto* choices = new QHBoxLayout;
  choices->setSpacing(2);
  choices->addWidget(m_language);
  choices->addWidget(m_theme);
  choices->addWidget(m_help);
  auto* bottom = new QVBoxLayout;
  bottom->setContentsMargins(12, 4, 12, 8);
  bottom->setSpacing(0);
  bottom->addWidget(m_job);
  bottom->addLayout(choices);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 60, 0, 0);
  all->setSpacing(0);
  all->addLayout(m_stepLayout);
  all->addStretch(1);
  all->addLayout(bottom);
  setJob({}, {});
  setDark(colors().dark);
}

StepButton* StepRail::addStep(const QString& id, const QString& title, bool branch) {
  const int number = branch ? 0 : static_cast<int>(m_branch.count(false)) + 1;
  auto* button = new StepButton(id, number, this);
  button->setTitle(title);
  if (branch) m_stepLayout->addSpacing(6);
  m_stepLayout->addWidget(button);
  m_steps.append(button);
  m_branch.append(branch);
  connect(button, &QAbstractButton::clicked, this, [this, id] {
    // Whether the page changes is decided outside: until then the rail shows the page that is open.
    const QString open = property("current").toString();
    setCurrent(open);
    Q_EMIT stepRequested(id);
  });
  connectDiscs();
  return button;
}

StepButton* StepRail::step(const QString& id) const {
  for (StepButton* button : m_steps) {
    if (button->id() == id) return button;
  }
  return nullptr;
}

void StepRail::setStepState(const QString& id, StepState state, const QString& words) {
  if (StepButton* button = step(id)) button->setState(state, words);
  connectDiscs();
}

void StepRail::setCurrent(const QString& id) {
  setProperty("current", id);
  for (StepButton* button : m_steps) button->setChecked(button->id() == id);
}

void StepRail::connectDiscs() {
  for (int i = 0; i < m_steps.size(); ++i) {
    const bool above = i > 0 && !m_branch[i];
    const bool below = !m_branch[i] && i + 1 < m_steps.size() && !m_branch[i + 1];
    const bool done = m_steps[i]->state() == StepState::current;
    m_steps[i]->setConnectors(above, below, above && m_steps[i - 1]->state() == StepState::current, done);
  }
}

void StepRail::setJob(const QString& job, const QString& engineer) {
  m_jobName = job;
  m_engineer = engineer;
  retranslate();
}

void StepRail::setLanguage(const QString& shownCode) {
  m_language->setText(shownCode);
  retranslate();
}

void StepRail::setLanguagesOffered(bool offered) {
  m_language->setVisible(offered);
}

void StepRail::setDark(bool dark) {
  for (QPushButton* button : {m_job, m_language, m_theme, m_help}) button->setStyleSheet(railButtonSheet());
  m_language->setIcon(lineIcon(Icon::globe, colors().railMuted));
  m_theme->setIcon(lineIcon(dark ? Icon::sun : Icon::moon, colors().railMuted));
  m_help->setIcon(lineIcon(Icon::help, colors().railMuted));
  m_job->setIcon(lineIcon(Icon::folder, colors().railMuted));
  retranslate();
}

void StepRail::retranslate() {
  const QString job = m_jobName.isEmpty() ? tr("No job open") : m_jobName;
  const QString line = m_engineer.isEmpty() ? job : job + QStringLiteral("  ·  ") + m_engineer;
  m_job->setText(fittedText(m_job->fontMetrics(), line, 170, line, Qt::ElideMiddle));
  m_job->setToolTip(line);
  m_job->setAccessibleName(tr("Job: %1").arg(line));
  m_theme->setText(colors().dark ? tr("Light") : tr("Dark"));
  m_theme->setAccessibleName(colors().dark ? tr("Switch to light colours") : tr("Switch to dark colours"));
  m_theme->setToolTip(m_theme->accessibleName());
  m_help->setText(tr("Help"));
  m_help->setToolTip(tr("Help for this step (F1)"));
  m_language->setToolTip(tr("Language"));
  m_language->setAccessibleName(tr("Language: %1").arg(m_language->text()));
}

void StepRail::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  const Colors& c = colors();
  painter.fillRect(rect(), c.rail);
  // The mark: a drifting curve brought back to its zero line.
  painter.setPen(QPen(darkColors().accent, 2.4, Qt::SolidLine, Qt::RoundCap));
  QPainterPath curve(QPointF(23, 31));
  curve.cubicTo(28, 16, 34, 16, 36, 25);
  curve.cubicTo(37, 30, 40, 31, 45, 31);
  painter.drawPath(curve);
  painter.setPen(QPen(mix(c.rail, c.railMuted, 0.8), 1.4, Qt::DotLine));
  painter.drawLine(QPointF(22, 36.5), QPointF(46, 36.5));
  painter.setFont(uiFont(16, QFont::DemiBold));
  painter.setPen(c.railText);
  painter.drawText(QRectF(58, 14, 160, 30), Qt::AlignVCenter, "Zerodrift");
}

}  // namespace zerodrift::ui

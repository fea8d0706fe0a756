#include "ui/pages/machine_page.h"

#include <cmath>

#include "ui/widgets/card.h"
#include "ui/widgets/channel_table.h"
#include "ui/widgets/figure_card.h"
#include "ui/widgets/machine_drawing.h"
#include "ui/widgets/toggle_segment.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

QString htmlColor(const QColor& color) {
  return color.name();
}

/// A job in the list: its name, below it how far it is.
class TwoLines : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const Colors& c = colors();
    painter->save();
    painter->setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
    const bool over = option.state & (QStyle::State_MouseOver | QStyle::State_Selected);
    if (over) {
      painter->setPen(Qt::NoPen);
      painter->setBrush(c.soft(c.accent));
      painter->drawRoundedRect(option.rect, 4, 4);
    }
    drawIcon(*painter, QRectF(option.rect.x() + 8, option.rect.center().y() - 11, 22, 22), Icon::file, c.muted);
    const QRect inside = option.rect.adjusted(42, 4, -8, -4);
    const QString text = index.data().toString();
    painter->setFont(uiFont(13, QFont::DemiBold));
    painter->setPen(c.text);
    painter->drawText(inside, Qt::AlignTop, text.section('\n', 0, 0));
    painter->setFont(uiFont(12));
    painter->setPen(c.muted);
    painter->drawText(inside, Qt::AlignBottom, text.section('\n', 1));
    painter->restore();
  }
};

/// The number in a channel's tag, which fits a disc: "T12" -> "12".
QString shortTag(const QString& tag) {
  QString digits;
  for (const QChar letter : tag) {
    if (letter.isDigit()) digits += letter;
  }
  return digits.isEmpty() ? tag.left(2) : digits.left(2);
}

}  // namespace

MachinePage::MachinePage(QWidget* parent) : Page("machine", parent) {
  m_views = new QStackedWidget(this);
  m_start = makeStart();
  m_machine = makeMachine();
  m_views->addWidget(m_start);
  m_views->addWidget(m_machine);
  content()->addWidget(m_views, 1);
  refresh();
}

QWidget* MachinePage::makeStart() {
  auto* view = new QWidget(this);
  m_startCard = new Card(view);
  const QVector<Icon> icons = {Icon::plus, Icon::folder, Icon::chart, Icon::machine};
  for (int i = 0; i < icons.size(); ++i) {
    auto* button = new QPushButton(lineIcon(icons[i]), {}, m_startCard);
    button->setObjectName(QStringList({"startNew", "startOpen", "startSample", "startVirtual"})[i]);
    button->setProperty("big", true);
    button->setIconSize({20, 20});
    button->setStyleSheet("text-align: left");
    auto* note = new WrapLabel(m_startCard);
    note->setProperty("role", "muted");
    m_startCard->body()->addWidget(button);
    m_startCard->body()->addWidget(note);
    m_startCard->body()->addSpacing(8);
    m_startButtons.append(button);
    m_startNotes.append(note);
  }
  m_startCard->body()->addStretch();
  connect(m_startButtons[0], &QPushButton::clicked, this, &MachinePage::newJobRequested);
  connect(m_startButtons[1], &QPushButton::clicked, this, [this] { Q_EMIT openJobRequested({}); });
  connect(m_startButtons[2], &QPushButton::clicked, this, &MachinePage::sampleRequested);
  connect(m_startButtons[3], &QPushButton::clicked, this, &MachinePage::virtualMachineRequested);

  m_recentCard = new Card(view);
  m_recent = new QListWidget(m_recentCard);
  m_recent->setObjectName("recentJobs");
  m_recent->setSpacing(1);
  m_noRecent = new WrapLabel(m_recentCard);
  m_noRecent->setProperty("role", "muted");
  m_recentCard->body()->addWidget(m_noRecent);
  m_recentCard->body()->addWidget(m_recent, 1);
  m_recentCard->body()->addStretch();
  connect(m_recent, &QListWidget::itemActivated, this,
          [this](QListWidgetItem* item) { Q_EMIT openJobRequested(item->data(Qt::UserRole).toString()); });
  connect(m_recent, &QListWidget::itemClicked, this,
          [this](QListWidgetItem* item) { Q_EMIT openJobRequested(item->data(Qt::UserRole).toString()); });

  m_recent->setItemDelegate(new TwoLines(m_recent));

  m_wayCard = new Card(view);
  for (int i = 0; i < 9; ++i) {
    auto* line = new QLabel(m_wayCard);
    line->setTextFormat(Qt::RichText);
    m_wayCard->body()->addWidget(line);
    m_way.append(line);
  }
  auto* right = new QVBoxLayout;
  right->setSpacing(16);
  right->addWidget(m_recentCard, 1);
  right->addWidget(m_wayCard);
  auto* all = new QHBoxLayout(view);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(16);
  all->addWidget(m_startCard, 2);
  all->addLayout(right, 3);
  return view;
}

QWidget* MachinePage::makeMachine() {
  auto* view = new QWidget(this);
  m_drawingCard = new Card(view);
  m_profile = new QComboBox(m_drawingCard);
  m_profile->setObjectName("profile");
  m_profile->setMinimumWidth(150);
  m_profile->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  m_view = new ToggleSegment(m_drawingCard);
  m_drawingCard->tools()->addWidget(m_profile);
  m_drawingCard->tools()->addWidget(m_view);
  m_drawing = new MachineDrawing(m_drawingCard);
  m_registers = new QTableWidget(0, 5, m_drawingCard);
  m_registers->setObjectName("registers");
  m_registers->verticalHeader()->hide();
  m_registers->verticalHeader()->setDefaultSectionSize(26);
  m_registers->setShowGrid(false);
  m_registers->horizontalHeader()->setSectionResizeMode(3, QHeaderView::Stretch);
  m_registers->setSelectionBehavior(QAbstractItemView::SelectRows);
  m_drawingViews = new QStackedWidget(m_drawingCard);
  m_drawingViews->addWidget(m_drawing);
  m_drawingViews->addWidget(m_registers);
  m_parts = new WrapLabel(m_drawingCard);
  m_parts->setObjectName("partHealth");
  m_parts->setTextFormat(Qt::RichText);
  m_drawingCard->body()->addWidget(m_drawingViews, 1);
  m_drawingCard->body()->addWidget(m_parts);

  m_sensorCard = new Card(view);
  m_sensorCard->setBodyMargins(1, 0, 1, 6);
  m_sensorCard->setFixedWidth(416);
  m_table = new ChannelTable(m_sensorCard);
  m_table->setColumnWidths(70, 130);
  m_sensorCard->body()->addWidget(m_table);

  auto* all = new QHBoxLayout(view);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(16);
  all->addWidget(m_drawingCard, 1);
  all->addWidget(m_sensorCard);

  connect(m_profile, &QComboBox::activated, this, &MachinePage::profileChosen);
  connect(m_view, &ToggleSegment::currentChanged, m_drawingViews, &QStackedWidget::setCurrentIndex);
  connect(m_drawing, &MachineDrawing::selected, this, [this](const QString& id) {
    m_table->select(id);
    Q_EMIT sensorSelected(id);
  });
  connect(m_table, &ChannelTable::selected, this, [this](const QString& id) {
    m_drawing->select(id);
    Q_EMIT sensorSelected(id);
  });
  connect(m_registers, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
    if (m_filling) return;
    const int row = item->row();
    Q_EMIT registerEdited(row, m_registers->item(row, 3)->text(), m_registers->item(row, 0)->text().toInt());
  });
  return view;
}

void MachinePage::setState(const MachineState& state) {
  m_state = state;
  refresh();
}

void MachinePage::selectSensor(const QString& id) {
  m_table->select(id);
}

QString MachinePage::title() const {
  return tr("Machine");
}

QString MachinePage::sentence() const {
  if (!m_state.jobOpen) return tr("Start a job for this machine, or go on with one.");
  if (!m_state.connected) return tr("Choose the connection profile and connect to the controller.");
  if (m_state.compensationOn)
    return tr("Switch the compensation off: with it on, nothing can be measured for the model.");
  return tr("Check that every sensor is alive and the machine is at rest and of even temperature.");
}

PageAction MachinePage::primary() const {
  if (!m_state.jobOpen) return {"primary", {}, false, {}};
  if (!m_state.connected) {
    const bool chosen = m_state.profile >= 0;
    return {"primary", tr("Connect"), chosen && !m_state.connecting,
            chosen ? tr("The connection is being made.") : tr("Choose or import a connection profile first.")};
  }
  return {"primary", tr("Start commissioning"), !m_state.compensationOn,
          tr("The compensation is ON. Measuring for the model is locked until it is switched off.")};
}

QVector<PageAction> MachinePage::secondary() const {
  if (!m_state.jobOpen) return {{"import", tr("Import profile")}};
  QVector<PageAction> actions = {{"job", tr("Other job")}, {"import", tr("Import profile")}};
  if (m_state.connected) {
    actions.append({"test", tr("Test again")});
    actions.append({"disconnect", tr("Disconnect")});
  }
  return actions;
}

QVector<Figure> MachinePage::figures() const {
  if (!m_state.jobOpen) return {};
  const auto alive = std::count_if(m_state.sensors.begin(), m_state.sensors.end(),
                                   [](const SensorHealth& s) { return s.judgement == Judgement::ok; });
  Figure sensors = figureOf(tr("Sensors alive"), m_state.connected ? static_cast<double>(alive) : NAN, 0,
                            tr("of %1").arg(m_state.sensors.size()));
  if (m_state.connected) {
    const bool all = alive == m_state.sensors.size();
    sensors.judgement = all ? Judgement::ok : Judgement::warn;
    sensors.word = all ? tr("all") : tr("%n to check", nullptr, static_cast<int>(m_state.sensors.size() - alive));
  }
  Figure spread = figureAtMost(tr("Spread at rest"), m_state.spread_K, 2, "K", m_state.spreadLimit_K);
  if (spread.judgement == Judgement::ok) spread.word = tr("even");
  if (spread.judgement == Judgement::bad) spread.word = tr("still warm");
  spread.tip = tr("Warmest sensor minus coldest. The run must start from an even temperature.");
  Figure clock = figureAtMost(tr("Clock difference"), m_state.clockDifference_s, 1, "s", m_state.clockLimit_s);
  clock.tip = tr("Controller's clock minus this computer's.");
  return {sensors, spread, figureAtMost(tr("Round trip"), m_state.roundTrip_ms, 1, "ms", m_state.roundTripLimit_ms),
          clock};
}

void MachinePage::render() {
  setFigures(figures());
  m_views->setCurrentWidget(m_state.jobOpen ? m_machine : m_start);
  renderStart();
  renderMachine();
  renderParts();
  renderRegisters();
}

void MachinePage::renderStart() {
  m_startCard->setTitle(tr("Start"));
  m_recentCard->setTitle(tr("Recent jobs"));
  const QStringList names = {tr("New job"), tr("Open job"), tr("Open the sample job"),
                             tr("Connect to the virtual machine")};
  const QStringList notes = {
      tr("One file holds the whole commissioning: measurements, model, tables, report."),
      tr("Go on where the job stopped; also after a crash."),
      tr("A finished commissioning to look around in. Nothing needs to be connected."),
      tr("A five-axis machine in software, with controller and cameras, to try everything without risk."),
  };
  for (int i = 0; i < names.size(); ++i) {
    m_startButtons[i]->setText(names[i]);
    m_startNotes[i]->setText(notes[i]);
  }
  m_startButtons[2]->setVisible(m_state.sampleAvailable);
  m_startNotes[2]->setVisible(m_state.sampleAvailable);
  m_wayCard->setTitle(tr("The way through"));
  const QStringList way = {
      tr("Machine") + '|' + tr("connect, see that all sensors live and the machine is cold"),
      tr("Calibrate") + '|' + tr("teach the camera what a micrometre is"),
      tr("Warm-up") + '|' + tr("record temperatures and errors while the machine warms"),
      tr("Sensors") + '|' + tr("keep the few that carry the error"),
      tr("Fit") + '|' + tr("make the model and judge it on what it has not seen"),
      tr("Physics") + '|' + tr("find what the simulation lacks"),
      tr("Upload") + '|' + tr("write the table as one transaction, old one saved"),
      tr("Verify") + '|' + tr("prove on the machine that the error is gone"),
      tr("Report") + '|' + tr("hand it over, every figure traceable"),
  };
  for (int i = 0; i < way.size(); ++i) {
    m_way[i]->setText(QStringLiteral("<b>%1&nbsp; %2</b> &nbsp;<span style='color:%3'>%4</span>")
                          .arg(i + 1)
                          .arg(way[i].section('|', 0, 0), htmlColor(colors().muted), way[i].section('|', 1)));
  }
  m_noRecent->setText(tr("No jobs yet. Jobs that you make or open are listed here."));
  m_noRecent->setVisible(m_state.recent.isEmpty());
  m_recent->setVisible(!m_state.recent.isEmpty());
  m_recent->clear();
  for (const RecentJob& job : m_state.recent) {
    auto* item = new QListWidgetItem(job.name + '\n' + job.detail, m_recent);
    item->setData(Qt::UserRole, job.path);
    item->setToolTip(job.path);
    item->setSizeHint({100, 46});
  }
}

void MachinePage::renderMachine() {
  m_drawingCard->setTitle(m_state.machineName.isEmpty() ? tr("Machine") : m_state.machineName);
  m_drawingCard->setSubtitle(m_state.connected ? m_state.address : tr("not connected"));
  m_view->setItems({tr("Drawing"), tr("Registers")});
  {
    const QSignalBlocker quiet(m_profile);
    m_profile->clear();
    m_profile->addItems(m_state.profiles);
    m_profile->setCurrentIndex(m_state.profile);
    m_profile->setPlaceholderText(tr("Choose a profile"));
    m_profile->setAccessibleName(tr("Connection profile"));
  }
  m_sensorCard->setTitle(tr("Sensors"));
  m_sensorCard->setSubtitle(tr("value, age, noise"));
  m_table->setHeaders(tr("Sensor"), tr("Value"), tr("Age, noise"));

  double coldest = INFINITY;
  double warmest = -INFINITY;
  for (const SensorHealth& s : m_state.sensors) {
    coldest = std::fmin(coldest, s.value_C);
    warmest = std::fmax(warmest, s.value_C);
  }
  QVector<ChannelRow> rows;
  QVector<SensorSpot> spots;
  for (const SensorHealth& s : m_state.sensors) {
    const bool live = m_state.connected && !std::isnan(s.value_C);
    const QString value = live ? tr("%1 °C").arg(s.value_C, 0, 'f', 2) : QStringLiteral("–");
    QString state = s.state;
    if (live && s.judgement == Judgement::ok) {
      state = tr("%1 s  ±%2 K").arg(s.age_s, 0, 'f', 1).arg(s.noise_K, 0, 'f', 2);
    }
    rows.append({s.id,
                 s.tag + QStringLiteral("  ") + s.label,
                 value,
                 state,
                 m_state.connected ? s.judgement : Judgement::none,
                 {},
                 true,
                 s.tag + ": " + s.label + (s.state.isEmpty() ? QString() : ", " + s.state)});
    // At rest all are alike: colours spread over at least 3 K, so that noise does not look like heat.
    const double span = std::max(3.0, warmest - coldest);
    spots.append({s.id, shortTag(s.tag), s.tag + QStringLiteral("  ") + s.label, s.place, s.along, value,
                  m_state.connected ? s.judgement : Judgement::none, live ? (s.value_C - coldest) / span : -1.0});
  }
  m_table->setRows(rows);
  m_drawing->setSensors(spots);
  m_drawing->setConnected(m_state.connected);
}

void MachinePage::renderParts() {
  QStringList words;
  for (const PartHealth& part : m_state.parts) {
    const QString mark = part.judgement == Judgement::ok     ? "✓"
                         : part.judgement == Judgement::warn ? "!"
                         : part.judgement == Judgement::bad  ? "✕"
                                                             : "·";
    words.append(QStringLiteral("<span style='color:%1'>%2</span>&nbsp;<span style='color:%3'>%4</span>&nbsp;%5")
                     .arg(htmlColor(colors().ink(part.judgement)), mark, htmlColor(colors().muted),
                          part.label.toHtmlEscaped().replace(' ', "&nbsp;"),
                          part.value.toHtmlEscaped().replace(' ', "&nbsp;")));
  }
  m_parts->setText(words.join(" &nbsp;&nbsp; "));
  m_parts->setVisible(m_state.connected && !words.isEmpty());
}

void MachinePage::renderRegisters() {
  m_filling = true;
  m_registers->setHorizontalHeaderLabels({tr("Address"), tr("Type"), tr("Access"), tr("Meaning"), tr("Value now")});
  m_registers->setRowCount(static_cast<int>(m_state.registers.size()));
  for (int row = 0; row < m_state.registers.size(); ++row) {
    const RegisterRow& r = m_state.registers[row];
    const QStringList texts = {QString::number(r.address), r.type, r.access, r.meaning, r.value};
    for (int column = 0; column < texts.size(); ++column) {
      auto* item = m_registers->item(row, column);
      if (item == nullptr) {
        item = new QTableWidgetItem;
        if (column != 0 && column != 3) item->setFlags(item->flags() & ~Qt::ItemIsEditable);
        m_registers->setItem(row, column, item);
      }
      // A cell that is being edited keeps what the user types.
      if (item->text() != texts[column] && !m_registers->isPersistentEditorOpen(item)) item->setText(texts[column]);
    }
  }
  m_filling = false;
}

}  // namespace zerodrift::ui

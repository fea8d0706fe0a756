#include "ui/pages/machine_page.h"

#include <cmath>

#include "ui/pages/machine_start.h"
#include "ui/pages/rig_setup.h"
#include "ui/widgets/card.h"
#include "ui/widgets/channel_table.h"
#include "ui/widgets/data_table.h"
#include "ui/widgets/figure_card.h"
#include "ui/widgets/machine_drawing.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/toggle_segment.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

constexpr int device_row_px = 22;
constexpr int devices_most = 5;  // rows without scrolling: the drawing needs the rest of the height

QString htmlColor(const QColor& color) {
  return color.name();
}

/// The number in a channel's tag, which fits a disc: "T12" -> "12".
QString shortTag(const QString& tag) {
  QString digits;
  for (const QChar letter : tag) {
    if (letter.isDigit()) digits += letter;
  }
  return digits.isEmpty() ? tag.left(2) : digits.left(2);
}

/// As HTML that keeps to one line: Chinese may be broken between any two signs.
QString unbroken(const QString& text) {
  QString out;
  for (const QChar sign : text) {
    out += sign == QLatin1Char(' ') ? QStringLiteral("&nbsp;") : QString(sign).toHtmlEscaped();
    if (sign == QLatin1Char('/') || sign.script() == QChar::Script_Han) out += QStringLiteral("&#8288;");
  }
  return out;
}

}  // namespace

MachinePage::MachinePage(QWidget* parent) : Page("machine", parent) {
  m_views = new QStackedWidget(this);
  m_start = new MachineStart(this);
  connect(m_start, &MachineStart::newJobRequested, this, &MachinePage::newJobRequested);
  connect(m_start, &MachineStart::ownRecordingRequested, this, &MachinePage::ownRecordingRequested);
  connect(m_start, &MachineStart::openJobRequested, this, &MachinePage::openJobRequested);
  connect(m_start, &MachineStart::sampleRequested, this, &MachinePage::sampleRequested);
  connect(m_start, &MachineStart::virtualMachineRequested, this, &MachinePage::virtualMachineRequested);
  m_machine = makeMachine();
  m_views->addWidget(m_start);
  m_views->addWidget(m_machine);
  m_setup = new RigSetup(this);
  m_views->addWidget(m_setup);
  content()->addWidget(m_views, 1);
  refresh();
}

QWidget* MachinePage::makeMachine() {
  auto* view = new QWidget(this);
  m_drawingCard = new Card(view);
  m_profile = new QComboBox(m_drawingCard);
  m_profile->setObjectName("profile");
  m_profile->setMinimumWidth(150);
  m_profile->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  m_view = new ToggleSegment(m_drawingCard);
  m_view->setObjectName("machineView");
  m_drawingCard->tools()->addWidget(m_profile);
  m_drawingCard->tools()->addWidget(m_view);
  m_drawing = new MachineDrawing(m_drawingCard);
  m_drawingViews = new QStackedWidget(m_drawingCard);
  m_drawingViews->addWidget(m_drawing);
  m_drawingViews->addWidget(makeRegisters());
  m_parts = new WrapLabel(m_drawingCard);
  m_parts->setObjectName("partHealth");
  m_parts->setTextFormat(Qt::RichText);
  m_drawingCard->body()->addWidget(m_drawingViews, 1);
  m_drawingCard->body()->addWidget(m_parts);
  m_devices = new DataTable(m_drawingCard);
  m_devices->setObjectName("devices");
  m_devices->setRowHeight(device_row_px);
  m_deviceState = new WrapLabel(m_drawingCard);
  m_deviceState->setObjectName("deviceState");
  m_deviceState->setProperty("role", "caption");
  m_drawingCard->body()->addWidget(m_devices);
  m_drawingCard->body()->addWidget(m_deviceState);

  m_sensorCard = new Card(view);
  m_sensorCard->setBodyMargins(1, 0, 1, 6);
  m_sensorCard->setMinimumWidth(416);
  m_sensorCard->setMaximumWidth(510);  // the longest names of sensors
  m_table = new ChannelTable(m_sensorCard);
  m_table->setColumnWidths(68, 104);
  m_sensorCard->body()->addWidget(m_table);

  auto* all = new QHBoxLayout(view);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(16);
  all->addWidget(m_drawingCard, 5);
  all->addWidget(m_sensorCard, 4);

  connect(m_profile, &QComboBox::activated, this, &MachinePage::profileChosen);
  connect(m_devices, &DataTable::rowSelected, this, &MachinePage::renderDevices);
  connect(m_view, &ToggleSegment::currentChanged, this, &MachinePage::viewShown);
  connect(m_drawing, &MachineDrawing::selected, this, [this](const QString& id) {
    m_table->select(id);
    Q_EMIT sensorSelected(id);
  });
  connect(m_table, &ChannelTable::selected, this, [this](const QString& id) {
    m_drawing->select(id);
    Q_EMIT sensorSelected(id);
  });
  return view;
}

QWidget* MachinePage::makeRegisters() {
  auto* panel = new QWidget(m_drawingCard);
  m_registers = new RegisterTable(panel);
  m_mapNotes = new WrapLabel(panel);
  m_mapNotes->setProperty("role", "caption");
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  const QStringList names = {"mapImport", "mapAdd", "mapRemove", "mapSave"};
  for (const QString& name : names) {
    auto* button = new QPushButton(panel);
    button->setObjectName(name);
    row->addWidget(button);
    m_mapButtons.append(button);
  }
  row->addWidget(m_mapNotes, 1);
  auto* all = new QVBoxLayout(panel);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(m_registers, 1);
  all->addLayout(row);
  connect(m_registers, &RegisterTable::edited, this, &MachinePage::registerEdited);
  connect(m_registers, &RegisterTable::rowSelected, this, [this] { renderRegisters(); });
  connect(m_mapButtons[0], &QPushButton::clicked, this, &MachinePage::registersImportRequested);
  connect(m_mapButtons[1], &QPushButton::clicked, this, &MachinePage::registerAdded);
  connect(m_mapButtons[2], &QPushButton::clicked, this, [this] { Q_EMIT registerRemoved(m_registers->currentRow()); });
  connect(m_mapButtons[3], &QPushButton::clicked, this, &MachinePage::registersSaveRequested);
  return panel;
}

void MachinePage::showView(int index) {
  m_view->setCurrentIndex(index);
}

void MachinePage::viewShown(int index) {
  m_drawingViews->setCurrentIndex(index);
  m_sensorCard->setVisible(index == 0);  // the registers need the room
  renderParts();
  renderDevices();
  Q_EMIT registersShown(index == 1);
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
  if (m_state.settingUp) return tr("Add devices and cameras, test each, and say which signal is which; then save.");
  if (startsVirtual()) return tr("The machine of this job is a virtual one: start it, or connect to another.");
  if (!m_state.connected && m_state.manual) {
    return tr("This control has no link: connect to the devices, and answer what is asked about the control.");
  }
  if (!m_state.connected) return tr("Choose the connection profile and connect to the controller.");
  if (tableLost()) {
    return tr("The machine does not hold version %1, which this job has written: bring it back in Upload, or start "
              "again.")
        .arg(m_state.writtenVersion);
  }
  if (m_state.compensationOn && m_state.writtenVersion > 0) {
    return tr("The machine compensates with version %1 of this job: go on in the list on the left. Switch the "
              "compensation off only to measure anew.")
        .arg(m_state.writtenVersion);
  }
  if (m_state.compensationOn)
    return tr("Switch the compensation off: with it on, nothing can be measured for the model.");
  const RestState& rest = m_state.rest;
  if (!std::isnan(rest.change_K_h) && std::abs(rest.change_K_h) > rest.changeLimit_K_h) {
    return tr("%1 still changes by %2 K/h. You may start; the run is best when nothing changes any more.")
        .arg(rest.quickest)
        .arg(fixedText(rest.change_K_h, 1));
  }
  if (rest.spread_K > rest.spreadLimit_K && !std::isnan(rest.change_K_h)) {
    return tr("%1 stands %2 K apart from the others and rests there: that does no harm. Start when all sensors live.")
        .arg(rest.warmest)
        .arg(std::abs(rest.apart_K), 0, 'f', 1);
  }
  if (m_state.writtenVersion > 0) {
    return tr("This job has written version %1. Starting again measures anew, with the compensation off; what the "
              "machine "
              "holds stays until you write another table.")
        .arg(m_state.writtenVersion);
  }
  return tr("Check that every sensor is alive and the machine is at rest and of even temperature.");
}

bool MachinePage::startsVirtual() const {
  return m_state.jobOpen && m_state.virtualOffered && !m_state.connected && !m_state.connecting;
}

bool MachinePage::tableLost() const {
  return m_state.jobOpen && m_state.connected && m_state.writtenVersion > 0 && m_state.tableGone;
}

PageAction MachinePage::startAction(const QString& id) const {
  return {id, tr("Start commissioning"), !m_state.compensationOn,
          tr("The compensation is ON. Measuring for the model is locked until it is switched off."),
          m_state.writtenVersion > 0
              ? tr("Looks at the machine again and goes on to the calibration. Nothing is written and nothing is lost: "
                   "what was measured stays in the job, and the machine keeps its table.")
              : QString()};
}

PageAction MachinePage::primary() const {
  if (!m_state.jobOpen) return {"primary", {}, false, {}};
  if (m_state.settingUp) {
    return {"primary", tr("Save and use"), m_state.setupValid, tr("First mend what is named above."),
            tr("Saves the profile and uses it in this job")};
  }
  if (startsVirtual()) {
    return {"primary",
            tr("Start the virtual machine"),
            true,
            {},
            tr("The machine of this job is a virtual one. It starts anew, cold; its tables are in this job.")};
  }
  if (!m_state.connected) {
    const bool chosen = m_state.profile >= 0;
    return {"primary", tr("Connect"), chosen && !m_state.connecting,
            chosen ? tr("The connection is being made.") : tr("Choose or import a connection profile first.")};
  }
  if (tableLost()) {
    return {"primary",
            tr("Bring the table back"),
            true,
            {},
            tr("Opens Upload, which compares the table with what the machine holds and asks before it writes.")};
  }
  return startAction("primary");
}

QVector<PageAction> MachinePage::secondary() const {
  if (!m_state.jobOpen) return {{"import", tr("Import profile")}};
  if (m_state.settingUp) {
    return {{"setup-open", tr("Open profile")},
            {"setup-save-as", tr("Save as"), m_state.setupValid, tr("First mend what is named above.")},
            {"setup-leave", tr("Back to the machine")}};
  }
  QVector<PageAction> actions = {
      {"job", tr("Other job")},
      {"import", tr("Import profile")},
      {"setup", tr("Set up"), true, {}, tr("Devices, cameras and signals of this profile, or of a new one")}};
  if (m_state.connected) {
    actions.append({"test", tr("Test again")});
    actions.append({"disconnect", tr("Disconnect")});
    if (tableLost()) actions.append(startAction("start"));
  } else if (startsVirtual()) {
    actions.append({"connect", tr("Connect")});
  }
  return actions;
}

QVector<Figure> MachinePage::figures() const {
  if (!m_state.jobOpen || m_state.settingUp) return {};
  const auto alive = std::count_if(m_state.sensors.begin(), m_state.sensors.end(),
                                   [](const SensorHealth& s) { return s.judgement == Judgement::ok; });
  Figure sensors = figureOf(tr("Sensors alive"), m_state.known() ? static_cast<double>(alive) : NAN, 0,
                            tr("of %1").arg(m_state.sensors.size()));
  if (m_state.known()) {
    const bool all = alive == m_state.sensors.size();
    sensors.judgement = all ? Judgement::ok : Judgement::warn;
    sensors.word = all ? tr("all") : tr("%n to check", nullptr, static_cast<int>(m_state.sensors.size() - alive));
  }
  if (m_state.manual) return {sensors, restFigure(), devicesFigure()};
  Figure clock = figureAtMost(tr("Clock difference"), m_state.clockDifference_s, 1, "s", m_state.clockLimit_s);
  clock.tip = tr("Controller's clock minus this computer's.");
  return {sensors, restFigure(),
          figureAtMost(tr("Round trip"), m_state.roundTrip_ms, 1, "ms", m_state.roundTripLimit_ms), clock};
}

/// Of a control without a link: nothing else is asked, and the clock is this computer's.
Figure MachinePage::devicesFigure() const {
  const auto answering = std::count_if(m_state.devices.begin(), m_state.devices.end(),
                                       [](const DeviceHealth& d) { return d.judgement == Judgement::ok; });
  const bool known = m_state.connected && !m_state.devices.isEmpty();
  Figure figure = figureOf(tr("Devices that answer"), known ? static_cast<double>(answering) : NAN, 0,
                           tr("of %1").arg(m_state.devices.size()));
  if (!known) return figure;
  const auto silent = static_cast<int>(m_state.devices.size() - answering);
  figure.judgement = silent == 0 ? Judgement::ok : Judgement::warn;
  figure.word = silent == 0 ? tr("all") : tr("%n to check", nullptr, silent);
  return figure;
}

Figure MachinePage::restFigure() const {
  const RestState& rest = m_state.rest;
  Figure figure = figureAtMost(rest.atStart ? tr("Spread at the start") : tr("Spread at rest"), rest.spread_K, 2, "K",
                               rest.spreadLimit_K);
  if (figure.judgement == Judgement::none) return figure;
  if (rest.atStart) {
    const bool even = rest.spread_K <= rest.spreadLimit_K;
    figure.judgement = even ? Judgement::ok : Judgement::warn;  // never worse, as in the report
    figure.word = even ? tr("even") : tr("uneven");
    if (!std::isnan(rest.now_K)) figure.limit = tr("now %1 K").arg(rest.now_K, 0, 'f', 2);
    figure.tip =
        tr("Warmest less coldest of the sensors that live, each by the mean of its readings, when the "
           "commissioning began. The report says the same.");
    return figure;
  }
  const bool even = rest.spread_K <= rest.spreadLimit_K;
  const bool watched = !std::isnan(rest.change_K_h);
  const bool steady = watched && std::abs(rest.change_K_h) <= rest.changeLimit_K_h;
  figure.judgement = even || steady ? Judgement::ok : Judgement::warn;
  figure.word = even ? tr("even") : steady ? tr("steady") : watched ? tr("still settling") : tr("uneven");
  if (!even && !std::isnan(rest.apart_K))
    figure.limit = tr("%1 %2 K").arg(rest.warmest, (rest.apart_K > 0 ? "+" : "") + fixedText(rest.apart_K, 1));
  if (watched && !steady) {
    figure.limit = tr("%1 %2 K/h").arg(rest.quickest, (rest.change_K_h > 0 ? "+" : "") + fixedText(rest.change_K_h, 1));
  }
  figure.tip = tr("Warmest less coldest of the sensors that live, each by the mean of its last readings. It forbids "
                  "nothing: a sensor by a motor that always holds is always warmer. What counts is that nothing "
                  "changes any more (%1 K/h) when the run begins.")
                   .arg(rest.changeLimit_K_h);
  return figure;
}

void MachinePage::render() {
  setFigures(figures());
  // The start page is as high as its list; the machine's need not be.
  m_start->setSizePolicy(QSizePolicy::Preferred, m_state.jobOpen ? QSizePolicy::Ignored : QSizePolicy::Preferred);
  m_setup->setSizePolicy(QSizePolicy::Preferred, m_state.settingUp ? QSizePolicy::Preferred : QSizePolicy::Ignored);
  QWidget* shown = !m_state.jobOpen ? static_cast<QWidget*>(m_start) : m_state.settingUp ? m_setup : m_machine;
  m_views->setCurrentWidget(shown);
  m_start->setState(m_state.recent, m_state.sampleAvailable);
  renderMachine();
  renderParts();
  renderDevices();
  renderRegisters();
}

void MachinePage::renderMachine() {
  // The name stands in the list of profiles beside it.
  m_drawingCard->setTitle(m_state.connected ? m_state.address.section(QStringLiteral(", "), 0, 0)
                          : m_state.known() ? tr("As of %1").arg(m_state.keptFrom)
                                            : tr("Not connected"));
  m_drawingCard->setToolTip(m_state.address);
  m_view->setItems({tr("Drawing"), tr("Registers")});
  m_view->setVisible(!m_state.manual);  // without a link there are no registers
  if (m_state.manual) m_view->setCurrentIndex(0);
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
    const bool live = m_state.known() && !std::isnan(s.value_C);
    const QString value = live ? tr("%1 °C").arg(fixedText(s.value_C, 2)) : QStringLiteral("–");
    QString state = s.state;
    if (live && s.judgement == Judgement::ok) {
      state = std::isnan(s.age_s) ? QString() : tr("%1 s").arg(s.age_s, 0, 'f', 0);
      // The noise takes a few readings.
      if (!std::isnan(s.noise_K)) state += tr("  ±%1 K").arg(s.noise_K, 0, 'f', 2);
    }
    rows.append({s.id,
                 s.tag + QStringLiteral("  ") + s.label,
                 value,
                 state,
                 m_state.known() ? s.judgement : Judgement::none,
                 {},
                 true,
                 s.tag + ": " + s.label + (s.state.isEmpty() ? QString() : ", " + s.state)});
    // At rest all are alike: colours spread over at least 3 K, so that noise does not look like heat.
    const double span = std::max(3.0, warmest - coldest);
    spots.append({s.id, shortTag(s.tag), s.tag + QStringLiteral("  ") + s.label, s.place, s.along, value,
                  m_state.known() ? s.judgement : Judgement::none, live ? (s.value_C - coldest) / span : -1.0});
  }
  m_table->setRows(rows);
  m_drawing->setSensors(spots);
  m_drawing->setConnected(m_state.known());
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
                          unbroken(part.label), unbroken(part.value)));
  }
  m_parts->setText(words.join(" &nbsp;&nbsp; "));
  m_parts->setVisible(m_state.connected && !words.isEmpty() && m_view->currentIndex() == 0);
}

void MachinePage::renderDevices() {
  m_devices->setAccessibleName(tr("Devices"));
  m_devices->setColumns({{tr("Device"), 116, false, {}},
                         {tr("Round trip"), 84, true, tr("From the request to the last answer")},
                         {tr("Age"), 62, true, tr("Since the last answer")},
                         {tr("Missed"), 68, true, tr("Requests without an answer since the connection was made")},
                         {tr("State"), 0, false, {}}});
  QVector<QVector<DataCell>> rows;
  const DeviceHealth* said = nullptr;  // the selected one, else the first that does not answer
  for (int i = 0; i < m_state.devices.size(); ++i) {
    const DeviceHealth& device = m_state.devices[i];
    const bool bad = device.judgement == Judgement::bad;
    const QString word = bad                                 ? tr("does not answer")
                         : device.judgement == Judgement::ok ? tr("answers")
                                                             : tr("not asked yet");
    const QString state = device.state.isEmpty() ? word : device.state;
    const QString whole = device.remedy.isEmpty() ? state : state + QLatin1Char(' ') + device.remedy;
    rows.append(
        {{device.id, device.judgement, true, {}, {}, false, false, false, device.id + ": " + word},
         {std::isnan(device.roundTrip_ms) ? QStringLiteral("–") : tr("%1 ms").arg(fixedText(device.roundTrip_ms, 1))},
         {std::isnan(device.age_s) ? QStringLiteral("–") : tr("%1 s").arg(fixedText(device.age_s, 1))},
         {QString::number(device.missed),
          Judgement::none,
          false,
          {},
          {},
          false,
          false,
          false,
          tr("%1 of %2").arg(device.missed).arg(device.rounds)},
         {state, device.judgement, false, {}, {}, false, false, bad, whole}});
    const bool selected = i == m_devices->currentRow() && !device.state.isEmpty();
    if (selected || (bad && said == nullptr)) said = &device;
  }
  m_devices->setRows(rows);
  m_devices->setFixedHeight(m_devices->heightOfRows() -
                            device_row_px * std::max(0, m_devices->rowCount() - devices_most));
  const bool visible = m_state.connected && !rows.isEmpty() && m_view->currentIndex() == 0;
  m_devices->setVisible(visible);
  m_deviceState->setText(said == nullptr ? QString() : said->id + ": " + said->state);
  m_deviceState->setToolTip(said == nullptr ? QString() : said->remedy);
  m_deviceState->setVisible(visible && said != nullptr);
}

void MachinePage::renderRegisters() {
  const QStringList texts = {tr("Import"), tr("Add"), tr("Remove"), tr("Save")};
  const QStringList tips = {tr("Registers from a CSV list or a map file"), tr("A register more"),
                            tr("Take the selected register out"), tr("Save the map and use it")};
  for (int i = 0; i < texts.size(); ++i) {
    m_mapButtons[i]->setText(texts[i]);
    m_mapButtons[i]->setToolTip(tips[i]);
  }
  m_mapButtons[2]->setEnabled(m_registers->currentRow() >= 0);
  m_mapButtons[3]->setEnabled(m_state.mapChanged);
  m_mapNotes->setText(m_state.mapNotes);
  m_registers->setHeaders();
  m_registers->setNames(m_state.registerNames);
  m_registers->setRows(m_state.registers);
}

}  // namespace zerodrift::ui

#include "app/desktop/rig_editor.h"

#include <QDir>
#include <QFileDialog>
#include <filesystem>

#include "app/text/core_text.h"
#include "app/text/error_text.h"
#include "core/base/json.h"
#include "core/base/json_path.h"
#include "core/controller/device_templates.h"

namespace zerodrift::desktop {

using controller::ProfileDraft;
using nlohmann::json;
using ui::SignalTable;

namespace {

/// An entry of this kind as it is added: what must be said is empty.
json new_entry(const std::string& kind) {
  for (const auto& one : controller::device_templates()) {
    if (kind == "template:" + one.name) return one.entry;
  }
  if (kind == "mqtt") return {{"id", "broker"}, {"kind", kind}, {"host", ""}};
  if (kind == "mtconnect") return {{"id", "agent"}, {"kind", kind}, {"url", ""}};
  json entry = {{"id", "device"}, {"kind", kind}, {"unit", 1}};
  entry[kind == "modbus-rtu" ? "device" : "host"] = "";
  entry["register_map_document"] = {
      {"format", "zerodrift-register-map/1"},
      {"name", "own"},
      {"registers", {{"temperature_C", {{"address", 0}, {"type", "int16"}, {"count", 1}, {"scale", 0.1}}}}}};
  return entry;
}

std::string text_in(const json* object, const char* key) {
  if (object == nullptr || !object->is_object()) return {};
  const auto at = object->find(key);
  return at != object->end() && at->is_string() ? at->get<std::string>() : std::string();
}

}  // namespace

RigEditor::RigEditor(Workbench& bench, ui::MachinePage* page)
    : QObject(page), m_bench(bench), m_page(page), m_view(page->rigSetup()) {
  connectPage();
  connect(&m_liveTimer, &QTimer::timeout, this, &RigEditor::showValues);
  connect(&m_pictureTimer, &QTimer::timeout, this, &RigEditor::showPicture);
  connect(&m_tasks, &TaskRunner::progressed, this, [this](double fraction) {
    m_fraction = fraction;
    m_view->setProgress(m_busy, m_fraction);
  });
}

RigEditor::~RigEditor() {
  m_tasks.end();
}

void RigEditor::connectPage() {
  using ui::RigSetup;
  connect(m_view, &RigSetup::selected, this, [this](const QString& path) {
    if (m_busy.isEmpty()) {
      m_found.clear();
      m_result.clear();
    }
    m_current = path;
    setPreview(false);
  });
  connect(m_view, &RigSetup::edited, this, &RigEditor::edit);
  connect(m_view, &RigSetup::addRequested, this, &RigEditor::add);
  connect(m_view, &RigSetup::removeRequested, this, [this](const QString& path) {
    m_draft.remove(path.toStdString());
    m_current = machine_item;
    changed();
  });
  connect(m_view, &RigSetup::undoRequested, this, &RigEditor::undo);
  connect(m_view, &RigSetup::redoRequested, this, &RigEditor::redo);
  connect(m_view, &RigSetup::findRequested, this, &RigEditor::find);
  connect(m_view, &RigSetup::testRequested, this, &RigEditor::test);
  connect(m_view, &RigSetup::cancelRequested, &m_tasks, &TaskRunner::cancel);
  connect(m_view, &RigSetup::foundChosen, this, [this](int row) {
    if (row < 0 || row >= static_cast<int>(m_found.size())) return;
    if (const auto take = m_found[static_cast<std::size_t>(row)].take) take();
  });
  connect(m_view, &RigSetup::sensorsOfDeviceRequested, this, [this] {
    const int added = m_draft.add_sensors_of(text_in(selected(), "id"));
    say(tr("%n sensor(s) added; see Signals.", nullptr, added), ui::Judgement::ok);
    changed();
  });
  connect(m_view, &RigSetup::signalEdited, this, &RigEditor::editSignal);
  connect(m_view, &RigSetup::sensorAdded, this, [this] {
    m_draft.add_sensor("", "");
    changed();
  });
  connect(m_view, &RigSetup::sensorRemoved, this, [this](int row) {
    const auto rows = controller::signal_rows(m_draft.document());
    if (row >= 0 && row < static_cast<int>(rows.size())) m_draft.remove(rows[static_cast<std::size_t>(row)].place);
    changed();
  });
  connect(m_view, &RigSetup::liveToggled, this, &RigEditor::setLive);
  connect(m_view, &RigSetup::previewToggled, this, &RigEditor::setPreview);
  connect(m_view, &RigSetup::regionDrawn, this, [this](const QRectF& region) {
    const QRect whole = region.toRect();
    m_draft.set(m_current.toStdString(), "target_roi_px", json{whole.x(), whole.y(), whole.width(), whole.height()});
    changed();
  });
  connect(m_view, &RigSetup::languageChanged, this, &RigEditor::refresh);
}

std::string RigEditor::origin() const {
  const auto& profile = m_bench.profile();
  return profile ? profile->file + json_text(m_bench.profileDocument()) : "new";
}

void RigEditor::begin() {
  const auto& profile = m_bench.profile();
  const std::string of = origin();
  if (of != m_of || !m_draft.changed()) {
    m_draft = ProfileDraft();
    std::error_code none;
    if (profile && std::filesystem::is_regular_file(profile->file, none)) {
      if (auto draft = ProfileDraft::open(profile->file)) m_draft = std::move(*draft);
    } else if (profile) {
      m_draft = ProfileDraft(m_bench.profileDocument(), "");  // a job's own
    }
    m_of = of;
    m_current = machine_item;
  }
  m_open = true;
  changed();
}

void RigEditor::leave() {
  setLive(false);
  setPreview(false);
  m_tasks.cancel();
  m_open = false;
  Q_EMIT stateChanged();
}

void RigEditor::forget() {
  if (m_open) leave();
  m_draft = ProfileDraft();
  m_of.clear();
}

void RigEditor::undo() {
  m_draft.undo();
  changed();
}

void RigEditor::redo() {
  m_draft.redo();
  changed();
}

void RigEditor::add(const QString& kind) {
  m_found.clear();
  m_result.clear();
  m_current = QString::fromStdString(
      kind == QStringLiteral("camera") ? m_draft.add_camera("") : m_draft.add_device(new_entry(kind.toStdString())));
  setPreview(false);
  changed();
}

void RigEditor::edit(const QString& path, const QString& key, const QString& value) {
  const std::string place = path == machine_item ? std::string() : path.toStdString();
  const std::string text = value.trimmed().toStdString();
  if (key == QStringLiteral("kind")) {
    m_draft.set_kind(place, kindOf(value));
  } else if (key == QStringLiteral("errors.source")) {
    m_draft.set(place, "errors.source", value == probesWords() ? "probes" : "camera");
  } else if (key == QStringLiteral("tls")) {
    m_draft.enter(place, "tls", value == RigWords::tr("yes") ? "true" : "");
  } else if (key.startsWith(QStringLiteral("register."))) {
    const auto map = m_draft.map_at(place);
    const std::string field = key.mid(9).toStdString();
    const Status taken = map ? m_draft.set_register(place, mainRegister(*map), field, text) : fail(map.error());
    if (!taken) say(lineOf(taken.error(), Reader::window), ui::Judgement::bad);
  } else {
    m_draft.enter(place, key.toStdString(), text);
  }
  changed();
}

void RigEditor::editSignal(int row, int column, const QString& text) {
  const auto rows = controller::signal_rows(m_draft.document());
  if (row < 0 || row >= static_cast<int>(rows.size())) return;
  const controller::SignalRow& signal = rows[static_cast<std::size_t>(row)];
  const std::string typed = text.trimmed().toStdString();
  switch (column) {
    case SignalTable::name:
      m_draft.enter(signal.place, "channel", typed);
      break;
    case SignalTable::label:
      m_draft.enter(signal.place, "label", typed);
      break;
    case SignalTable::device: {
      const bool none = text == controlWords() || text == QStringLiteral("–");
      const bool other = typed != signal.source.device;
      m_draft.assign(signal.place, none ? "" : typed, none || other ? "" : signal.source.signal);
      break;
    }
    case SignalTable::signal:
      if (!signal.source.device.empty() || signal.use == controller::SignalUse::sensor)
        m_draft.assign(signal.place, signal.source.device, typed);
      break;
    case SignalTable::scale: {
      const std::string name = signal.source.signal.substr(0, signal.source.signal.find('['));
      const std::string place = controller::place_of_device(m_draft.document(), signal.source.device);
      if (const Status taken = m_draft.set_register(place, name, "scale", typed); !taken) Q_EMIT refused(taken.error());
      break;
    }
    default:
      return;
  }
  m_watches.erase(signal.place);
  // The table's own editor is still closing.
  QMetaObject::invokeMethod(this, &RigEditor::changed, Qt::QueuedConnection);
}

void RigEditor::changed() {
  const auto read = m_draft.profile();
  m_valid = read.has_value();
  m_problem = read ? std::nullopt : std::optional<Error>(read.error());
  readAgain();
  refresh();
  Q_EMIT stateChanged();
}

const json* RigEditor::selected() const {
  return m_current == machine_item ? nullptr : node_at(m_draft.document(), m_current.toStdString());
}

std::string RigEditor::selectedKind() const {
  if (m_current.startsWith(QStringLiteral("cameras["))) return "camera";
  return text_in(selected(), "kind");
}

void RigEditor::refresh() {
  if (!m_open) return;
  ui::RigSetupState state;
  state.form.items = rigItems(m_draft);
  const bool there = std::any_of(state.form.items.begin(), state.form.items.end(),
                                 [this](const ui::FormItem& item) { return item.path == m_current; });
  if (!there) m_current = machine_item;
  state.form.current = m_current;
  state.form.offers = rigOffers();
  state.form.canUndo = m_draft.can_undo();
  state.canRedo = m_draft.can_redo();
  state.file = QString::fromStdString(m_draft.file());
  state.changed = m_draft.changed();
  state.lines = rigLines(m_draft, m_watches, m_said);
  const auto control = controller::place_of_device(m_draft.document(), "");
  const bool by_hand = text_in(node_at(m_draft.document(), control), "kind") == "manual";
  state.devices << (by_hand ? QStringLiteral("–") : controlWords());
  for (const ui::FormItem& item : std::as_const(state.form.items)) {
    if (item.path.startsWith(QStringLiteral("devices[")) && item.path.toStdString() != control)
      state.devices << item.title;
  }
  state.live = m_liveOn;
  state.canLive = m_valid;
  fillSelected(state);
  tellProblem(state);
  m_view->setState(state);
}

void RigEditor::fillSelected(ui::RigSetupState& state) const {
  const std::string kind = selectedKind();
  const bool modbus = kind == "modbus-tcp" || kind == "modbus-rtu";
  if (kind == "modbus-rtu") state.searches << QStringLiteral("ports") << QStringLiteral("units");
  if (kind == "modbus-tcp" || kind == "mtconnect") state.searches << QStringLiteral("network");
  if (kind == "camera") state.searches << QStringLiteral("cameras");
  state.canTest = modbus || kind == "mqtt" || kind == "mtconnect";
  state.isCamera = kind == "camera";
  state.preview = m_camera != nullptr;
  if (modbus && m_current.startsWith(QStringLiteral("devices["))) {
    const auto map = m_draft.map_at(m_current.toStdString());
    state.canAddSensors = map && map->find("temperature_C") != nullptr;
  }
  state.busy = m_busy;
  state.fraction = m_fraction;
  for (const Found& one : m_found) state.found.append(one.shown);
  state.result = m_result;
  state.resultJudgement = m_resultJudgement;
}

/// At its field or cell where there is one for it.
void RigEditor::tellProblem(ui::RigSetupState& state) const {
  if (!m_problem) return;
  const ErrorText text = textOf(*m_problem, Reader::window);
  state.sentence = text.sentence;
  state.remedy = text.remedy;
  const auto at = m_problem->context.find("key");
  if (at == m_problem->context.end()) return;
  const QString key = QString::fromStdString(at->second);
  const auto wanted = m_problem->context.find("expected");
  const QString expected =
      wanted == m_problem->context.end() ? state.sentence : tr("Expected: %1").arg(coreText(wanted->second));
  const bool missing = m_problem->code == ErrorCode::json_missing_key;
  const auto say = [&](const QString& title, const QString& label) {
    state.sentence = missing ? tr("%1, %2: something must be entered.").arg(title, label)
                             : tr("%1, %2: this value cannot be.").arg(title, label);
    state.remedy = expected;
  };
  for (ui::FormItem& item : state.form.items) {
    for (ui::FormField& field : item.fields) {
      if (key != (item.path == machine_item ? field.key : item.path + QLatin1Char('.') + field.key)) continue;
      field.problem = expected;
      return say(item.title, field.label);
    }
  }
  const auto rows = controller::signal_rows(m_draft.document());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const QString place = QString::fromStdString(rows[i].place) + QLatin1Char('.');
    if (!key.startsWith(place)) continue;
    ui::SignalLine& line = state.lines[static_cast<qsizetype>(i)];
    const QString last = key.mid(place.size());
    line.problemColumn = last == QStringLiteral("channel")  ? SignalTable::name
                         : last == QStringLiteral("device") ? SignalTable::device
                                                            : SignalTable::signal;
    line.problem = expected;
    return say(tr("Signals"), line.name);
  }
}

Status RigEditor::load(const QString& path) {
  ZD_TRY(m_draft, ProfileDraft::open(path.toStdString()));
  m_of = origin();
  m_current = machine_item;
  changed();
  return {};
}

Status RigEditor::save(const QString& path) {
  ZD_CHECK(m_bench.idle());
  ZD_CHECK(m_draft.save(path.toStdString()));
  ZD_CHECK(m_bench.loadProfile(path.toStdString()));
  m_of = origin();
  leave();
  Q_EMIT taken();
  return {};
}

void RigEditor::chooseSave(bool another) {
  QString path = QString::fromStdString(m_draft.file());
  if (another || path.isEmpty()) {
    const QString proposal = path.isEmpty() ? m_bench.folder() + QStringLiteral("/profile.json") : path;
    path = QFileDialog::getSaveFileName(m_page, tr("Save profile"), proposal, tr("Profiles (*.json)"));
    if (path.isEmpty()) return;
    if (!path.endsWith(QStringLiteral(".json"))) path += QStringLiteral(".json");
  }
  if (const Status saved = save(path); !saved) Q_EMIT refused(saved.error());
}

void RigEditor::chooseOpen() {
  const QString path =
      QFileDialog::getOpenFileName(m_page, tr("Open profile"), m_bench.folder(), tr("Profiles (*.json)"));
  if (path.isEmpty()) return;
  if (const Status read = load(path); !read) Q_EMIT refused(read.error());
}

}  // namespace zerodrift::desktop

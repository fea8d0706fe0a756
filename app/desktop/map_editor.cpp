#include "app/desktop/map_editor.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <algorithm>

#include "app/text/core_text.h"
#include "app/text/error_text.h"
#include "core/base/json.h"
#include "core/controller/modbus_machine.h"
#include "core/controller/register_names.h"

namespace zerodrift::desktop {

using controller::Register;
using controller::RegisterMap;
using nlohmann::json;
using ui::RegisterTable;

namespace {

// High word and byte first, then the word, the byte, and both turned.
constexpr std::array<const char*, 4> orders = {"ABCD", "CDAB", "BADC", "DCBA"};

QString order_of(const Register& entry) {
  return QString::fromLatin1(orders.at((entry.high_word_first ? 0U : 1U) + (entry.high_byte_first ? 0U : 2U)));
}

ui::RegisterRow row_of(const Register& entry, const json& document) {
  const auto* known = controller::find_register_name(entry.name);
  ui::RegisterRow row;
  row.name = QString::fromStdString(entry.name);
  row.meaning = known == nullptr ? QCoreApplication::translate("zerodrift::desktop::MapEditor", "no use known")
                                 : coreText(std::string(known->meaning));
  row.address = entry.address;
  row.function = entry.space == controller::RegisterSpace::input ? QStringLiteral("input") : QStringLiteral("holding");
  row.type = QString::fromStdString(document.value("type", ""));
  row.count = entry.count;
  row.scale = QString::number(entry.sign * entry.scale, 'g', 8);
  row.order = order_of(entry);
  return row;
}

/// What was typed into a cell, as the map's JSON has it; what it cannot be the map's reader tells.
void put(json& entry, int column, const QString& text) {
  bool whole = false;
  const int number = text.toInt(&whole);
  const json as_typed = whole ? json(number) : json(text.toStdString());
  switch (column) {
    case RegisterTable::address:
      entry["address"] = as_typed;
      break;
    case RegisterTable::function:
      entry["function"] = text.toStdString();
      break;
    case RegisterTable::type:
      entry["type"] = text.toStdString();
      break;
    case RegisterTable::count:
      entry["count"] = as_typed;
      break;
    case RegisterTable::scale: {
      bool real = false;
      const double value = text.toDouble(&real);
      entry["scale"] = real ? json(std::abs(value)) : json(text.toStdString());
      entry["sign"] = real && value < 0.0 ? -1 : 1;
      break;
    }
    case RegisterTable::order: {
      const auto at = std::find(orders.begin(), orders.end(), text.toUpper());
      const auto turned = static_cast<unsigned>(at - orders.begin());
      entry["word_order"] = at == orders.end() ? text.toStdString() : (turned & 1U) != 0 ? "low_first" : "high_first";
      entry["byte_order"] = at != orders.end() && (turned & 2U) != 0 ? "low_first" : "high_first";
      break;
    }
    default:
      break;
  }
}

}  // namespace

MapEditor::MapEditor(Workbench& bench, ui::MachinePage* page) : QObject(page), m_bench(bench), m_page(page) {
  connect(&bench, &Workbench::profileChanged, this, &MapEditor::load);
  connect(page, &ui::MachinePage::registersShown, this, [this](bool shown) {
    m_shown = shown;
    watch();
  });
  connect(page, &ui::MachinePage::registerEdited, this, &MapEditor::edit);
  connect(page, &ui::MachinePage::registerAdded, this, &MapEditor::add);
  connect(page, &ui::MachinePage::registerRemoved, this, &MapEditor::remove);
  connect(page, &ui::MachinePage::registersImportRequested, this, &MapEditor::chooseImport);
  connect(page, &ui::MachinePage::registersSaveRequested, this, &MapEditor::chooseSave);
}

void MapEditor::load() {
  const auto& profile = m_bench.profile();
  std::string of;
  if (profile) {
    of = profile->file + "\n" + profile->controller.register_map + (profile->manual ? "\nmanual" : "");
    if (profile->controller.own_map) of += profile->controller.own_map->dump();
  }
  if (of == m_of && m_draft) return;
  m_of = of;
  m_draft.reset();
  m_changed = false;
  if (profile && !profile->manual) {  // without a link there is nothing to read by a map
    auto map = controller::map_of(*profile);
    if (map) {
      m_draft = std::move(*map);
    } else {
      Q_EMIT refused(map.error());
    }
  }
  watch();
  Q_EMIT draftChanged();
}

void MapEditor::watch() {
  m_bench.watchRegisters(m_shown && m_draft ? std::make_shared<const RegisterMap>(*m_draft) : nullptr);
}

std::vector<std::string> MapEditor::order() const {
  std::vector<const Register*> entries;
  if (m_draft) {
    for (const auto& [name, entry] : m_draft->registers) entries.push_back(&entry);
  }
  std::sort(entries.begin(), entries.end(), [](const Register* a, const Register* b) {
    return std::tie(a->space, a->address, a->name) < std::tie(b->space, b->address, b->name);
  });
  std::vector<std::string> names;
  for (const Register* entry : entries) names.push_back(entry->name);
  return names;
}

void MapEditor::fill(ui::MachineState& state) {
  for (const auto& name : controller::register_names()) {
    state.registerNames << QString::fromUtf8(name.name.data(), static_cast<int>(name.name.size()));
  }
  if (!m_draft) return;
  const auto& look = m_bench.look();
  for (const auto& name : order()) {
    const Register& entry = m_draft->registers.at(name);
    ui::RegisterRow row = row_of(entry, controller::to_json(entry));
    if (look) {
      for (const auto& value : look->registers) {
        if (value.name != name) continue;
        row.failed = !value.result;
        row.value = value.result ? coreText(controller::text_of(value, entry)) : tr("refused");
        row.raw = value.result ? QString::fromStdString(value.raw) : lineOf(value.result.error(), Reader::window);
      }
    }
    state.registers.append(row);
  }
  QStringList notes = {QString::fromStdString(m_draft->name) + (m_changed ? tr(", changed: save it to use it") : "")};
  for (const auto& use : controller::uses_of(*m_draft)) {
    if (use.missing.empty()) continue;
    const auto first = QString::fromStdString(use.missing.front());
    const QString name = coreText(std::string(use.use));
    notes << (use.missing.size() == 1
                  ? tr("no %1 without %2").arg(name, first)
                  : tr("no %1 without %2 and %n more", nullptr, static_cast<int>(use.missing.size()) - 1)
                        .arg(name, first));
  }
  state.mapNotes = notes.join(QStringLiteral("; "));
  state.mapChanged = m_changed;
}

Status MapEditor::take(const json& document) {
  auto map = controller::register_map_from_json(document, m_draft ? m_draft->file : "");
  if (!map) return fail(map.error());
  m_draft = std::move(*map);
  m_changed = true;
  watch();
  return {};
}

void MapEditor::edit(int row, int column, const QString& text) {
  const auto names = order();
  if (row < 0 || row >= static_cast<int>(names.size())) return;
  const std::string& name = names[static_cast<std::size_t>(row)];
  json document = controller::to_json(*m_draft);
  json& registers = document["registers"];
  Status taken;
  if (column == RegisterTable::name) {
    const std::string wanted = text.trimmed().toStdString();
    if (wanted.empty() || (wanted != name && registers.contains(wanted))) {
      taken = fail(ErrorCode::bad_argument, {{"what", "the name of a register"},
                                             {"found", wanted.empty() ? "none" : wanted + ", a second time"},
                                             {"expected", "a name of its own"}});
    } else {
      json entry = registers.at(name);
      registers.erase(name);
      registers[wanted] = std::move(entry);
      taken = take(document);
    }
  } else {
    put(registers[name], column, text.trimmed());
    taken = take(document);
  }
  if (!taken) Q_EMIT refused(taken.error());
  // In any case: a refused text gives way to what is there.
  QMetaObject::invokeMethod(this, &MapEditor::draftChanged, Qt::QueuedConnection);
}

void MapEditor::add() {
  if (!m_draft) return;
  json document = controller::to_json(*m_draft);
  json& registers = document["registers"];
  int number = 1;
  while (registers.contains("register_" + std::to_string(number))) ++number;
  int free = 0;
  for (const auto& [name, entry] : m_draft->registers) free = std::max(free, entry.address + entry.words());
  registers["register_" + std::to_string(number)] = {{"address", std::min(free, 65535)}, {"type", "uint16"}};
  if (const Status taken = take(document); !taken) Q_EMIT refused(taken.error());
  Q_EMIT draftChanged();
}

void MapEditor::remove(int row) {
  const auto names = order();
  if (row < 0 || row >= static_cast<int>(names.size())) return;
  json document = controller::to_json(*m_draft);
  document["registers"].erase(names[static_cast<std::size_t>(row)]);
  if (const Status taken = take(document); !taken) Q_EMIT refused(taken.error());
  Q_EMIT draftChanged();
}

Status MapEditor::import(const QString& path) {
  std::vector<std::string> warnings;
  ZD_TRY(RegisterMap map, controller::read_register_list(path.toStdString(), -1, &warnings));
  for (const auto& warning : warnings) m_bench.log(LogKind::warning, coreText(warning));
  m_draft = std::move(map);
  m_changed = true;
  watch();
  Q_EMIT draftChanged();
  return {};
}

Status MapEditor::save(const QString& path) {
  if (!m_draft) return {};
  RegisterMap named = *m_draft;
  named.name = QFileInfo(path).completeBaseName().toStdString();
  ZD_CHECK(write_json_file(path.toStdString(), controller::to_json(named)));
  m_changed = false;
  m_of.clear();
  return m_bench.setRegisterMap(path.toStdString());
}

void MapEditor::chooseImport() {
  const QString path = QFileDialog::getOpenFileName(m_page, tr("Registers"), m_bench.folder(),
                                                    tr("Register lists and maps (*.csv *.txt *.json);;All files (*)"));
  if (path.isEmpty()) return;
  if (const Status taken = import(path); !taken) Q_EMIT refused(taken.error());
}

void MapEditor::chooseSave() {
  const QString path = QFileDialog::getSaveFileName(
      m_page, tr("Save register map"), m_bench.folder() + QStringLiteral("/registers.json"), tr("Maps (*.json)"));
  if (path.isEmpty()) return;
  if (const Status written = save(path); !written) Q_EMIT refused(written.error());
}

}  // namespace zerodrift::desktop

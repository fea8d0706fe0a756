#pragma once
// What the set-up of a rig is called in the user's language: kinds of devices, quantities, judgements; and its document
// as items of a form and lines of a table.

#include <QCoreApplication>
#include <QString>
#include <QVector>
#include <map>

#include "core/controller/profile_draft.h"
#include "core/controller/profile_signals.h"
#include "ui/pages/rig_setup.h"

namespace zerodrift::desktop {

struct RigWords {
  Q_DECLARE_TR_FUNCTIONS(RigWords)
};

/// Of "modbus-rtu" and the others; and back.
QString kindWords(const std::string& kind);
std::string kindOf(const QString& words);
QString templateWords(const std::string& name);
/// "Room temperature", "Position X"; of a sensor its channel.
QString quantityWords(const controller::SignalRow& row);
QString plausibilityWords(controller::Plausibility judgement);
ui::Judgement judgementOf(controller::Plausibility judgement);
/// Of what measures the errors, where it is not the cameras.
QString probesWords();
/// By whom a quantity is read when no device is named.
QString controlWords();

/// Place of the item that has name and position of the machine.
inline const QString machine_item = QStringLiteral("machine");
QVector<ui::FormItem> rigItems(const controller::ProfileDraft& draft);
QVector<ui::FormOffer> rigOffers();
/// The register that a module's form shows: its temperatures or probes, else the first one. Empty: none.
std::string mainRegister(const controller::RegisterMap& map);

using Watches = std::map<std::string, controller::SignalWatch>;
/// What a device that is no Modbus device has said that it has, by its id.
using SaidSignals = std::map<std::string, QStringList>;
QVector<ui::SignalLine> rigLines(const controller::ProfileDraft& draft, const Watches& watches,
                                 const SaidSignals& said);
/// Registers of a Modbus device's map, one for each value.
QStringList signalsOf(const controller::ProfileDraft& draft, const std::string& device);

}  // namespace zerodrift::desktop

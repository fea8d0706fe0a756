#pragma once
// The engineer's PIN in the window: asked for before the first write after a lock, set and taken away from the lamp at
// the bottom. The PIN is hashed on a thread of its own: that takes longer than a window may stand still.

#include <QObject>
#include <optional>

#include "core/access/permit.h"

class QWidget;

namespace zerodrift::desktop {

class Workbench;

/// The right to write; asks for the PIN when it is locked. Nothing when the person gives up.
std::optional<access::Permit> permit_for(Workbench& bench, QWidget* parent, const QString& operation);

/// Asks for the PIN and unlocks; false when the person gives up.
bool unlock(Workbench& bench, QWidget* parent, const QString& why);

/// Sets, changes or takes away the PIN of this computer.
void change_pin(Workbench& bench, QWidget* parent);

/// Locks when nobody has touched the window for the idle time.
class IdleLock : public QObject {
  Q_OBJECT

 public:
  IdleLock(Workbench& bench, QObject* parent);
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  Workbench& m_bench;
};

/// Locks now, says so in the log and in the job's audit trail.
void lock(Workbench& bench, const QString& why);

}  // namespace zerodrift::desktop

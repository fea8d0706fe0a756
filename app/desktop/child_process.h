#pragma once
// Processes that belong to the application: they end with it, whatever ends it.

#include <QProcess>

namespace zerodrift::desktop {

/// Before start(): the child gets SIGTERM when the thread that starts it ends, also by kill -9 or a crash.
void end_with_parent(QProcess& process);

}  // namespace zerodrift::desktop

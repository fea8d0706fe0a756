#pragma once
// SIGTERM, SIGINT and SIGHUP end the application as closing its window does, without asking: what was recorded is
// whole in the job, and the processes it started are ended.

class QCoreApplication;

namespace zerodrift::desktop {

/// From now on; the program's exit code is then 128 + the signal's number, as shells count.
void quit_on_signals(QCoreApplication& application);

}  // namespace zerodrift::desktop

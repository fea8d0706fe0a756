#include "app/desktop/child_process.h"

#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace zerodrift::desktop {

void end_with_parent(QProcess& process) {
  // Between fork and exec only calls that are safe there. The signal is of the parent's death; a parent that died
  // before it was asked for is recognised by another process having taken its place.
  process.setChildProcessModifier([parent = ::getpid()] {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(1);
  });
}

}  // namespace zerodrift::desktop

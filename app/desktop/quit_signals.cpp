#include "app/desktop/quit_signals.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <QCoreApplication>
#include <QSocketNotifier>

namespace zerodrift::desktop {
namespace {

int told_end = -1;  // where the handler writes to: almost nothing else is allowed in it

void tell(int signal) {
  const auto number = static_cast<unsigned char>(signal);
  [[maybe_unused]] const auto written = ::write(told_end, &number, 1);
}

}  // namespace

void quit_on_signals(QCoreApplication& application) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) return;
  told_end = ends[1];
  auto* notifier = new QSocketNotifier(ends[0], QSocketNotifier::Read, &application);
  QObject::connect(notifier, &QSocketNotifier::activated, &application, [from = ends[0]] {
    unsigned char number = 0;
    if (::read(from, &number, 1) == 1) QCoreApplication::exit(128 + number);
  });
  struct sigaction action {};
  action.sa_handler = tell;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) ::sigaction(signal, &action, nullptr);
}

}  // namespace zerodrift::desktop

#pragma once
// What a test of the window needs: settings and files apart from the user's own, and a theme.

#include <QApplication>
#include <QSettings>
#include <QTemporaryDir>

#include "app/desktop/workbench.h"
#include "core/flow/step.h"
#include "ui/shell/theme.h"

namespace zerodrift::desktop {

/// Puts what the test has made up into the open job, as if its step had been done.
inline bool keeps(Workbench& bench, const commissioning::NewArtefact& made) {
  for (const auto& step : flow::standard_steps()) {
    if (step.makes != made.kind) continue;
    return bench.takeIn(step.id, [&made](auto&, const auto&) -> Result<commissioning::NewArtefact> { return made; })
        .has_value();
  }
  return false;
}

/// Made when the test object is, which QTEST_MAIN makes after the application.
class TestHome {
 protected:
  TestHome() {
    if (!m_folder.isValid()) qFatal("no temporary folder");
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, m_folder.path());
    QSettings::setDefaultFormat(QSettings::NativeFormat);
  }

  QTemporaryDir m_folder;
  ui::Theme m_theme{*qApp};
};

}  // namespace zerodrift::desktop

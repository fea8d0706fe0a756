#pragma once
// What a test of the window needs: settings and files apart from the user's own, and a theme.

#include <QApplication>
#include <QSettings>
#include <QTemporaryDir>

#include "ui/shell/theme.h"

namespace zerodrift::desktop {

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

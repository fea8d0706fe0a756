#pragma once
// Light or dark: palette, style sheet and fonts of the whole application. One object, made in main.

#include <QObject>

class QApplication;
class QDBusVariant;

namespace zerodrift::ui {

enum class ThemeMode {
  system,  // as the desktop says, also when it changes its mind
  light,
  dark,
};

class Theme : public QObject {
  Q_OBJECT

 public:
  explicit Theme(QApplication& application);
  void setMode(ThemeMode mode);
  ThemeMode mode() const { return m_mode; }
  bool isDark() const { return m_dark; }

 Q_SIGNALS:
  void changed();

 private Q_SLOTS:
  void desktopSettingChanged(const QString& group, const QString& key, const QDBusVariant& value);

 private:
  void askDesktop();
  void apply();

  ThemeMode m_mode = ThemeMode::system;
  bool m_desktopDark = false;
  bool m_dark = false;
};

}  // namespace zerodrift::ui

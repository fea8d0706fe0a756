#include "ui/shell/theme.h"

#include <QDBusConnection>
#include <QDBusMessage>
#include <QDBusPendingCallWatcher>
#include <QDBusPendingReply>
#include <QDBusVariant>

#include "ui/shell/style_sheet.h"
#include "ui/widgets/colors.h"

namespace zerodrift::ui {
namespace {

// The desktop's wish comes from the settings portal, which GNOME, KDE and the smaller desktops all serve.
const char* const portalService = "org.freedesktop.portal.Desktop";
const char* const portalPath = "/org/freedesktop/portal/desktop";
const char* const portalInterface = "org.freedesktop.portal.Settings";
const char* const appearance = "org.freedesktop.appearance";
const char* const scheme = "color-scheme";  // 1: dark is preferred, 2: light, 0: no preference

QPalette paletteOf(const Colors& c) {
  QPalette p;
  p.setColor(QPalette::Window, c.window);
  p.setColor(QPalette::WindowText, c.text);
  p.setColor(QPalette::Base, c.panel);
  p.setColor(QPalette::AlternateBase, c.window);
  p.setColor(QPalette::Text, c.text);
  p.setColor(QPalette::PlaceholderText, c.muted);
  p.setColor(QPalette::Button, c.panel);
  p.setColor(QPalette::ButtonText, c.text);
  p.setColor(QPalette::BrightText, c.bad);
  p.setColor(QPalette::Highlight, c.accent);
  p.setColor(QPalette::HighlightedText, c.onAccent);
  p.setColor(QPalette::Link, c.accent);
  p.setColor(QPalette::LinkVisited, c.accent);
  p.setColor(QPalette::ToolTipBase, c.panel);
  p.setColor(QPalette::ToolTipText, c.text);
  p.setColor(QPalette::Light, c.panel);
  p.setColor(QPalette::Midlight, c.grid);
  p.setColor(QPalette::Mid, c.line);
  p.setColor(QPalette::Dark, c.line);
  p.setColor(QPalette::Shadow, c.line);
  const QColor off = mix(c.muted, c.panel, 0.35);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    p.setColor(QPalette::Disabled, role, off);
  }
  return p;
}

}  // namespace

Theme::Theme(QApplication& application) : QObject(&application) {
  // Before anything is set, the palette is what the platform theme made of the desktop's choice.
  m_desktopDark = QGuiApplication::palette().color(QPalette::Window).lightness() < 128;
  for (const char* weight : {"regular", "medium", "semibold"}) {
    QFontDatabase::addApplicationFont(QStringLiteral(":/fonts/zerodrift-sans-%1.otf").arg(weight));
  }
  QApplication::setStyle(QStyleFactory::create("Fusion"));
  QApplication::setFont(uiFont(13));
  askDesktop();
  apply();
}

void Theme::setMode(ThemeMode mode) {
  if (mode == m_mode) return;
  m_mode = mode;
  apply();
}

void Theme::askDesktop() {
  QDBusConnection bus = QDBusConnection::sessionBus();
  if (!bus.isConnected()) return;
  bus.connect(portalService, portalPath, portalInterface, "SettingChanged", this,
              SLOT(desktopSettingChanged(QString, QString, QDBusVariant)));
  QDBusMessage question = QDBusMessage::createMethodCall(portalService, portalPath, portalInterface, "Read");
  question << QString(appearance) << QString(scheme);
  auto* watcher = new QDBusPendingCallWatcher(bus.asyncCall(question, 2000), this);
  connect(watcher, &QDBusPendingCallWatcher::finished, this, [this](QDBusPendingCallWatcher* done) {
    const QDBusPendingReply<QDBusVariant> reply = *done;
    if (!reply.isError()) desktopSettingChanged(appearance, scheme, reply.value());
    done->deleteLater();
  });
}

void Theme::desktopSettingChanged(const QString& group, const QString& key, const QDBusVariant& value) {
  if (group != appearance || key != scheme) return;
  QVariant inner = value.variant();
  // Read wraps its answer twice, the signal once.
  if (inner.canConvert<QDBusVariant>()) inner = inner.value<QDBusVariant>().variant();
  m_desktopDark = inner.toUInt() == 1;
  apply();
}

void Theme::apply() {
  m_dark = m_mode == ThemeMode::dark || (m_mode == ThemeMode::system && m_desktopDark);
  const Colors& c = m_dark ? darkColors() : lightColors();
  QApplication::setPalette(paletteOf(c));
  qApp->setStyleSheet(styleSheet(c));
  Q_EMIT changed();
}

}  // namespace zerodrift::ui

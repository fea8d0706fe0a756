#include "ui/shell/style_sheet.h"

#include "ui/widgets/colors.h"

namespace zerodrift::ui {
namespace {

// @name stands for a colour. Heights include the 1 px border.
const char* const sheet = R"(
QToolTip { background: @panel; color: @text; border: 1px solid @line; padding: 4px 6px; }
*[card="true"] { background: @panel; border: 1px solid @line; border-radius: 6px; }
*[card="true"]:focus { border-color: @accent; }
QLabel[role="cardTitle"] { font-size: 13px; font-weight: 600; color: @text; }
QLabel[role="heading"] { font-size: 16px; font-weight: 600; color: @text; }
QLabel[role="pageTitle"] { font-size: 20px; font-weight: 600; color: @text; }
QLabel[role="strong"] { font-weight: 600; }
QLabel[role="caption"] { font-size: 12px; color: @muted; }
QLabel[role="muted"] { color: @muted; }
QLabel[role="ok"] { color: @okText; font-weight: 600; }
QLabel[role="warn"] { color: @warnText; font-weight: 600; }
QLabel[role="bad"] { color: @badText; font-weight: 600; }

QPushButton, QToolButton { background: @panel; color: @text; border: 1px solid @buttonLine; border-radius: 4px;
  min-height: 30px; padding: 0 14px; outline: 0; }
QPushButton:hover, QToolButton:hover { background: @hover; }
QPushButton:pressed, QToolButton:pressed { background: @grid; }
QPushButton:focus, QToolButton:focus { border: 2px solid @accent; padding: 0 13px; min-height: 28px; }
QPushButton:disabled, QToolButton:disabled { color: @off; border-color: @line; }
QPushButton:checked { background: @accentSoft; border-color: @accent; color: @accentText; font-weight: 600; }
QPushButton[primary="true"] { background: @accent; color: @onAccent; border: 1px solid @accent; font-weight: 600; }
QPushButton[primary="true"]:hover { background: @accentHover; }
QPushButton[primary="true"]:pressed { background: @accentDown; }
QPushButton[primary="true"]:focus { border: 2px solid @text; }
QPushButton[primary="true"]:disabled { background: @line; border-color: @line; color: @muted; }
QPushButton[big="true"] { min-height: 38px; padding: 0 18px; }
QPushButton[big="true"]:focus { min-height: 36px; padding: 0 17px; }
QPushButton[danger="true"] { color: @badText; border-color: @badText; }
QPushButton[role="tool"] { border-color: transparent; background: transparent; min-width: 30px; padding: 0; }
QPushButton[role="tool"]:hover { background: @hover; }
QPushButton[role="tool"]:focus { border: 2px solid @accent; padding: 0; }
QPushButton[role="link"] { border-color: transparent; background: transparent; color: @accentText; padding: 0 6px; }
QPushButton[role="link"]:hover { background: @accentSoft; }
QPushButton[role="link"]:focus { border: 2px solid @accent; padding: 0 5px; }
QPushButton[segment] { border-radius: 0; border-right-width: 0; min-height: 26px; padding: 0 12px; font-size: 12px; }
QPushButton[segment="first"] { border-top-left-radius: 4px; border-bottom-left-radius: 4px; }
QPushButton[segment="last"] { border-top-right-radius: 4px; border-bottom-right-radius: 4px; border-right-width: 1px; }
QPushButton[segment="only"] { border-radius: 4px; border-right-width: 1px; }
QPushButton[segment]:checked { border: 1px solid @accent; }
QPushButton[segment]:focus { border: 2px solid @accent; padding: 0 11px; min-height: 24px; }
QPushButton::menu-indicator { subcontrol-position: right center; right: 6px; }

QLineEdit, QSpinBox, QDoubleSpinBox, QComboBox, QPlainTextEdit, QTextEdit, QDateEdit { background: @panel; color: @text;
  border: 1px solid @buttonLine; border-radius: 4px; selection-background-color: @accent;
  selection-color: @onAccent; }
QLineEdit, QSpinBox, QDoubleSpinBox, QComboBox, QDateEdit { min-height: 30px; padding: 0 8px; }
QLineEdit:focus, QSpinBox:focus, QDoubleSpinBox:focus, QComboBox:focus, QPlainTextEdit:focus, QTextEdit:focus,
QDateEdit:focus { border: 2px solid @accent; }
QLineEdit:focus, QSpinBox:focus, QDoubleSpinBox:focus, QComboBox:focus, QDateEdit:focus { min-height: 28px; padding: 0 7px; }
QLineEdit:disabled, QSpinBox:disabled, QDoubleSpinBox:disabled, QComboBox:disabled { color: @off; background: @window; }
QComboBox::drop-down { border: 0; width: 24px; }
QComboBox::down-arrow { image: url(:/icons/down-@theme.png); width: 16px; height: 16px; }
QSpinBox::up-button, QDoubleSpinBox::up-button { border: 0; width: 22px; subcontrol-position: top right; }
QSpinBox::down-button, QDoubleSpinBox::down-button { border: 0; width: 22px; subcontrol-position: bottom right; }
QSpinBox::up-arrow, QDoubleSpinBox::up-arrow { image: url(:/icons/up-@theme.png); width: 14px; height: 14px; }
QSpinBox::down-arrow, QDoubleSpinBox::down-arrow { image: url(:/icons/down-@theme.png); width: 14px; height: 14px; }
QCheckBox::indicator, QListView::indicator { width: 16px; height: 16px; border: 1px solid @buttonLine; border-radius: 3px; background: @panel; }
QCheckBox::indicator:checked, QListView::indicator:checked { background: @accent; border-color: @accent; image: url(:/icons/check-@theme.png); }
QCheckBox::indicator:disabled { border-color: @line; background: @window; }
QComboBox QAbstractItemView { background: @panel; color: @text; border: 1px solid @line; selection-background-color: @accentSoft;
  selection-color: @text; outline: 0; }
QCheckBox, QRadioButton { spacing: 8px; min-height: 28px; outline: 0; }
QCheckBox:focus, QRadioButton:focus { color: @accentText; }

QProgressBar { background: @grid; border: 0; border-radius: 3px; }
QProgressBar::chunk { background: @accent; border-radius: 3px; }

QAbstractItemView { background: @panel; border: 0; outline: 0; selection-background-color: @accentSoft; selection-color: @text; }
QTableView, QTreeView, QListView { background: @panel; gridline-color: @grid; alternate-background-color: @window; }
QTableView:focus, QListView:focus, QTreeView:focus { border: 1px solid @accent; }
QTableView::item { padding: 0 6px; border-bottom: 1px solid @grid; }
QTableView::item:selected { background: @accentSoft; color: @text; }
QHeaderView { background: @panel; border: 0; }
QHeaderView::section { background: @panel; color: @muted; border: 0; border-bottom: 1px solid @line; padding: 0 6px; font-size: 12px; }
QTableCornerButton::section { background: @panel; border: 0; }

QScrollArea, QScrollArea > QWidget > QWidget[role="body"] { background: @window; border: 0; }
QScrollArea[role="plain"], QScrollArea[role="plain"] > QWidget, #explanations { background: @panel; border: 0; }
QScrollBar:vertical { background: transparent; width: 12px; margin: 0; }
QScrollBar:horizontal { background: transparent; height: 12px; margin: 0; }
QScrollBar::handle { background: @handle; border-radius: 4px; margin: 2px; min-height: 28px; min-width: 28px; }
QScrollBar::handle:hover { background: @muted; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QSplitter::handle { background: transparent; }
QSplitter::handle:hover { background: @accentSoft; }

QMenu { background: @panel; color: @text; border: 1px solid @line; padding: 4px; }
QMenu::item { padding: 6px 24px 6px 12px; border-radius: 4px; }
QMenu::item:selected { background: @accentSoft; color: @text; }
QMenu::item:disabled { color: @off; }
QMenu::separator { height: 1px; background: @line; margin: 4px 0; }

#header, #footer { background: @panel; }
#header { border-bottom: 1px solid @line; }
#footer { border-top: 1px solid @line; }
#logDrawer { background: @panel; border-top: 1px solid @line; }
#helpPanel { background: @panel; border-left: 1px solid @line; }
#helpPanel QTextBrowser { border: 0; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
#paletteBox { background: @panel; border: 1px solid @buttonLine; border-radius: 8px; }
)";

}  // namespace

QString styleSheet(const Colors& c) {
  const QVector<QPair<QString, QColor>> names = {
      {"accentHover", mix(c.accent, c.dark ? QColor(Qt::white) : QColor(Qt::black), 0.12)},
      {"accentDown", mix(c.accent, QColor(Qt::black), 0.22)},
      {"accentSoft", c.soft(c.accent)},
      {"accentText", c.dark ? c.accent : QColor("#0B5CA3")},
      {"onAccent", c.onAccent},
      {"accent", c.accent},
      {"buttonLine", mix(c.line, c.muted, 0.45)},
      {"badText", c.badText},
      {"warnText", c.warnText},
      {"okText", c.okText},
      {"handle", mix(c.line, c.muted, 0.3)},
      {"hover", mix(c.panel, c.grid, c.dark ? 0.9 : 0.8)},
      {"window", c.window},
      {"panel", c.panel},
      {"muted", c.muted},
      {"text", c.text},
      {"line", c.line},
      {"grid", c.grid},
      {"off", mix(c.muted, c.panel, 0.35)},
  };
  // Longer names first where one begins another.
  QString text = sheet;
  text.replace("@theme", c.dark ? "dark" : "light");
  for (const auto& [name, color] : names) text.replace('@' + name, color.name());
  return text;
}

}  // namespace zerodrift::ui

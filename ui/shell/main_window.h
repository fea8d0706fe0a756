#pragma once
// The window: step rail, head with title and one sentence, the open page, footer with lamps, Back and one primary
// button. It draws what it is told and decides nothing: which page may open, what a button does, is the presenter's.

#include <QDateTime>
#include <QMainWindow>
#include <QString>
#include <QVector>

#include "ui/shell/command_palette.h"
#include "ui/shell/rail.h"
#include "ui/widgets/colors.h"

class QHBoxLayout;
class QLabel;
class QPushButton;
class QShortcut;
class QStackedWidget;

namespace zerodrift::ui {

class HelpPanel;
class Lamp;
class LogDrawer;
class Page;

enum class LampId {
  controller,
  recording,
  camera,
  compensation,
  access,
};

class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  explicit MainWindow(QWidget* parent = nullptr);
  /// Of the window without its frame on a desktop that leaves so much room beside its panels: as large as it is made
  /// for, and no larger than fits. The smallest is what the pages are laid out for, unless less fits.
  static QSize firstSize(const QSize& available);
  static QSize smallestSize(const QSize& available);
  ~MainWindow() override;

  /// Pages stand in the rail in the order they are added; the window owns them.
  /// branch: a page beside the main line (axis errors).
  void addPage(Page* page, bool branch = false);
  Page* page(const QString& id) const;
  Page* currentPage() const;
  void setCurrentPage(const QString& id);
  void setStepState(const QString& id, StepState state, const QString& words);
  void setBackEnabled(bool enabled);

  void setLamp(LampId lamp, const QString& text, Judgement judgement, bool strong = false);
  void setJob(const QString& job, const QString& engineer);
  void setLanguageName(const QString& name);
  /// Off while there is one language only.
  void setLanguagesOffered(bool offered);
  void appendLog(const QDateTime& time, Judgement judgement, const QString& text);
  void setLogVisible(bool visible);
  bool isLogVisible() const;
  /// Opens the help of the open page, or closes it.
  void toggleHelp();
  void enableEscape();
  /// Another page of the help: "keys", "about".
  void openHelp(const QString& id);
  bool isHelpVisible() const;
  /// Beside steps and page actions, which the window knows itself.
  void setExtraCommands(const QVector<Command>& commands);

  StepRail* rail() const { return m_rail; }
  QPushButton* primaryButton() const { return m_primary; }
  QPushButton* backButton() const { return m_back; }

 Q_SIGNALS:
  void stepRequested(const QString& id);
  void backRequested();
  void jobRequested();
  void languageRequested();
  void themeRequested();
  void undoRequested();
  void openRequested();
  void paletteOpening();  // the extra commands may be set anew
  void filesDropped(const QStringList& paths);
  void commandRequested(const QString& id);  // one of the extra commands
  void lampClicked(zerodrift::ui::LampId lamp);
  void closing(bool* allowed);  // set *allowed to false to keep the window open

 protected:
  void changeEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  QWidget* makeHead();
  QWidget* makeFoot();
  void makeShortcuts();
  void openPalette();
  void runCommand(const QString& id);
  void showHead();
  void showWork();
  void retranslate();
  void placeHelp();
  /// Before a control is switched off or removed: Qt would give its focus to the next one, which nobody asked for.
  void keepFocusOff(QWidget* going);

  StepRail* m_rail;
  QLabel* m_title;
  QLabel* m_sentence;
  QHBoxLayout* m_actions;
  QStackedWidget* m_stack;
  LogDrawer* m_log;
  HelpPanel* m_help;
  QShortcut* m_escape = nullptr;
  QHBoxLayout* m_progress;
  bool m_languagesOffered = true;
  QVector<Lamp*> m_lamps;
  QPushButton* m_back;
  QPushButton* m_primary;
  CommandPalette* m_palette;
  QVector<Page*> m_pages;
  QVector<Command> m_extraCommands;
};

}  // namespace zerodrift::ui

#include "ui/shell/main_window.h"

#include "ui/pages/page.h"
#include "ui/shell/help_panel.h"
#include "ui/shell/lamp.h"
#include "ui/shell/log_drawer.h"

namespace zerodrift::ui {

namespace {

constexpr QSize frame{4, 40};         // borders and title bar, at most as wide on common desktops
constexpr QSize made_for{1280, 720};  // the pages scroll where they are lower, and cannot be narrower
constexpr int lowest = 600;

}  // namespace

QSize MainWindow::smallestSize(const QSize& available) {
  return {made_for.width(), std::clamp(available.height() - frame.height(), lowest, made_for.height())};
}

QSize MainWindow::firstSize(const QSize& available) {
  return QSize(1440, 900).boundedTo(available - frame).expandedTo(smallestSize(available));
}

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent) {
  setWindowTitle("Zerodrift");
  const QSize available = QGuiApplication::primaryScreen()->availableSize();
  setMinimumSize(smallestSize(available));
  resize(firstSize(available));
  setAcceptDrops(true);
  m_rail = new StepRail(this);
  m_stack = new QStackedWidget(this);
  m_log = new LogDrawer(this);
  m_log->hide();

  auto* right = new QVBoxLayout;
  right->setContentsMargins(0, 0, 0, 0);
  right->setSpacing(0);
  right->addWidget(makeHead());
  right->addWidget(m_stack, 1);
  right->addWidget(m_log);
  right->addWidget(makeFoot());
  auto* centre = new QWidget(this);
  auto* all = new QHBoxLayout(centre);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(0);
  all->addWidget(m_rail);
  all->addLayout(right, 1);
  setCentralWidget(centre);
  // No control starts with the focus: a ring around the first one would look like a choice.
  centre->setFocusPolicy(Qt::ClickFocus);
  centre->setFocus();
  m_help = new HelpPanel(centre);
  m_help->hide();
  m_palette = new CommandPalette(centre);

  connect(m_rail, &StepRail::stepRequested, this, &MainWindow::stepRequested);
  connect(m_rail, &StepRail::jobClicked, this, &MainWindow::jobRequested);
  connect(m_rail, &StepRail::languageClicked, this, &MainWindow::languageRequested);
  connect(m_rail, &StepRail::themeClicked, this, &MainWindow::themeRequested);
  connect(m_rail, &StepRail::helpClicked, this, &MainWindow::toggleHelp);
  connect(m_help, &HelpPanel::closeRequested, this, &MainWindow::toggleHelp);
  connect(m_help, &HelpPanel::pageWanted, this, &MainWindow::openHelp);
  connect(m_log, &LogDrawer::closeRequested, this, [this] { setLogVisible(false); });
  connect(m_palette, &CommandPalette::chosen, this, &MainWindow::runCommand);
  makeShortcuts();
  retranslate();
}

MainWindow::~MainWindow() = default;

QWidget* MainWindow::makeHead() {
  auto* head = new QFrame(this);
  head->setObjectName("header");
  head->setFixedHeight(76);
  m_title = new QLabel(head);
  m_title->setObjectName("pageTitle");
  m_title->setProperty("role", "pageTitle");
  m_sentence = new QLabel(head);
  m_sentence->setObjectName("pageSentence");
  m_sentence->setProperty("role", "muted");
  m_sentence->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  m_sentence->setWordWrap(true);  // two lines when many actions stand beside it
  auto* words = new QVBoxLayout;
  words->setSpacing(2);
  words->addStretch();
  words->addWidget(m_title);
  words->addWidget(m_sentence);
  words->addStretch();
  m_actions = new QHBoxLayout;
  m_actions->setSpacing(8);
  auto* all = new QHBoxLayout(head);
  all->setContentsMargins(24, 4, 24, 4);
  all->setSpacing(16);
  all->addLayout(words, 1);
  all->addLayout(m_actions);
  return head;
}

QWidget* MainWindow::makeFoot() {
  auto* foot = new QFrame(this);
  foot->setObjectName("footer");
  foot->setFixedHeight(60);
  auto* all = new QHBoxLayout(foot);
  all->setContentsMargins(24, 8, 24, 8);
  all->setSpacing(20);
  const QStringList names = {"controller", "recording", "camera", "compensation", "access"};
  for (int i = 0; i < names.size(); ++i) {
    auto* lamp = new Lamp(names[i], foot);
    lamp->setVisible(static_cast<LampId>(i) != LampId::access);  // a window without anybody's rights has none
    m_lamps.append(lamp);
    all->addWidget(lamp);
    connect(lamp, &Lamp::clicked, this, [this, i] { Q_EMIT lampClicked(static_cast<LampId>(i)); });
  }
  all->addStretch(1);
  // Progress stands here, where nothing has to make room for it.
  m_progress = new QHBoxLayout;
  all->addLayout(m_progress);
  m_back = new QPushButton(foot);
  m_back->setObjectName("back");
  m_primary = new QPushButton(foot);
  m_primary->setObjectName("primary");
  m_primary->setProperty("primary", true);
  for (QPushButton* button : {m_back, m_primary}) button->setProperty("big", true);
  auto* pair = new QHBoxLayout;
  pair->setSpacing(8);
  pair->addWidget(m_back);
  pair->addWidget(m_primary);
  all->addLayout(pair);
  connect(m_back, &QPushButton::clicked, this, &MainWindow::backRequested);
  connect(m_primary, &QPushButton::clicked, this, [this] {
    Page* now = currentPage();
    if (now != nullptr && now->isNotNeeded()) return Q_EMIT now->goOnTriggered();
    if (now != nullptr) Q_EMIT now->primaryTriggered();
  });
  return foot;
}

void MainWindow::makeShortcuts() {
  const auto on = [this](const QKeySequence& keys, auto action) {
    auto* shortcut = new QShortcut(keys, this);
    connect(shortcut, &QShortcut::activated, this, action);
  };
  on(QKeySequence("Ctrl+L"), [this] { setLogVisible(!m_log->isVisible()); });
  on(QKeySequence("Ctrl+K"), [this] { openPalette(); });
  on(QKeySequence("Ctrl+Z"), [this] { Q_EMIT undoRequested(); });
  on(QKeySequence("Ctrl+O"), [this] { Q_EMIT openRequested(); });
  on(QKeySequence("F1"), [this] { toggleHelp(); });
  on(QKeySequence("Shift+F1"), [this] { openHelp("keys"); });
  m_escape = new QShortcut(QKeySequence("Esc"), this);
  m_escape->setEnabled(false);  // on while the help or the log is open, wherever the focus is
  connect(m_escape, &QShortcut::activated, this, [this] {
    if (m_help->isVisible()) return toggleHelp();
    setLogVisible(false);
  });
  on(QKeySequence("Ctrl+Q"), [this] { close(); });
  on(QKeySequence("Ctrl+Return"), [this] { m_primary->click(); });
  on(QKeySequence("Alt+Left"), [this] { m_back->click(); });
}

void MainWindow::addPage(Page* page, bool branch) {
  auto* scroll = new QScrollArea(m_stack);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setWidget(page);
  m_stack->addWidget(scroll);
  m_pages.append(page);
  m_rail->addStep(page->id(), page->title(), branch);
  m_progress->addWidget(page->progressStrip());
  connect(page, &Page::refreshed, this, [this, page] {
    if (StepButton* step = m_rail->step(page->id())) step->setTitle(page->title());
    showWork();
    if (page == currentPage()) showHead();
  });
  if (m_pages.size() == 1) setCurrentPage(page->id());
}

Page* MainWindow::page(const QString& id) const {
  for (Page* page : m_pages) {
    if (page->id() == id) return page;
  }
  return nullptr;
}

Page* MainWindow::currentPage() const {
  return m_pages.value(m_stack->currentIndex());
}

void MainWindow::setCurrentPage(const QString& id) {
  for (int i = 0; i < m_pages.size(); ++i) {
    if (m_pages[i]->id() != id || m_stack->currentIndex() == i) continue;
    if (m_stack->currentWidget() != nullptr) keepFocusOff(m_stack->currentWidget());
    m_stack->setCurrentIndex(i);
  }
  if (m_help->isVisible() && currentPage() != nullptr) {
    m_help->open(currentPage()->id());
    QTimer::singleShot(0, this, &MainWindow::placeHelp);  // when the page has its size
  }
  m_rail->setCurrent(currentPage() != nullptr ? currentPage()->id() : QString());
  showHead();
}

void MainWindow::showHead() {
  const Page* now = currentPage();
  if (now == nullptr) return;
  m_title->setText(now->title());
  m_sentence->setText(now->headSentence());
  m_sentence->setToolTip(now->headSentence());

  // Buttons are kept while their ids stay, so that focus and hover survive a live page's updates.
  QVector<PageAction> wanted;
  for (const PageAction& action : now->secondaryActions()) {
    if (!action.text.isEmpty()) wanted.append(action);
  }
  const auto buttonAt = [this](int i) { return qobject_cast<QPushButton*>(m_actions->itemAt(i)->widget()); };
  bool same = m_actions->count() == wanted.size();
  for (int i = 0; same && i < wanted.size(); ++i) same = buttonAt(i)->objectName() == "action-" + wanted[i].id;
  if (!same) {
    while (QLayoutItem* item = m_actions->takeAt(0)) {
      keepFocusOff(item->widget());
      item->widget()->hide();
      item->widget()->deleteLater();
      delete item;
    }
    for (const PageAction& action : wanted) {
      auto* button = new QPushButton(this);
      button->setObjectName("action-" + action.id);
      m_actions->addWidget(button);
      connect(button, &QPushButton::clicked, this, [this, id = action.id] {
        if (Page* open = currentPage()) Q_EMIT open->secondaryTriggered(id);
      });
    }
  }
  for (int i = 0; i < wanted.size(); ++i) {
    if (!wanted[i].enabled) keepFocusOff(buttonAt(i));
    buttonAt(i)->setText(wanted[i].text);
    buttonAt(i)->setEnabled(wanted[i].enabled);
    buttonAt(i)->setToolTip(wanted[i].enabled ? wanted[i].tip : wanted[i].reason);
    buttonAt(i)->setAccessibleDescription(buttonAt(i)->toolTip());
  }

  const PageAction primary = now->primaryAction();
  if (!primary.enabled || primary.text.isEmpty()) keepFocusOff(m_primary);
  m_primary->setVisible(!primary.text.isEmpty());
  m_primary->setText(primary.text);
  m_primary->setEnabled(primary.enabled);
  const QString keys = tr("%1 (Ctrl+Enter)").arg(primary.text);
  m_primary->setToolTip(!primary.enabled        ? primary.reason
                        : primary.tip.isEmpty() ? keys
                                                : keys + QLatin1Char('\n') + primary.tip);
  m_primary->setAccessibleDescription(primary.enabled ? primary.tip : primary.reason);
}

/// The progress says more than the lamp beside it, and both have no room in a small window.
void MainWindow::showWork() {
  const bool working = std::any_of(m_pages.begin(), m_pages.end(), [](const Page* page) { return page->isWorking(); });
  m_lamps[static_cast<int>(LampId::recording)]->setVisible(!working);
}

void MainWindow::setStepState(const QString& id, StepState state, const QString& words) {
  m_rail->setStepState(id, state, words);
}

void MainWindow::setBackEnabled(bool enabled) {
  if (!enabled) keepFocusOff(m_back);
  m_back->setEnabled(enabled);
}

void MainWindow::setLamp(LampId lamp, const QString& text, Judgement judgement, bool strong) {
  Lamp* shown = m_lamps[static_cast<int>(lamp)];
  shown->setState(text, judgement, strong);
  if (lamp == LampId::access) shown->setVisible(!text.isEmpty());
  // The interlock's state is never cut.
  if (lamp == LampId::compensation) shown->setMinimumWidth(shown->sizeHint().width());
}

void MainWindow::setJob(const QString& job, const QString& engineer) {
  m_rail->setJob(job, engineer);
  setWindowTitle(job.isEmpty() ? QString("Zerodrift") : job + QStringLiteral(" - Zerodrift"));
}

void MainWindow::setLanguageName(const QString& name) {
  m_rail->setLanguage(name);
}

void MainWindow::appendLog(const QDateTime& time, Judgement judgement, const QString& text) {
  m_log->append(time, judgement, text);
}

void MainWindow::setLogVisible(bool visible) {
  m_log->setVisible(visible);
  enableEscape();
}

void MainWindow::enableEscape() {
  m_escape->setEnabled(!m_help->isHidden() || !m_log->isHidden());
}

bool MainWindow::isLogVisible() const {
  return !m_log->isHidden();
}

void MainWindow::setLanguagesOffered(bool offered) {
  m_languagesOffered = offered;
  m_rail->setLanguagesOffered(offered);
}

void MainWindow::toggleHelp() {
  if (m_help->isVisible()) {
    keepFocusOff(m_help);
    m_help->hide();
    return enableEscape();
  }
  if (currentPage() != nullptr) openHelp(currentPage()->id());
}

void MainWindow::openHelp(const QString& id) {
  if (!m_help->open(id)) return;
  placeHelp();
  m_help->show();
  m_help->raise();
  enableEscape();
}

bool MainWindow::isHelpVisible() const {
  return m_help->isVisible();
}

/// At the right, from head to foot: the primary button stays in reach, and so does a consent that is asked for.
void MainWindow::placeHelp() {
  constexpr int width = 440;
  const QWidget* stack = m_stack;
  const QPoint corner = stack->mapTo(centralWidget(), QPoint(stack->width() - width, 0));
  int height = stack->height();
  const QWidget* inSight = currentPage() == nullptr ? nullptr : currentPage()->keepInSight();
  if (inSight != nullptr && inSight->isVisible()) {
    constexpr int gap = 8;
    const int top = inSight->mapTo(stack, QPoint(0, 0)).y() - gap;
    height = std::clamp(top, stack->height() / 3, stack->height());
  }
  m_help->setGeometry(QRect(corner, QSize(width, height)));
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  if (m_help->isVisible()) QTimer::singleShot(0, this, &MainWindow::placeHelp);
}

void MainWindow::keepFocusOff(QWidget* going) {
  QWidget* focused = focusWidget();
  if (focused != nullptr && (focused == going || going->isAncestorOf(focused))) centralWidget()->setFocus();
}

void MainWindow::setExtraCommands(const QVector<Command>& commands) {
  m_extraCommands = commands;
}

void MainWindow::openPalette() {
  Q_EMIT paletteOpening();
  QVector<Command> commands;
  if (const Page* now = currentPage()) {
    const PageAction primary = now->primaryAction();
    if (!primary.text.isEmpty()) {
      commands.append(
          {"primary", primary.text, tr("Action"), primary.enabled ? "Ctrl+Enter" : primary.reason, primary.enabled});
    }
    for (const PageAction& action : now->secondaryActions()) {
      commands.append({"action:" + action.id, action.text, tr("Action"), action.reason, action.enabled});
    }
  }
  for (const StepButton* step : m_rail->steps()) {
    commands.append({"step:" + step->id(), step->text(), tr("Step"), step->words(), true});
  }
  commands.append({"log", tr("Show what happened"), tr("Window"), "Ctrl+L", true});
  commands.append({"theme", tr("Switch between light and dark"), tr("Window"), {}, true});
  if (m_languagesOffered) commands.append({"language", tr("Change language"), tr("Window"), {}, true});
  commands.append({"help", tr("Help for this step"), tr("Window"), "F1", true});
  commands.append({"keys", tr("All keys"), tr("Window"), "Shift+F1", true});
  commands.append({"about", tr("About Zerodrift, licences"), tr("Window"), {}, true});
  commands.append({"quit", tr("Quit"), tr("Window"), "Ctrl+Q", true});
  commands += m_extraCommands;
  m_palette->open(commands);
}

void MainWindow::runCommand(const QString& id) {
  if (id == "primary") return m_primary->click();
  if (id.startsWith("action:")) return Q_EMIT currentPage()->secondaryTriggered(id.mid(7));
  if (id.startsWith("step:")) return Q_EMIT stepRequested(id.mid(5));
  if (id == "log") return setLogVisible(true);
  if (id == "theme") return Q_EMIT themeRequested();
  if (id == "language") return Q_EMIT languageRequested();
  if (id == "help") return toggleHelp();
  if (id == "keys" || id == "about") return openHelp(id);
  if (id == "quit") {
    close();
    return;
  }
  Q_EMIT commandRequested(id);
}

void MainWindow::retranslate() {
  m_back->setText(tr("Back"));
  m_back->setToolTip(tr("To the step before (Alt+Left). Nothing is lost by going back."));
  m_rail->retranslate();
  showHead();
}

/// A button leaves Enter to its window: the one that has the focus is pressed, as by the space bar.
void MainWindow::keyPressEvent(QKeyEvent* event) {
  const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
  auto* button = qobject_cast<QAbstractButton*>(focusWidget());
  if (enter && !(event->modifiers() & ~Qt::KeypadModifier) && button != nullptr && button->isEnabled()) {
    return button->click();
  }
  QMainWindow::keyPressEvent(event);
}

void MainWindow::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange) retranslate();
  if (event->type() == QEvent::PaletteChange || event->type() == QEvent::StyleChange) m_rail->setDark(colors().dark);
  QMainWindow::changeEvent(event);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  bool allowed = true;
  Q_EMIT closing(&allowed);
  event->setAccepted(allowed);
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  QStringList paths;
  for (const QUrl& url : event->mimeData()->urls()) {
    if (url.isLocalFile()) paths.append(url.toLocalFile());
  }
  if (!paths.isEmpty()) Q_EMIT filesDropped(paths);
  event->acceptProposedAction();
}

}  // namespace zerodrift::ui

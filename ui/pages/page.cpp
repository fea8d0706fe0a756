#include "ui/pages/page.h"

#include "ui/widgets/empty_state.h"
#include "ui/widgets/figure_card.h"
#include "ui/widgets/progress_strip.h"

namespace zerodrift::ui {

Page::Page(QString id, QWidget* parent) : QWidget(parent), m_id(std::move(id)) {
  setObjectName("page-" + m_id);
  setProperty("role", "body");
  m_banner = new ProblemBanner(this);
  m_progress = new ProgressStrip(this);
  m_empty = new EmptyState(this);
  auto* filled = new QWidget(this);
  m_content = new QVBoxLayout(filled);
  m_content->setContentsMargins(0, 0, 0, 0);
  m_content->setSpacing(16);
  m_stack = new QStackedWidget(this);
  m_stack->addWidget(filled);
  m_stack->addWidget(m_empty);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(24, 20, 24, 20);
  all->setSpacing(16);
  all->addWidget(m_banner);
  all->addWidget(m_stack, 1);
  connect(m_banner, &ProblemBanner::actionTriggered, this, &Page::problemActionTriggered);
  connect(m_progress, &ProgressStrip::cancelRequested, this, &Page::cancelRequested);
  connect(m_empty, &EmptyState::actionTriggered, this, &Page::emptyActionTriggered);
}

void Page::setNotNeeded(const QString& reason, const QStringList& kept, const QString& action) {
  if (reason == m_notNeeded && kept == m_keptActions && action == m_notNeededAction) return;
  m_notNeeded = reason;
  m_keptActions = kept;
  m_notNeededAction = action;
  showContent();  // what is shown when it is needed again is for the page to say
  refresh();
}

QString Page::headSentence() const {
  return isNotNeeded() ? tr("Not needed in this job: go on.") : sentence();
}

PageAction Page::primaryAction() const {
  if (isNotNeeded()) return {"primary", tr("Go on")};
  PageAction action = primary();
  action.id = "primary";
  const auto rule = m_allowed.constFind(action.id);
  if (action.enabled && rule != m_allowed.constEnd() && !rule->enabled) {
    action.enabled = false;
    action.reason = rule->reason;
  }
  if (m_working && !steersWork() && action.enabled) {
    action.enabled = false;
    action.reason = tr("Wait until the work is done, or cancel it.");
  }
  return action;
}

QVector<PageAction> Page::secondaryActions() const {
  QVector<PageAction> actions = secondary();
  if (isNotNeeded()) actions.removeIf([this](const PageAction& action) { return !m_keptActions.contains(action.id); });
  for (PageAction& action : actions) {
    const auto rule = m_allowed.constFind(action.id);
    if (action.enabled && rule != m_allowed.constEnd() && !rule->enabled) {
      action.enabled = false;
      action.reason = rule->reason;
    }
  }
  return actions;
}

void Page::allow(const QString& actionId, bool enabled, const QString& reason) {
  const auto before = m_allowed.constFind(actionId);
  if (before != m_allowed.constEnd() && before->enabled == enabled && before->reason == reason) return;
  m_allowed.insert(actionId, {actionId, {}, enabled, reason});
  Q_EMIT refreshed();
}

void Page::setProblem(const Problem& problem) {
  m_banner->setProblem(problem);
}

void Page::clearProblem() {
  m_banner->clear();
}

const Problem& Page::problem() const {
  return m_banner->problem();
}

void Page::setProgress(const QString& phase, double fraction, std::optional<double> secondsLeft, bool cancellable) {
  m_progress->setCancellable(cancellable);
  m_progress->setProgress(phase, fraction, secondsLeft);
  if (m_working) return;
  m_working = true;
  Q_EMIT refreshed();
}

void Page::setWaiting(const QString& what) {
  m_progress->setWaiting(what);
}

void Page::clearProgress() {
  m_progress->clear();
  if (!m_working) return;
  m_working = false;
  Q_EMIT refreshed();
}

QWidget* Page::progressStrip() const {
  return m_progress;
}

void Page::refresh() {
  render();
  if (isNotNeeded()) showEmpty(Icon::tick, tr("Not needed"), m_notNeeded, m_notNeededAction);
  Q_EMIT refreshed();
}

void Page::setFigures(const QVector<Figure>& figures) {
  if (m_figures == nullptr) {
    m_figures = new FigureRow(this);
    m_content->insertWidget(0, m_figures);
  }
  m_figures->setFigures(figures);
}

void Page::showEmpty(Icon icon, const QString& heading, const QString& sentence, const QString& action) {
  m_empty->setContent(icon, heading, sentence, action);
  m_stack->setCurrentWidget(m_empty);
}

QString Page::notYet() {
  return tr("Not yet: an earlier step comes first.");
}

void Page::showContent() {
  m_stack->setCurrentIndex(0);
}

bool Page::isEmpty() const {
  return m_stack->currentWidget() == m_empty;
}

void Page::changeEvent(QEvent* event) {
  // The palette changes with the theme: pages colour cells and curves while they render.
  if (event->type() == QEvent::LanguageChange || event->type() == QEvent::PaletteChange) refresh();
  QWidget::changeEvent(event);
}

}  // namespace zerodrift::ui

#pragma once
// What every page of the wizard has, and how a page is written.
//
// A page is passive: it is told plain values by set...() and tells by signals what the user does. It knows neither
// the job nor the machine; a presenter stands between. It holds no data of its own invention: without data it is empty
// and says what will appear here and how to get it.
//
//   struct FitState { bool valid = false; ... };                  // plain Qt values, in the page's header
//   class FitPage : public Page {
//     Q_OBJECT
//    public:
//     explicit FitPage(QWidget* parent = nullptr);               // builds the widgets, without texts; ends with
//     refresh() void setState(const FitState& state);                      // stores it, then refresh() QString title()
//     const override;                            // texts always by tr(), asked again after a change of QString
//     sentence() const override;                         // language; sentence: what to do now PageAction primary()
//     const override;                       // the one filled button at the window's foot QVector<PageAction>
//     secondary() const override;            // buttons at the head's right
//    Q_SIGNALS:
//     void methodChosen(const QString& method);                  // what else the user did
//    protected:
//     void render() override;                                    // sets every text and value from the state
//   };
//
// render() is the only place that writes to the widgets; refresh() calls it and tells the window about the head and
// the actions. Figures: FigureRow. Panels: Card. Curves: ui/plots. Working, stale, failed: setProgress, setProblem.
// The presenter may forbid an action by its id and say why: allow("primary", false, "Switch compensation off first").

#include <QHash>
#include <QString>
#include <QStringList>
#include <QVector>
#include <QWidget>
#include <optional>

#include "ui/widgets/icons.h"
#include "ui/widgets/problem_banner.h"

class QStackedWidget;
class QVBoxLayout;

namespace zerodrift::ui {

class EmptyState;
class FigureRow;
class ProgressStrip;
struct Figure;

struct PageAction {
  QString id{};    // "primary" for the primary one
  QString text{};  // empty: not shown
  bool enabled = true;
  QString reason{};  // why it is off
  QString tip{};     // what it does, when its name does not say it all
};

class Page : public QWidget {
  Q_OBJECT

 public:
  explicit Page(QString id, QWidget* parent = nullptr);

  QString id() const { return m_id; }
  virtual QString title() const = 0;
  virtual QString sentence() const = 0;
  virtual PageAction primary() const = 0;
  virtual QVector<PageAction> secondary() const { return {}; }
  /// What a panel over the page must not cover: a consent that is asked for.
  virtual const QWidget* keepInSight() const { return nullptr; }
  /// Whether the primary action steers the work itself (pause, resume) and so stays on while it goes on.
  virtual bool steersWork() const { return false; }

  /// The page's action after what the presenter allows.
  PageAction primaryAction() const;
  QVector<PageAction> secondaryActions() const;
  void allow(const QString& actionId, bool enabled, const QString& reason = {});

  /// The step makes no sense in this job: the page says why in its middle and leads on; of its buttons only `kept`
  /// stay. Without a reason it is needed. `action`: a button in the middle (emptyActionTriggered).
  void setNotNeeded(const QString& reason, const QStringList& kept = {}, const QString& action = {});
  bool isNotNeeded() const { return !m_notNeeded.isEmpty(); }
  /// What stands in the head: sentence(), or that the step is not needed.
  QString headSentence() const;

  void setProblem(const Problem& problem);
  void clearProblem();
  const Problem& problem() const;
  /// Working: phase in words, fraction 0..1 or negative when unknown.
  void setProgress(const QString& phase, double fraction, std::optional<double> secondsLeft = std::nullopt,
                   bool cancellable = true);
  /// The work stands still until something comes: what, in place of the time left. The next setProgress ends it.
  void setWaiting(const QString& what);
  void clearProgress();
  bool isWorking() const { return m_working; }
  /// Shows itself while the page works; the window puts it into its foot, so that no page moves for it.
  QWidget* progressStrip() const;

 Q_SIGNALS:
  void primaryTriggered();
  void secondaryTriggered(const QString& actionId);
  void cancelRequested();
  void problemActionTriggered();
  void emptyActionTriggered();
  void goOnTriggered();  // the primary button of a page that is not needed
  void refreshed();      // title, sentence or actions may have changed

 protected:
  virtual void render() = 0;
  void refresh();
  /// Where the page puts its widgets: margins 24/20, gaps 16.
  QVBoxLayout* content() const { return m_content; }
  /// Row of figure cards above everything else; made at first use.
  void setFigures(const QVector<Figure>& figures);
  void showEmpty(Icon icon, const QString& heading, const QString& sentence, const QString& action = {});
  void showContent();
  /// The sentence of a page that waits for an earlier step; what it waits for stands in its middle.
  static QString notYet();
  bool isEmpty() const;
  void changeEvent(QEvent* event) override;

 private:
  QString m_id;
  QHash<QString, PageAction> m_allowed;
  ProblemBanner* m_banner;
  ProgressStrip* m_progress;
  QStackedWidget* m_stack;
  EmptyState* m_empty;
  FigureRow* m_figures = nullptr;
  QVBoxLayout* m_content;
  bool m_working = false;
  QString m_notNeeded;
  QStringList m_keptActions;
  QString m_notNeededAction;
};

}  // namespace zerodrift::ui

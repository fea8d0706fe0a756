#pragma once
// The step rail: where one is, what is done, what waits. Each step is a real button with its state in words.

#include <QAbstractButton>
#include <QString>
#include <QVector>
#include <QWidget>

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace zerodrift::ui {

enum class StepState {
  blocked,    // something before it is missing: hollow number
  ready,      // can be done now: hollow number, brighter
  running,    // being done just now: blue number
  current,    // done and up to date: green tick
  stale,      // done, but an earlier choice changed or the result fell short: amber "!"
  failed,     // amber "!" in red
  notNeeded,  // makes no sense in this job: a dash
};

class StepButton : public QAbstractButton {
  Q_OBJECT

 public:
  StepButton(QString id, int number, QWidget* parent = nullptr);
  QString id() const { return m_id; }
  void setTitle(const QString& title);
  void setState(StepState state, const QString& words);
  StepState state() const { return m_state; }
  QString words() const { return m_words; }
  /// The connector to the next disc; the branch at the end has none.
  void setConnectors(bool above, bool below, bool aboveDone, bool belowDone);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void enterEvent(QEnterEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  void paintDisc(QPainter& painter, const QPointF& centre) const;
  void paintConnectors(QPainter& painter, const QPointF& centre) const;
  void describe();

  QString m_id;
  int m_number;
  QString m_words;
  StepState m_state = StepState::blocked;
  bool m_above = false;
  bool m_below = false;
  bool m_aboveDone = false;
  bool m_belowDone = false;
};

class StepRail : public QWidget {
  Q_OBJECT

 public:
  explicit StepRail(QWidget* parent = nullptr);
  /// branch: a step outside the main line, shown apart and without number.
  StepButton* addStep(const QString& id, const QString& title, bool branch = false);
  StepButton* step(const QString& id) const;
  const QVector<StepButton*>& steps() const { return m_steps; }
  void setStepState(const QString& id, StepState state, const QString& words);
  void setCurrent(const QString& id);
  void setJob(const QString& job, const QString& engineer);
  void setLanguage(const QString& shownCode);
  void setLanguagesOffered(bool offered);
  void setDark(bool dark);
  void retranslate();

 Q_SIGNALS:
  void stepRequested(const QString& id);
  void jobClicked();
  void languageClicked();
  void themeClicked();
  void helpClicked();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void connectDiscs();

  QVBoxLayout* m_stepLayout;
  QVector<StepButton*> m_steps;
  QVector<bool> m_branch;
  QPushButton* m_job;
  QPushButton* m_language;
  QPushButton* m_theme;
  QPushButton* m_help;
  QString m_jobName;
  QString m_engineer;
};

}  // namespace zerodrift::ui

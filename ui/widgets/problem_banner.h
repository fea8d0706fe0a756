#pragma once
// What went wrong, in the page: one sentence, one remedy, at most one action. Never a box in the way.

#include <QFrame>
#include <QString>

class QLabel;
class QPushButton;

namespace zerodrift::ui {

enum class ProblemKind {
  note,     // worth knowing
  stale,    // an earlier choice changed: redo
  warning,  // works, but not as it should
  failure,  // did not work
  success,  // done
};

struct Problem {
  ProblemKind kind = ProblemKind::failure;
  QString sentence{};  // what happened, where
  QString remedy{};    // what to do
  QString action{};    // text of the button; empty: no button
};

class ProblemBanner : public QFrame {
  Q_OBJECT

 public:
  explicit ProblemBanner(QWidget* parent = nullptr);
  void setProblem(const Problem& problem);
  const Problem& problem() const { return m_problem; }
  void clear();

 Q_SIGNALS:
  void actionTriggered();
  void dismissed();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Problem m_problem;
  QLabel* m_sentence;
  QLabel* m_remedy;
  QPushButton* m_action;
  QPushButton* m_close;
};

}  // namespace zerodrift::ui

#pragma once
// Shows what the person at a manual control is asked, beside the running step, and takes the answer by key or touch.

#include <QDialog>
#include <memory>

#include "app/desktop/operator_questions.h"

class QLabel;
class QLineEdit;
class QPushButton;

namespace zerodrift::desktop {

class OperatorDialog : public QDialog {
  Q_OBJECT

 public:
  /// Comes and goes with the questions.
  OperatorDialog(std::shared_ptr<OperatorQuestions> questions, QWidget* parent);

 private:
  void update();
  void done();
  void giveUp();
  void keyPressEvent(QKeyEvent* event) override;

  std::shared_ptr<OperatorQuestions> m_questions;
  QLabel* m_text;
  QLineEdit* m_typed;
  QPushButton* m_done;
  QPushButton* m_off;
  QPushButton* m_cannot;
};

}  // namespace zerodrift::desktop

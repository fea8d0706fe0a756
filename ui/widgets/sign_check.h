#pragma once
// Is the sign right? Two arrows: the small move that was commanded, and what the camera saw of it.

#include <QString>
#include <QWidget>

#include "ui/widgets/colors.h"

namespace zerodrift::ui {

struct SignCheckResult {
  bool measured = false;
  QString axisRight = "X";
  QString axisUp = "Z";
  double commandedRight_um = 0.0, commandedUp_um = 0.0;
  double seenRight_um = 0.0, seenUp_um = 0.0;
  double sigma_um = 0.0;  // of what was seen
  QString word{};         // "same direction", "opposite: sign error"
  Judgement judgement = Judgement::none;
};

class SignCheck : public QWidget {
  Q_OBJECT

 public:
  explicit SignCheck(QWidget* parent = nullptr);
  void setResult(const SignCheckResult& result);
  QSize sizeHint() const override { return {260, 130}; }
  QSize minimumSizeHint() const override { return {180, 96}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  SignCheckResult m_result;
};

}  // namespace zerodrift::ui

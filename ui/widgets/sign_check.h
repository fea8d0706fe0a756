#pragma once
// Is the sign right? Two arrows an axis: the small move that was commanded, and what was seen of it.

#include <QString>
#include <QVector>
#include <QWidget>

#include "ui/widgets/colors.h"

namespace zerodrift::ui {

struct SignCheckAxis {
  QString axis{};
  double commanded_um = 0.0;
  double seen_um = 0.0;
  double sigma_um = 0.0;  // of what was seen
  bool watched = true;    // false: nothing looks along this axis
};

struct SignCheckResult {
  bool measured = false;
  QVector<SignCheckAxis> axes{};
  QString word{};  // "same direction", "opposite: sign error"
  QString note{};  // "checked 10:32", "will be checked before writing"
  Judgement judgement = Judgement::none;
};

class SignCheck : public QWidget {
  Q_OBJECT

 public:
  explicit SignCheck(QWidget* parent = nullptr);
  void setResult(const SignCheckResult& result);
  QSize sizeHint() const override { return {260, 116}; }
  QSize minimumSizeHint() const override { return {180, 116}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintAxis(QPainter& painter, const SignCheckAxis& axis, const QRectF& row, double reach_um) const;

  SignCheckResult m_result;
};

}  // namespace zerodrift::ui

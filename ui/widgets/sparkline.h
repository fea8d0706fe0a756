#pragma once
// A residual as small as a word: before, after a plain re-fit, after the effect, on one scale.

#include <QColor>
#include <QVector>
#include <QWidget>

namespace zerodrift::ui {

class Sparkline : public QWidget {
  Q_OBJECT

 public:
  explicit Sparkline(QWidget* parent = nullptr);
  void setCurves(const QVector<QVector<double>>& curves, const QVector<QColor>& colors);
  QSize sizeHint() const override { return {120, 40}; }
  QSize minimumSizeHint() const override { return {60, 28}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QVector<QVector<double>> m_curves;
  QVector<QColor> m_colors;
};

}  // namespace zerodrift::ui

#pragma once
// How many pixels have which brightness: what shows whether an exposure is right.

#include <QVector>
#include <QWidget>

namespace zerodrift::ui {

class Histogram : public QWidget {
  Q_OBJECT

 public:
  explicit Histogram(QWidget* parent = nullptr);
  /// Pixels by grey value, 256 of them; empty: none.
  void setCounts(const QVector<int>& counts);
  QSize sizeHint() const override { return {260, 64}; }
  QSize minimumSizeHint() const override { return {120, 48}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QVector<int> m_counts;
};

}  // namespace zerodrift::ui

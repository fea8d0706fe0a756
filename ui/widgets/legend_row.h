#pragma once
// The two to five curves of a small plot, named in one line above it. Larger plots have a channel table beside them.

#include <QColor>
#include <QString>
#include <QVector>
#include <QWidget>

namespace zerodrift::ui {

struct LegendItem {
  QString text{};
  QColor color{};
  bool dashed = false;
  bool band = false;   // an area
  bool point = false;  // single measurements
};

class LegendRow : public QWidget {
  Q_OBJECT

 public:
  explicit LegendRow(QWidget* parent = nullptr);
  void setItems(const QVector<LegendItem>& items);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return {80, 18}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QVector<LegendItem> m_items;
};

}  // namespace zerodrift::ui

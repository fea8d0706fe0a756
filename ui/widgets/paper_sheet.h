#pragma once
// A page of paper as a picture, as wide as it is told. It is made smaller when it is seen: a report of many pages costs
// nothing for those below the edge.

#include <QImage>
#include <QPixmap>
#include <QWidget>

namespace zerodrift::ui {

class PaperSheet : public QWidget {
  Q_OBJECT

 public:
  using QWidget::QWidget;
  void setPicture(const QImage& picture, int width_px);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QImage m_picture;
  int m_width = 0;
  QPixmap m_shown;  // empty: not made yet
};

}  // namespace zerodrift::ui

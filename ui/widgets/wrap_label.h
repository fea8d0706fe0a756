#pragma once
// A label of several lines that tells its layout a firm minimum height. QLabel's own height-for-width would travel up
// to the page's scroll area, which then makes the page as high as every widget's wish instead of the window.

#include <QLabel>

namespace zerodrift::ui {

class WrapLabel : public QLabel {
 public:
  explicit WrapLabel(QWidget* parent = nullptr);
  bool hasHeightForWidth() const override { return false; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;
};

}  // namespace zerodrift::ui

#pragma once
// A field to sign with pen, finger or mouse.

#include <QImage>
#include <QVector>
#include <QWidget>

namespace zerodrift::ui {

class SignaturePad : public QWidget {
  Q_OBJECT

 public:
  explicit SignaturePad(QWidget* parent = nullptr);
  void clear();
  bool isEmpty() const { return m_strokes.isEmpty(); }
  /// Black on transparent, twice the size on the screen; null when empty.
  QImage image() const;
  QSize sizeHint() const override { return {240, 72}; }
  QSize minimumSizeHint() const override { return {160, 56}; }

 Q_SIGNALS:
  void drawn(const QImage& image);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;

 private:
  QVector<QVector<QPointF>> m_strokes;
};

}  // namespace zerodrift::ui

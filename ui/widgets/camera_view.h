#pragma once
// The camera's image with what was found in it: regions, target, enlarged uncertainty, drift trail, reference.
// All coordinates are image px, x right, y down. Wheel zooms about the pointer, drag pans, double click fits.

#include <QImage>
#include <QPointF>
#include <QPolygonF>
#include <QRectF>
#include <QString>
#include <QVector>
#include <QWidget>
#include <optional>

#include "ui/widgets/colors.h"

namespace zerodrift::ui {

/// A fixed mark that shows the camera's own drift.
struct ReferenceMark {
  QRectF region{};
  std::optional<QPointF> at{};  // where it was found
  bool lost = false;            // looked for, and not found
};

struct CameraMarks {
  QRectF targetRegion{};  // where the target is searched; empty: none
  QVector<ReferenceMark> references{};
  QPolygonF outline{};  // of the target as found
  std::optional<QPointF> target;
  double sigmaMajor_px = 0.0;  // semi-axes of the standard uncertainty ellipse
  double sigmaMinor_px = 0.0;
  double sigmaAngle_deg = 0.0;  // major axis against x, clockwise on the screen
  double enlargement = 1.0;     // how much larger the ellipse is drawn; written beside it
  QVector<QPointF> trail{};     // earlier positions, oldest first
  double trailEnlargement = 1.0;
  QString message{};  // for example why the frame was refused; drawn on the image
  Judgement judgement = Judgement::none;
};

class CameraView : public QWidget {
  Q_OBJECT

 public:
  explicit CameraView(QWidget* parent = nullptr);
  void setImage(const QImage& image);
  void setMarks(const CameraMarks& marks);
  /// Shown while there is no image.
  void setPlaceholder(const QString& text);
  enum class Drawing {
    none,
    target,
    reference,
  };
  /// Lets the user draw a region with the mouse: the target's, or that of a further fixed mark.
  void setDrawing(Drawing drawing);
  void fit();
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 Q_SIGNALS:
  void regionDrawn(const QRectF& region);  // image px
  void pointPicked(const QPointF& point);  // click without a drag, image px

 protected:
  void paintEvent(QPaintEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QTransform toScreen() const;
  void zoomAbout(const QPointF& screen, double factor);
  void paintRegions(QPainter& painter, const QTransform& view) const;
  void paintTarget(QPainter& painter, const QTransform& view) const;
  void paintTrail(QPainter& painter, const QTransform& view) const;

  QImage m_image;
  CameraMarks m_marks;
  QString m_placeholder;
  Drawing m_drawing = Drawing::none;
  double m_zoom = 1.0;  // relative to the fitted image
  QPointF m_centre;     // image px in the middle of the widget, relative to the image's centre
  QPointF m_pressed;
  QPointF m_centrePressed;
  QRectF m_drawn;  // screen coordinates while a region is drawn
  bool m_dragging = false;
};

}  // namespace zerodrift::ui

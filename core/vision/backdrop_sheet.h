#pragma once
// Frames laid onto the template's pixels and brought to its light: what a backdrop is learned from. Inside core/vision
// only.

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "core/vision/backdrop.h"
#include "core/vision/frame_light.h"

namespace zerodrift::vision::backdrop {

/// The template's pixels with their margin, as the sheet on which everything below is drawn.
class Sheet {
 public:
  Sheet(const GrayImage& picture, const Region& region, const PixelPoint& point)
      : m_picture(picture),
        m_at{region.x - template_margin_px, region.y - template_margin_px, region.width + 2 * template_margin_px,
             region.height + 2 * template_margin_px},
        m_point(point.x_px, point.y_px) {}

  const Region& at() const { return m_at; }
  int width() const { return m_at.width; }
  int height() const { return m_at.height; }

  /// Where a pixel of the sheet is in a frame.
  Eigen::Vector2d in_frame(int column, int row, const LitFrame& frame) const {
    const Eigen::Vector2d w = Eigen::Vector2d(m_at.x + column, m_at.y + row) - m_point;
    const Eigen::Vector2d& s = frame.displacement_px;
    const Eigen::Vector2d bent = frame.lens.per_px2 * (2.0 * w.dot(s) * w + w.squaredNorm() * s);
    return m_point + s + frame.linear * w + bent;
  }
  /// And back, on the sheet or beside it; the lens does not matter there.
  Eigen::Vector2d on_sheet(double x, double y, const LitFrame& frame, const Eigen::Matrix2d& back) const {
    const Eigen::Vector2d w = back * (Eigen::Vector2d(x, y) - m_point - frame.displacement_px);
    return w + m_point - Eigen::Vector2d(m_at.x, m_at.y);
  }
  FloatImage of_template() const;

  /// What each pixel of the sheet has become in the frame.
  FloatImage travelled(const LitFrame& frame) const;

 private:
  const GrayImage& m_picture;
  Region m_at;
  Eigen::Vector2d m_point;
};

/// The pixel and its neighbours to the right and below lie in the picture and are not saturated.
bool usable(const GrayImage& image, int x, int y);

float middle_of(std::vector<float>& values);
/// Standard deviation of the noise in an image of differences.
float noise_of(const cv::Mat& difference);
}  // namespace zerodrift::vision::backdrop

#include "core/vision/template_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace zerodrift::vision {
namespace {

constexpr int border_px = 3;            // of the region: its gradients use what lies outside the template
constexpr double energy_share = 0.98;   // of the gradient energy is worked on, the rest costs time and tells little
constexpr std::size_t sparse_step = 9;  // and every ninth of the flat pixels, for the light

// Pixels of the region to work on.
std::vector<int> choose_pixels(const TemplateSource& source, const std::vector<float>& energy) {
  std::vector<int> usable;
  for (int y = border_px; y < source.region.height - border_px; ++y) {
    for (int x = border_px; x < source.region.width - border_px; ++x) {
      if (source.usable[static_cast<std::size_t>(y) * source.region.width + x])
        usable.push_back(y * source.region.width + x);
    }
  }
  // The energy above which pixels hold the wanted share, from a histogram: sorting them would take longer.
  constexpr int bins = 4096;
  float highest = 1e-6f;
  for (const int at : usable) highest = std::max(highest, energy[at]);
  std::vector<double> sums(bins, 0.0);
  const float to_bin = static_cast<float>(bins) / (highest * 1.0001f);
  double total = 0.0;
  for (const int at : usable) {
    sums[static_cast<std::size_t>(energy[at] * to_bin)] += energy[at];
    total += energy[at];
  }
  int bin = bins - 1;
  for (double sum = sums[bins - 1]; bin > 0 && sum <= energy_share * total; sum += sums[bin]) --bin;
  const float limit = static_cast<float>(bin) / to_bin;
  std::vector<int> kept;
  for (std::size_t k = 0; k < usable.size(); ++k) {
    if (energy[usable[k]] >= limit || k % sparse_step == 0) kept.push_back(usable[k]);
  }
  // Every fourth comes first: the motion settles on them before all are used.
  std::vector<int> out;
  for (const bool first : {true, false}) {
    for (std::size_t k = 0; k < kept.size(); ++k) {
      if ((k % 4 == 0) == first) out.push_back(kept[k]);
    }
  }
  return out;
}

// Share of independent noise's variance that the blur lets through.
double power_of(const Eigen::Matrix2d& blur_px2) {
  double power = 0.0;
  for (const float value : blur_kernel(blur_px2).values) power += double{value} * value;
  return power;
}

// Variance of a shift estimated from blurred noise over that from independent noise of equal power: by each of the two
// blurs, weighted by the noise that it lets through.
double noise_growth(const FloatImage& gradient, const std::array<Eigen::Matrix2d, 2>& blurs_px2) {
  double with = 0.0;
  double plain = 0.0;
  for (const Eigen::Matrix2d& blur_px2 : blurs_px2) {
    // A round blur of the same size is near enough and separable.
    const FloatImage twice = blurred(gradient, blur_px2.trace() * Eigen::Matrix2d::Identity());
    const double power = power_of(blur_px2);
    for (std::size_t k = 0; k < gradient.values.size(); ++k) {
      with += double{gradient.values[k]} * twice.values[k];
      plain += double{gradient.values[k]} * gradient.values[k] * power;
    }
  }
  return plain > 0.0 ? std::max(1.0, with / plain) : 1.0;
}

}  // namespace

TemplateModel make_template_model(const TemplateSource& source, const Eigen::Matrix2d& blur_px2,
                                  const Eigen::Matrix2d& frame_blur_px2) {
  const FloatImage smooth = blurred(source.pixels, blur_px2);
  const SplineImage spline(smooth);
  FloatImage fx = spline.derivative(1, 0);
  FloatImage fy = spline.derivative(0, 1);
  const FloatImage fxx = spline.derivative(2, 0);
  const FloatImage fxy = spline.derivative(1, 1);
  const FloatImage fyy = spline.derivative(0, 2);

  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y + source.margin_px) * smooth.width + x + source.margin_px;
  };
  std::vector<float> energy(static_cast<std::size_t>(source.region.width) * source.region.height);
  for (int y = 0; y < source.region.height; ++y) {
    for (int x = 0; x < source.region.width; ++x) {
      const std::size_t k = index(x, y);
      energy[static_cast<std::size_t>(y) * source.region.width + x] =
          fx.values[k] * fx.values[k] + fy.values[k] * fy.values[k];
    }
  }
  TemplateModel model;
  model.blur_px2 = blur_px2;
  model.gradient_energy = std::accumulate(energy.begin(), energy.end(), 0.0) / static_cast<double>(energy.size());
  const std::vector<int> chosen = choose_pixels(source, energy);
  for (std::vector<int>* one : {&model.column, &model.row}) one->reserve(chosen.size());
  for (std::vector<float>* one :
       {&model.x, &model.y, &model.value, &model.fx, &model.fy, &model.fxx, &model.fxy, &model.fyy}) {
    one->reserve(chosen.size());
  }
  for (const int at : chosen) {
    const int x = at % source.region.width;
    const int y = at / source.region.width;
    const std::size_t k = index(x, y);
    model.column.push_back(x);
    model.row.push_back(y);
    model.x.push_back(static_cast<float>(x - source.point.x_px));
    model.y.push_back(static_cast<float>(y - source.point.y_px));
    model.value.push_back(smooth.values[k]);
    model.fx.push_back(fx.values[k]);
    model.fy.push_back(fy.values[k]);
    model.fxx.push_back(fxx.values[k]);
    model.fxy.push_back(fxy.values[k]);
    model.fyy.push_back(fyy.values[k]);
  }
  model.pixels = static_cast<int>(model.column.size());
  model.noise_correlation = 2.0 / (power_of(blur_px2) + power_of(frame_blur_px2));
  model.frame_blur_px2 = frame_blur_px2;
  model.gradient_x = std::move(fx);
  model.gradient_y = std::move(fy);
  return model;
}

void find_noise_growth(TemplateModel& model) {
  model.noise_growth_x = noise_growth(model.gradient_x, {model.blur_px2, model.frame_blur_px2});
  model.noise_growth_y = noise_growth(model.gradient_y, {model.blur_px2, model.frame_blur_px2});
}

}  // namespace zerodrift::vision

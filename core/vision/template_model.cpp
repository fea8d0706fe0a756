#include "core/vision/template_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"
#include "core/vision/row_sums.h"

namespace zerodrift::vision {
namespace {

constexpr int border_px = 3;           // of the region: its gradients use what lies outside the template
constexpr double energy_share = 0.98;  // of the gradient energy is worked on, the rest costs time and tells little
constexpr float least_clear = 0.01f;
constexpr double noise_energies = 4.0;  // a gradient's energy below so many of the noise's is mostly noise
constexpr float noise_alone = 2.0f;     // times the noise's energy: noise alone seldom has a mean beyond it
constexpr float clear_of_noise = 4.0f;
constexpr int calm_window_px = 5;
constexpr int growth_rows = 5;
constexpr float along_rows_slope = 0.1f;
constexpr double mostly_along_rows = 0.5;  // of the gradients' energy; of a round target an eighth is
constexpr std::size_t sparse_step = 9;     // and every ninth of the flat pixels, for the light

// Pixels of the region to work on.
std::vector<int> choose_pixels(const TemplateSource& source, const std::vector<float>& energy, double noise_energy) {
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
  const auto above_noise = static_cast<float>(noise_energies * noise_energy);
  const float limit = std::max(static_cast<float>(bin) / to_bin, std::min(above_noise, 0.25f * highest));
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

// Variance of a gradient's component along x for noise of variance 1 in the pixels.
double gradient_noise(const Eigen::Matrix2d& blur_px2) {
  const int middle = 12 + static_cast<int>(std::ceil(3.0 * std::sqrt(blur_px2.trace())));
  FloatImage one(2 * middle + 1, 2 * middle + 1);
  one.row(middle)[middle] = 1.0f;
  const FloatImage answer = SplineImage(blurred(one, blur_px2)).derivatives().x;
  double sum = 0.0;
  for (const float value : answer.values) sum += double{value} * value;
  return sum;
}

// Standard deviation of the noise in the template's pixels: from second differences along both axes, which a smooth
// pattern hardly has (Immerkaer, Computer Vision and Image Understanding 64 (1996) 300); their median, so that a sharp
// pattern on part of them does not matter.
double noise_of_pixels(const FloatImage& image) {
  std::vector<float> sizes;
  for (int y = 1; y + 1 < image.height; y += 2) {
    const float* above = image.row(y - 1);
    const float* here = image.row(y);
    const float* below = image.row(y + 1);
    for (int x = 1; x + 1 < image.width; x += 2) {
      const float corners = above[x - 1] + above[x + 1] + below[x - 1] + below[x + 1];
      sizes.push_back(std::abs(corners - 2.0f * (above[x] + below[x] + here[x - 1] + here[x + 1]) + 4.0f * here[x]));
    }
  }
  if (sizes.empty()) return 0.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return 1.4826 * double{*middle} / 6.0;
}

// What stands behind the template's pixels.
FloatImage behind_of(const TemplateSource& source) {
  FloatImage out(source.pixels.width, source.pixels.height);
  for (int row = 0; row < out.height; ++row) {
    for (int column = 0; column < out.width; ++column) {
      out.row(row)[column] = source.backdrop->at(static_cast<float>(source.region.x - source.margin_px + column),
                                                 static_cast<float>(source.region.y - source.margin_px + row));
    }
  }
  return out;
}

// Gradients are those of what travels: of what is seen behind the target they are taken off.
void take_off_standing(const FloatImage& behind, const FloatImage& clear, FloatImage& fx, FloatImage& fy) {
  for (int row = 1; row + 1 < clear.height; ++row) {
    for (int column = 1; column + 1 < clear.width; ++column) {
      const float share = clear.row(row)[column];
      if (share < least_clear) continue;
      fx.row(row)[column] -= share * 0.5f * (behind.row(row)[column + 1] - behind.row(row)[column - 1]);
      fy.row(row)[column] -= share * 0.5f * (behind.row(row + 1)[column] - behind.row(row - 1)[column]);
    }
  }
}

ZERODRIFT_WIDE void squared(const float* values, std::ptrdiff_t count, float* __restrict out) {
  for (std::ptrdiff_t k = 0; k < count; ++k) out[k] = values[k] * values[k];
}

ZERODRIFT_WIDE void take_down(const float* mean_square, float noise, std::ptrdiff_t count, float* __restrict values) {
  const float scale = 1.0f / (noise * (clear_of_noise - noise_alone));
  const float offset = noise_alone / (clear_of_noise - noise_alone);
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const float share = mean_square[k] * scale - offset;
    const float least = share > 0.0f ? share : 0.0f;
    values[k] *= least < 1.0f ? least : 1.0f;
  }
}

// Where a gradient is no more than the template's noise it would tell of the motion what the frame does not know: one
// axis or the turning of a target that shows nothing of them. There it is taken down, by what its surroundings show.
void calm(FloatImage& gradient, double noise_energy) {
  FloatImage mean(gradient.width, gradient.height);
  const auto count = static_cast<std::ptrdiff_t>(mean.values.size());
  squared(gradient.values.data(), count, mean.values.data());
  cv::blur(mat_view(mean), mat_view(mean), {calm_window_px, calm_window_px});
  take_down(mean.values.data(), static_cast<float>(std::max(noise_energy, 1e-9)), count, gradient.values.data());
}

// Variance of a shift estimated from blurred noise over that from independent noise of equal power: by each of the two
// blurs, weighted by the noise that it lets through. Some of the rows tell it well enough.
double noise_growth(const FloatImage& gradient, const std::array<Eigen::Matrix2d, 2>& blurs_px2) {
  double with = 0.0;
  double plain = 0.0;
  for (const Eigen::Matrix2d& blur_px2 : blurs_px2) {
    // A round blur of the same size is near enough and separable.
    const std::vector<float> weights = gaussian_weights(blur_px2.trace());
    const int taps = static_cast<int>(weights.size());
    const int reach = taps - 1;
    const double power = blur_power(blur_px2);
    cv::Mat padded;
    cv::copyMakeBorder(mat_view(gradient), padded, reach, reach, reach, reach, cv::BORDER_REPLICATE);
    std::vector<float> down(static_cast<std::size_t>(padded.cols));
    std::vector<float> twice(static_cast<std::size_t>(gradient.width));
    for (int y = 0; y < gradient.height; y += growth_rows) {
      blur_row(padded.ptr<float>(y + reach), static_cast<std::ptrdiff_t>(padded.step1()), weights.data(), taps,
               padded.cols, down.data());
      blur_row(down.data() + reach, 1, weights.data(), taps, gradient.width, twice.data());
      const float* own = gradient.row(y);
      for (int x = 0; x < gradient.width; ++x) {
        with += double{own[x]} * twice[x];
        plain += double{own[x]} * own[x] * power;
      }
    }
  }
  return plain > 0.0 ? std::max(1.0, with / plain) : 1.0;
}

void set_tiles(TemplateModel& model) {
  for (int k = 0; k < model.pixels; ++k) {
    model.width = std::max(model.width, model.column[k] + 1);
    model.height = std::max(model.height, model.row[k] + 1);
  }
  const auto parts = [](int size) {
    std::vector<std::uint8_t> out(static_cast<std::size_t>(size));
    for (int k = 0; k < size; ++k) out[k] = static_cast<std::uint8_t>(k * tiles_a_side / size);
    return out;
  };
  const std::vector<std::uint8_t> across = parts(model.width);
  const std::vector<std::uint8_t> down = parts(model.height);
  model.tile.resize(model.column.size());
  for (int k = 0; k < model.pixels; ++k) {
    model.tile[k] = static_cast<std::uint8_t>(down[model.row[k]] * tiles_a_side + across[model.column[k]]);
  }
}

}  // namespace

TemplateSource completed(TemplateSource source) {
  if (source.backdrop) source.behind = behind_of(source);
  source.noise_levels = std::max(noise_of_pixels(source.pixels), std::sqrt(rounding_variance));
  if (source.frame_noise_levels == 0.0) source.frame_noise_levels = source.noise_levels;
  return source;
}

TemplateModel make_template_model(const TemplateSource& source, const Eigen::Matrix2d& blur_px2,
                                  const Eigen::Matrix2d& frame_blur_px2) {
  const FloatImage smooth = blurred(source.pixels, blur_px2);
  const SplineImage spline(smooth);
  SplineDerivatives derivatives = spline.derivatives();
  FloatImage& fx = derivatives.x;
  FloatImage& fy = derivatives.y;
  FloatImage clear, behind;
  if (source.backdrop) {
    clear = blurred(source.backdrop->clear, blur_px2);
    // Blurred with the rest of the template; in the frame it is not: a moving target does not smear what stands behind,
    // and that is out of focus anyway.
    behind = blurred(source.behind, blur_px2);
    take_off_standing(behind, clear, fx, fy);
  }
  const double noise_each = source.noise_levels * source.noise_levels * gradient_noise(blur_px2);
  calm(fx, noise_each);
  calm(fy, noise_each);
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
  model.region = source.region;
  model.backdrop = source.backdrop;
  model.blur_px2 = blur_px2;
  model.gradient_energy = std::accumulate(energy.begin(), energy.end(), 0.0) / static_cast<double>(energy.size());
  const double noise_energy = 2.0 * noise_each;
  model.noise_share = noise_energy / std::max(model.gradient_energy, 1e-9);
  const std::vector<int> chosen = choose_pixels(source, energy, noise_energy);
  model.pixels = static_cast<int>(chosen.size());
  for (std::vector<int>* one : {&model.column, &model.row}) one->resize(chosen.size());
  for (std::vector<float>* one :
       {&model.x, &model.y, &model.value, &model.fx, &model.fy, &model.fxx, &model.fxy, &model.fyy}) {
    one->resize(chosen.size());
  }
  int y = 0;  // the pixels run down the region twice: the first quarter, then the rest
  for (int i = 0; i < model.pixels; ++i) {
    if (chosen[i] < y * source.region.width) y = 0;
    while (chosen[i] >= (y + 1) * source.region.width) ++y;
    const int x = chosen[i] - y * source.region.width;
    const std::size_t k = index(x, y);
    model.column[i] = x;
    model.row[i] = y;
    model.x[i] = static_cast<float>(x - source.point.x_px);
    model.y[i] = static_cast<float>(y - source.point.y_px);
    model.value[i] = smooth.values[k];
    model.fx[i] = fx.values[k];
    model.fy[i] = fy.values[k];
    model.fxx[i] = derivatives.xx.values[k];
    model.fxy[i] = derivatives.xy.values[k];
    model.fyy[i] = derivatives.yy.values[k];
    if (source.backdrop && clear.values[k] > least_clear) {
      model.shown.push_back(i);
      model.clear.push_back(clear.values[k]);
      model.behind.push_back(behind.values[k]);
    }
  }
  set_tiles(model);
  model.gradient_noise = noise_each;
  const double template_variance = source.noise_levels * source.noise_levels;
  const double frame_variance = source.frame_noise_levels * source.frame_noise_levels;
  model.noise_correlation = (template_variance + frame_variance) /
                            (template_variance * blur_power(blur_px2) + frame_variance * blur_power(frame_blur_px2));
  model.frame_blur_px2 = frame_blur_px2;
  model.gradient_x = std::move(fx);
  model.gradient_y = std::move(fy);
  return model;
}

bool runs_along_rows(const TemplateModel& model) {
  double along = 0.0;
  double all = 0.0;
  for (int k = 0; k < model.pixels; ++k) {
    const float across = std::abs(model.fx[k]);
    const float down = std::abs(model.fy[k]);
    const double energy = double{across} * across + double{down} * down;
    all += energy;
    if (std::min(across, down) < along_rows_slope * std::max(across, down)) along += energy;
  }
  return along > mostly_along_rows * all;
}

void find_noise_effects(TemplateModel& model) {
  model.noise_growth_x = noise_growth(model.gradient_x, {model.blur_px2, model.frame_blur_px2});
  model.noise_growth_y = noise_growth(model.gradient_y, {model.blur_px2, model.frame_blur_px2});
  model.hidden = find_hidden_motion(model.x, model.y, model.fx, model.fy, model.gradient_noise);
}

}  // namespace zerodrift::vision

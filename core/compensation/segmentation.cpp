#include "core/compensation/segmentation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/compensation/minimum_link.h"
#include "core/compensation/window_fit.h"

namespace zerodrift::compensation {
namespace {

/// Least squares of the error over position, centred so that no digits are lost; r of errors and of coordinates.
struct Fit {
  double slope_um_per_mm = 0.0;
  double intercept_um = 0.0;
  double r_errors = 0.0;
  double r_coordinates = 1.0;
  double spread_um = 0.0;

  double at(double x_mm) const { return intercept_um + slope_um_per_mm * x_mm; }
};

Fit fit(std::span<const double> x, std::span<const double> e) {
  const auto n = static_cast<double>(x.size());
  double mean_x = 0.0;
  double mean_e = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_e += e[i] / n;
  }
  double sxx = 0.0;
  double sxe = 0.0;
  double see = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sxx += (x[i] - mean_x) * (x[i] - mean_x);
    sxe += (x[i] - mean_x) * (e[i] - mean_e);
    see += (e[i] - mean_e) * (e[i] - mean_e);
  }
  Fit out;
  const auto [low, high] = std::minmax_element(e.begin(), e.end());
  out.spread_um = *high - *low;
  if (sxx <= 0.0) {
    out.intercept_um = mean_e;
    return out;
  }
  out.slope_um_per_mm = sxe / sxx;
  out.intercept_um = mean_e - out.slope_um_per_mm * mean_x;
  out.r_errors = see > 0.0 ? sxe / std::sqrt(sxx * see) : 0.0;
  // y = x + e/1000: Sxy = Sxx + Sxe/1000, Syy = Sxx + 2 Sxe/1000 + See/1e6
  const double syy = sxx + 2e-3 * sxe + 1e-6 * see;
  out.r_coordinates = syy > 0.0 ? (sxx + 1e-3 * sxe) / std::sqrt(sxx * syy) : 0.0;
  return out;
}

Segment line(double from_mm, double to_mm, double slope_um_per_mm, double intercept_um, double r, int points) {
  return {from_mm, to_mm, 1.0 + 1e-3 * slope_um_per_mm, 1e-3 * intercept_um, r, points};
}

/// The straight piece from (x0, e0) to (x1, e1).
Segment joint(double x0, double e0, double x1, double e1) {
  const double slope = (e1 - e0) / (x1 - x0);
  return line(x0, x1, slope, e0 - slope * x0, 1.0, 0);
}

double error_at(const Segment& s, double x_mm) {
  return 1e3 * ((s.a - 1.0) * x_mm + s.b_mm);
}

struct Points {
  const std::vector<double>& x;
  const std::vector<double>& e;
};

/// The published loop: where dropping the last of n points until the rest passes comes to an end.
class Dropping {
 public:
  Dropping(const Points& points, const SegmentationOptions& options)
      : m_points(points), m_options(options), m_fit(points.x, second_of(points, options)) {}

  std::size_t kept(std::size_t first, std::size_t n) {
    if (n <= 2) return n;
    const std::size_t flat = m_options.criterion == Criterion::coordinates ? 0 : flat_count(first, n);
    if (flat == n) return n;
    return std::max({std::size_t{2}, flat, m_fit.largest_count(first, n, m_options.threshold)});
  }

 private:
  static std::vector<double> second_of(const Points& points, const SegmentationOptions& options) {
    if (options.criterion != Criterion::coordinates) return points.e;
    std::vector<double> y;
    for (std::size_t i = 0; i < points.x.size(); ++i) y.push_back(points.x[i] + 1e-3 * points.e[i]);
    return y;
  }

  /// Points from the first one on whose errors differ by no more than the resolution.
  std::size_t flat_count(std::size_t first, std::size_t n) const {
    double low = m_points.e[first];
    double high = low;
    std::size_t count = 0;
    while (count < n) {
      low = std::min(low, m_points.e[first + count]);
      high = std::max(high, m_points.e[first + count]);
      if (high - low > m_options.resolution_um) break;
      ++count;
    }
    return count;
  }

  const Points& m_points;
  const SegmentationOptions& m_options;
  WindowFit m_fit;
};

Segmentation published_rule(const Points& points, const SegmentationOptions& options) {
  Segmentation out;
  Dropping dropping(points, options);
  std::size_t first = 0;
  while (first < points.x.size()) {
    const std::size_t left = points.x.size() - first;
    const std::size_t start = std::min<std::size_t>(static_cast<std::size_t>(options.start_points), left);
    if (start == 1) {  // a single last point
      const double x0 = out.segments.back().to_mm;
      out.segments.push_back(joint(x0, error_at(out.segments.back(), x0), points.x[first], points.e[first]));
      break;
    }
    const std::size_t n = dropping.kept(first, start);
    const Fit found = fit(std::span(points.x).subspan(first, n), std::span(points.e).subspan(first, n));
    const double from = points.x[first];
    if (!out.segments.empty()) {
      const double x0 = out.segments.back().to_mm;
      out.segments.push_back(joint(x0, error_at(out.segments.back(), x0), from, found.at(from)));
    }
    const bool flat = found.spread_um <= options.resolution_um;
    const double r = options.criterion == Criterion::coordinates ? found.r_coordinates : flat ? 1.0 : found.r_errors;
    out.segments.push_back(
        line(from, points.x[first + n - 1], found.slope_um_per_mm, found.intercept_um, r, static_cast<int>(n)));
    ++out.fitted;
    first += n;
  }
  return out;
}

Segmentation fewest(const Points& points, const SegmentationOptions& options) {
  Segmentation out;
  const LinkPath path = tightest_minimum_link_path(points.x, points.e, options.tolerance_um);
  std::size_t next = 0;
  for (std::size_t k = 0; k < path.lines.size(); ++k) {
    const double to = path.joints_mm[k + 1];
    const bool last = k + 1 == path.lines.size();
    const std::size_t begin = next;
    while (next < points.x.size() && (last || points.x[next] < to)) ++next;
    const auto count = next - begin;
    double r = 1.0;
    if (count > 2) {
      r = fit(std::span(points.x).subspan(begin, count), std::span(points.e).subspan(begin, count)).r_errors;
    }
    out.segments.push_back(
        line(path.joints_mm[k], to, path.lines[k].slope, path.lines[k].intercept, r, static_cast<int>(count)));
    ++out.fitted;
  }
  return out;
}

void measure(const Points& points, Segmentation& out) {
  std::size_t k = 0;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    while (k + 1 < out.segments.size() && points.x[i] > out.segments[k].to_mm) ++k;
    const double residual = std::abs(points.e[i] - error_at(out.segments[k], points.x[i]));
    if (residual <= out.largest_residual_um) continue;
    out.largest_residual_um = residual;
    out.largest_at_mm = points.x[i];
  }
}

void explain(const SegmentationOptions& options, Segmentation& out) {
  switch (options.criterion) {
    case Criterion::errors:
      out.notes.push_back(fmt::format("criterion: |r| of position and error at least {:g}, from {} points",
                                      options.threshold, options.start_points));
      out.notes.push_back(
          fmt::format("r is blind to scale: it says nothing about um; the largest residual is {:.2f} um at {:g} mm",
                      out.largest_residual_um, out.largest_at_mm));
      break;
    case Criterion::coordinates:
      out.notes.push_back(fmt::format(
          "criterion: |r| of position and measured position at least {:g}; with laser data it is always about 1, so it "
          "can never drop a point: use errors or a tolerance",
          options.threshold));
      break;
    case Criterion::tolerance:
      out.notes.push_back(
          fmt::format("criterion: the fewest segments that stay within {:g} um at every point; the largest "
                      "residual is {:.3f} um",
                      options.tolerance_um, out.largest_residual_um));
      break;
  }
}

Status check_input(const Points& points, const SegmentationOptions& options) {
  if (points.x.size() < 2 || points.x.size() != points.e.size()) {
    return fail(
        ErrorCode::not_enough_data,
        {{"what", "measured positions of the axis"}, {"found", std::to_string(points.x.size())}, {"needed", "2"}});
  }
  const auto reject = [](const char* what, double found, const char* expected) -> Status {
    return fail(ErrorCode::bad_argument,
                {{"what", what}, {"found", fmt::format("{:g}", found)}, {"expected", expected}});
  };
  if (options.start_points < 2) return reject("start points", options.start_points, "2 or more");
  if (!(options.threshold > 0.0 && options.threshold <= 1.0))
    return reject("threshold", options.threshold, "above 0, up to 1");
  if (!(options.tolerance_um > 0.0)) return reject("tolerance", options.tolerance_um, "above 0 um");
  for (std::size_t i = 1; i < points.x.size(); ++i) {
    if (!(points.x[i] > points.x[i - 1])) return reject("position", points.x[i], "above the one before");
  }
  return {};
}

}  // namespace

std::string_view name_of(Criterion criterion) {
  return criterion == Criterion::errors ? "errors" : criterion == Criterion::coordinates ? "coordinates" : "tolerance";
}

Result<Segmentation> segment_errors(const std::vector<double>& position_mm, const std::vector<double>& error_um,
                                    const SegmentationOptions& options) {
  const Points points{position_mm, error_um};
  ZD_CHECK(check_input(points, options));
  Segmentation out =
      options.criterion == Criterion::tolerance ? fewest(points, options) : published_rule(points, options);
  for (const Segment& one : out.segments) {
    if (one.a > 0.0) continue;
    return fail(ErrorCode::data_does_not_fit,
                {{"what", fmt::format("the error between {:g} and {:g} mm", one.from_mm, one.to_mm)},
                 {"found", "one that turns the direction of motion"},
                 {"expected", "far less than the travel"}});
  }
  measure(points, out);
  explain(options, out);
  return out;
}

}  // namespace zerodrift::compensation

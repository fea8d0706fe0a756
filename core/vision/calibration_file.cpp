#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/vision/calibration.h"

namespace zerodrift::vision {
namespace {

const char* const calibration_format = "zerodrift-calibration/1";
constexpr int most_views = 1'000'000;

nlohmann::json rows_of(const Eigen::Matrix2d& m) {
  return nlohmann::json::array({{m(0, 0), m(0, 1)}, {m(1, 0), m(1, 1)}});
}

Eigen::Matrix2d matrix_of(JsonObject& object, const char* key) {
  const nlohmann::json* rows = object.raw(key);
  const auto good = [](const nlohmann::json& row) {
    return row.is_array() && row.size() == 2 && row[0].is_number() && row[1].is_number();
  };
  if (rows == nullptr) object.missing(key, "a 2x2 matrix as two rows of two numbers");
  if (!rows->is_array() || rows->size() != 2 || !good((*rows)[0]) || !good((*rows)[1])) {
    object.reject(key, rows->dump().substr(0, 40), "a 2x2 matrix as two rows of two numbers");
  }
  Eigen::Matrix2d out;
  out << (*rows)[0][0].get<double>(), (*rows)[0][1].get<double>(), (*rows)[1][0].get<double>(),
      (*rows)[1][1].get<double>();
  if (!out.allFinite()) object.reject(key, "not finite", "finite numbers");
  return out;
}

// A matrix of no camera that could measure: singular, or a pixel of nanometres or metres.
void check_scale(JsonObject& object, const Eigen::Matrix2d& um_from_px) {
  const CalibrationLimits limits;
  const Eigen::Vector2d scales = Eigen::JacobiSVD<Eigen::Matrix2d>(um_from_px).singularValues();
  if (scales(1) >= limits.least_um_per_px && scales(0) <= limits.largest_um_per_px) return;
  object.reject("um_from_px", fmt::format("{:.3g} to {:.3g} um a pixel", scales(1), scales(0)),
                fmt::format("{:g} to {:g} um a pixel", limits.least_um_per_px, limits.largest_um_per_px));
}

Eigen::Matrix4d covariance_of(JsonObject& object) {
  const Eigen::Matrix2d sigma = matrix_of(object, "sigma");
  if (sigma.minCoeff() <= 0.0) {
    object.reject("sigma", fmt::format("{:g}", sigma.minCoeff()), "standard uncertainties above 0");
  }
  Eigen::Matrix4d out = Eigen::Matrix4d::Zero();
  out.diagonal() << sigma(0, 0), sigma(0, 1), sigma(1, 0), sigma(1, 1);
  out.diagonal() = out.diagonal().cwiseAbs2().eval();
  const nlohmann::json* rows = object.raw("covariance");
  if (rows == nullptr) return out;
  const char* const expected = "four rows of four numbers, with the squares of sigma on the diagonal";
  if (!rows->is_array() || rows->size() != 4) object.reject("covariance", "not a 4x4 matrix", expected);
  Eigen::Matrix4d full;
  for (int row = 0; row < 4; ++row) {
    const nlohmann::json& cells = (*rows)[static_cast<std::size_t>(row)];
    if (!cells.is_array() || cells.size() != 4) object.reject("covariance", "not a 4x4 matrix", expected);
    for (int column = 0; column < 4; ++column) {
      const nlohmann::json& cell = cells[static_cast<std::size_t>(column)];
      if (!cell.is_number()) object.reject("covariance", "not a 4x4 matrix", expected);
      full(row, column) = cell.get<double>();
    }
  }
  constexpr double rounding = 1e-3;
  const auto own = full.diagonal().array();
  const bool fits = full.allFinite() && ((own - out.diagonal().array()).abs() <= rounding * own.abs()).all();
  if (!fits) object.reject("covariance", "other than sigma", expected);
  const Eigen::Vector4d scale = out.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix4d correlation = scale.asDiagonal() * full * scale.asDiagonal();
  const bool possible = correlation.isApprox(correlation.transpose(), rounding) &&
                        Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(correlation).eigenvalues()(0) > -rounding;
  if (!possible) object.reject("covariance", "no covariance", "a symmetric matrix that is not negative");
  return full;
}

CalibrationView view_of(JsonObject& object) {
  CalibrationView view;
  view.image = object.text_or("image", "");
  view.x_mm = object.number_or("x_mm", 0.0);
  view.y_mm = object.number_or("y_mm", 0.0);
  view.x_px = object.number_or("x_px", 0.0);
  view.y_px = object.number_or("y_px", 0.0);
  view.sigma_px = object.number_or("sigma_px", 0.0);
  view.residual_x_um = object.number_or("residual_x_um", 0.0);
  view.residual_y_um = object.number_or("residual_y_um", 0.0);
  return view;
}

}  // namespace

nlohmann::json to_json(const Calibration& c) {
  nlohmann::json views = nlohmann::json::array();
  for (const CalibrationView& view : c.views) {
    views.push_back({{"image", view.image},
                     {"x_mm", view.x_mm},
                     {"y_mm", view.y_mm},
                     {"x_px", view.x_px},
                     {"y_px", view.y_px},
                     {"sigma_px", view.sigma_px},
                     {"residual_x_um", view.residual_x_um},
                     {"residual_y_um", view.residual_y_um}});
  }
  nlohmann::json covariance = nlohmann::json::array();
  for (int row = 0; row < 4; ++row) {
    covariance.push_back({c.covariance(row, 0), c.covariance(row, 1), c.covariance(row, 2), c.covariance(row, 3)});
  }
  return {
      {"format", calibration_format},
      {"um_from_px", rows_of(c.um_from_px)},
      {"sigma", rows_of(c.sigma())},
      {"covariance", covariance},
      {"rms_um", c.rms_um},
      {"leave_one_out_um", std::isfinite(c.leave_one_out_um) ? nlohmann::json(c.leave_one_out_um) : nlohmann::json()},
      {"scale_um_per_px", c.scale_um_per_px},
      {"rotation_deg", c.rotation_deg},
      {"mirrored", c.mirrored},
      {"handedness_assumed", c.handedness_assumed},
      {"range_px", c.range_px},
      {"views", views},
      {"warnings", c.warnings}};
}

Result<Calibration> calibration_from_json(const nlohmann::json& document, const std::string& file,
                                          std::vector<std::string>* warnings) {
  return from_json<Calibration>(document, file, warnings, [](JsonObject& object) {
    Calibration c;
    if (const std::string format = object.text_or("format", calibration_format); format != calibration_format) {
      object.reject("format", format, calibration_format);
    }
    object.raw("target");
    c.um_from_px = matrix_of(object, "um_from_px");
    check_scale(object, c.um_from_px);
    c.covariance = covariance_of(object);
    c.rms_um = object.number("rms_um", not_negative);
    c.leave_one_out_um =
        object.number_if("leave_one_out_um", not_negative).value_or(std::numeric_limits<double>::quiet_NaN());
    c.scale_um_per_px = object.number_or("scale_um_per_px", std::sqrt(std::abs(c.um_from_px.determinant())), positive);
    c.rotation_deg = object.number_or("rotation_deg", 0.0);
    c.mirrored = object.flag_or("mirrored", c.um_from_px.determinant() > 0.0);
    c.handedness_assumed = object.flag_or("handedness_assumed", false);
    c.warnings = object.texts_or_empty("warnings");
    if (object.has("range_px")) {
      const std::vector<double> range = object.numbers("range_px", 2);
      if (std::min(range[0], range[1]) < 0.0) object.reject("range_px", "below 0", "two numbers of 0 or more");
      c.range_px = {range[0], range[1]};
    }
    // How many there were, or each of them.
    const nlohmann::json* views = object.raw("views");
    if (views == nullptr) object.missing("views", "a list of objects");
    if (views->is_number()) {
      object.integer("views", 1, most_views);
    } else {
      for (JsonObject& view : object.objects("views")) c.views.push_back(view_of(view));
    }
    return c;
  });
}

Result<Calibration> read_calibration(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  ZD_TRY(const nlohmann::json document, read_json_file(path));
  return calibration_from_json(document, path.string(), warnings);
}

}  // namespace zerodrift::vision

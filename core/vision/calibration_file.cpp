#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/vision/calibration.h"

namespace zerodrift::vision {
namespace {

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

CalibrationView view_of(JsonObject& object) {
  CalibrationView view;
  view.image = object.text_or("image", "");
  view.x_mm = object.number_or("x_mm", 0.0);
  view.y_mm = object.number_or("y_mm", 0.0);
  view.x_px = object.number_or("x_px", 0.0);
  view.y_px = object.number_or("y_px", 0.0);
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
                     {"residual_x_um", view.residual_x_um},
                     {"residual_y_um", view.residual_y_um}});
  }
  nlohmann::json covariance = nlohmann::json::array();
  for (int row = 0; row < 4; ++row) {
    covariance.push_back({c.covariance(row, 0), c.covariance(row, 1), c.covariance(row, 2), c.covariance(row, 3)});
  }
  return {
      {"format", "zerodrift-calibration/1"},
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
    object.raw("format");
    object.raw("target");
    c.um_from_px = matrix_of(object, "um_from_px");
    if (std::abs(c.um_from_px.determinant()) < 1e-9) {
      object.reject("um_from_px", "singular", "a matrix that can be inverted");
    }
    c.rms_um = object.number_or("rms_um", 0.0);
    c.leave_one_out_um = object.number_if("leave_one_out_um").value_or(std::numeric_limits<double>::quiet_NaN());
    c.scale_um_per_px = object.number_or("scale_um_per_px", std::sqrt(std::abs(c.um_from_px.determinant())));
    c.rotation_deg = object.number_or("rotation_deg", 0.0);
    c.mirrored = object.flag_or("mirrored", c.um_from_px.determinant() > 0.0);
    c.handedness_assumed = object.flag_or("handedness_assumed", false);
    c.warnings = object.texts_or_empty("warnings");
    if (const std::vector<double> range = object.numbers_or_empty("range_px"); range.size() == 2) {
      c.range_px = {range[0], range[1]};
    }
    const nlohmann::json* covariance = object.raw("covariance");
    const Eigen::Matrix2d sigma = object.has("sigma") ? matrix_of(object, "sigma") : Eigen::Matrix2d::Zero();
    c.covariance.diagonal() << sigma(0, 0), sigma(0, 1), sigma(1, 0), sigma(1, 1);
    c.covariance.diagonal() = c.covariance.diagonal().cwiseAbs2();
    if (covariance != nullptr && covariance->is_array() && covariance->size() == 4) {
      for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
          const nlohmann::json& cells = (*covariance)[row];
          if (!cells.is_array() || cells.size() != 4 || !cells[column].is_number()) {
            object.reject("covariance", "not a 4x4 matrix", "four rows of four numbers");
          }
          c.covariance(row, column) = cells[column].get<double>();
        }
      }
    }
    const nlohmann::json* views = object.raw("views");
    if (views != nullptr && views->is_array()) {
      for (JsonObject& view : object.objects_or_empty("views")) c.views.push_back(view_of(view));
    }
    return c;
  });
}

Result<Calibration> read_calibration(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  ZD_TRY(const nlohmann::json document, read_json_file(path));
  return calibration_from_json(document, path.string(), warnings);
}

}  // namespace zerodrift::vision

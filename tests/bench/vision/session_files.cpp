#include "tests/bench/vision/session_files.h"

#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/recording/csv.h"
#include "core/vision/image_codec.h"

namespace zerodrift::bench {
namespace {

namespace fs = std::filesystem;

vision::Region region_from(const nlohmann::json& numbers) {
  return {numbers.at(0).get<int>(), numbers.at(1).get<int>(), numbers.at(2).get<int>(), numbers.at(3).get<int>()};
}

Result<std::vector<BenchView>> views_in(const fs::path& folder) {
  ZD_TRY(const auto views, vision::read_views(folder / "views.csv"));
  ZD_TRY(const auto truth, recording::read_table(folder / "views_truth.csv"));
  std::vector<BenchView> out;
  for (std::size_t row = 0; row < views.size(); ++row) {
    ZD_TRY(const auto picture, vision::read_image(views[row].image));
    BenchView view{picture.image, views[row].x_mm, views[row].y_mm, 0.0, 0.0};
    ZD_TRY(view.true_x_px, recording::number_in(truth, row, truth.column("x_px")));
    ZD_TRY(view.true_y_px, recording::number_in(truth, row, truth.column("y_px")));
    out.push_back(std::move(view));
  }
  return out;
}

}  // namespace

Result<BenchSession> read_session(const fs::path& folder) {
  BenchSession out;
  ZD_TRY(const nlohmann::json json, read_json_file(folder / "session.json"));
  out.set = json.at("set").get<std::string>();
  out.target = json.at("target").get<std::string>();
  out.region = region_from(json.at("roi_px"));
  for (const nlohmann::json& one : json.at("reference_rois_px")) out.marks.push_back(region_from(one));
  ZD_TRY(const auto picture, vision::read_image(folder / "template.png"));
  out.picture = picture.image;
  ZD_TRY(out.views, views_in(folder));
  ZD_TRY(const auto truth, recording::read_table(folder / "truth.csv"));
  for (std::size_t row = 0; row < truth.rows.size(); ++row) {
    BenchFrame frame;
    frame.name = truth.rows[row][0];
    ZD_TRY(const auto image, vision::read_image(folder / "frames" / frame.name));
    frame.image = image.image;
    const auto number = [&](const char* column) { return recording::number_in(truth, row, truth.column(column)); };
    ZD_TRY(const double valid, number("valid"));
    frame.valid = valid > 0.5;
    ZD_TRY(frame.x_px, number("x_px"));
    ZD_TRY(frame.y_px, number("y_px"));
    ZD_TRY(frame.ex_um, number("ex_um"));
    ZD_TRY(frame.ey_um, number("ey_um"));
    ZD_TRY(frame.bound_x_px, number("crlb_x_px"));
    ZD_TRY(frame.bound_y_px, number("crlb_y_px"));
    out.frames.push_back(std::move(frame));
  }
  return out;
}

}  // namespace zerodrift::bench

// render_frames: writes sessions of rendered frames with their truth, see README.md.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "tests/support/frame_set.h"
#include "tests/support/png_writer.h"

namespace {

using namespace zerodrift::test_support;
namespace fs = std::filesystem;

struct Options {
  fs::path out;
  std::uint64_t seed = 1;
  int frames = 7;
  double half_span_px = 0.0;
  bool bound = true;
  std::vector<std::string> targets;
  std::vector<std::string> sets;
};

bool wanted(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

nlohmann::json region_json(const PixelRegion& region) {
  return {region.x, region.y, region.width, region.height};
}

void write_session_json(const fs::path& path, const Session& session) {
  const FrameRenderer& renderer = session.renderer;
  const Vector2 p = session.point_px;
  const auto by = [&](double dx, double dy) {
    const Vector2 ahead = renderer.object_from_pixel({p.x + dx, p.y + dy});
    const Vector2 behind = renderer.object_from_pixel({p.x - dx, p.y - dy});
    return Vector2{(ahead.x - behind.x) / 2e-2, (ahead.y - behind.y) / 2e-2};
  };
  const Vector2 by_x = by(1e-2, 0.0);
  const Vector2 by_y = by(0.0, 1e-2);
  nlohmann::json json;
  json["target"] = name_of(session.kind);
  json["set"] = name_of(session.disturbance);
  json["seed"] = session.seed;
  json["roi_px"] = region_json(session.roi);
  json["point_px"] = {p.x, p.y};
  json["reference_rois_px"] = nlohmann::json::array();
  for (const PixelRegion& roi : session.mark_rois) json["reference_rois_px"].push_back(region_json(roi));
  json["um_from_px"] = {{by_x.x, by_y.x}, {by_x.y, by_y.y}};
  json["distortion_per_px2"] = renderer.camera().distortion_per_px2;
  std::ofstream(path) << json.dump(1) << '\n';
}

void write_views(const fs::path& folder, const std::string& name, const Session& session,
                 const std::vector<CalibrationView>& views) {
  fs::create_directories(folder / name);
  std::ofstream csv(folder / (name + ".csv"));
  std::ofstream truth(folder / (name + "_truth.csv"));
  csv << "image,x_mm,y_mm\n";
  truth << "image,x_mm,y_mm,x_px,y_px\n";
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::string image = fmt::format("{}/{:02}.png", name, i);
    write_png(folder / image, session.renderer.render(views[i].spec));
    const FrameTruth exact = truth_of(session, views[i].spec);
    csv << fmt::format("{},{:.6f},{:.6f}\n", image, views[i].recorded_um.x * 1e-3, views[i].recorded_um.y * 1e-3);
    truth << fmt::format("{},{:.9f},{:.9f},{:.7f},{:.7f}\n", image, exact.shift_um.x * 1e-3, exact.shift_um.y * 1e-3,
                         exact.shift_px.x, exact.shift_px.y);
  }
}

std::string truth_row(const Session& session, const std::string& name, const FrameSpec& spec, bool bound) {
  const FrameTruth truth = truth_of(session, spec);
  std::string row =
      fmt::format("{},{},{},{},", name, name_of(session.disturbance), name_of(session.kind), truth.valid ? 1 : 0);
  if (truth.valid) {
    row += fmt::format("{:.7f},{:.7f},{:.6f},{:.6f},", truth.shift_px.x, truth.shift_px.y, truth.shift_um.x,
                       truth.shift_um.y);
  } else {
    row += ",,,,";
  }
  if (truth.valid && bound) {
    const Vector2 smallest = cramer_rao_px(session, spec);
    row += fmt::format("{:.7f},{:.7f}", smallest.x, smallest.y);
  } else {
    row += ",";
  }
  for (std::size_t i = 0; i < 2; ++i) {
    row += i < truth.marks_px.size() ? fmt::format(",{:.7f},{:.7f}", truth.marks_px[i].x, truth.marks_px[i].y) : ",,";
  }
  return row;
}

void write_session(const fs::path& folder, const Session& session, bool bound) {
  fs::create_directories(folder / "frames");
  write_png(folder / "template.png", session.renderer.render(session.template_spec));
  write_session_json(folder / "session.json", session);
  write_views(folder, "views", session, session.grid_views);
  write_views(folder, "views3", session, session.two_move_views);
  std::ofstream truth(folder / "truth.csv");
  truth << "frame,set,target,valid,x_px,y_px,ex_um,ey_um,crlb_x_px,crlb_y_px,"
           "mark1_x_px,mark1_y_px,mark2_x_px,mark2_y_px\n";
  for (std::size_t i = 0; i < session.frames.size(); ++i) {
    const std::string name = fmt::format("{:03}.png", i);
    write_png(folder / "frames" / name, session.renderer.render(session.frames[i]));
    truth << truth_row(session, name, session.frames[i], bound) << '\n';
  }
}

void render_all(const Options& options) {
  for (const Disturbance disturbance : disturbances) {
    if (!wanted(options.sets, name_of(disturbance))) continue;
    for (const PatternKind kind : target_kinds) {
      if (!wanted(options.targets, name_of(kind))) continue;
      const Session session = make_session(kind, disturbance, options.seed, options.frames, options.half_span_px);
      write_session(options.out / name_of(disturbance) / name_of(kind), session, options.bound);
      std::cerr << name_of(disturbance) << ' ' << name_of(kind) << '\n';
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Renders sessions of camera frames with exact truth");
  app.add_option("--out", options.out, "folder to fill: SET/TARGET/...")->required();
  app.add_option("--seed", options.seed);
  app.add_option("--frames", options.frames, "frames a session")->check(CLI::PositiveNumber);
  app.add_option("--half-span-px", options.half_span_px,
                 "calibration positions so far from the middle; else as the calibrate page proposes")
      ->check(CLI::PositiveNumber);
  app.add_option("--targets", options.targets, "only these, separated by commas")->delimiter(',');
  app.add_option("--sets", options.sets, "only these, separated by commas")->delimiter(',');
  app.add_flag("!--no-bound", options.bound, "leave out the Cramer-Rao bound (most of the time goes there)");
  CLI11_PARSE(app, argc, argv);
  try {
    render_all(options);
  } catch (const std::exception& problem) {
    std::cerr << problem.what() << '\n';
    return 1;
  }
  return 0;
}

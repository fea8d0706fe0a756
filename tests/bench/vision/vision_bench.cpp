// vision_bench --data DIR [--peers] [--detail] [--repeat N] [--targets a,b] [--sets a,b]: location and calibration
// measured on sessions written by render_frames, as a table: RMSE in px, over the Cramer-Rao bound, over the stated
// uncertainty, in um through the whole chain, refusals, and time; and the same of the peers.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <map>

#include "core/vision/error_view.h"
#include "core/vision/target.h"
#include "tests/bench/vision/peers.h"
#include "tests/bench/vision/session_files.h"

namespace zerodrift::bench {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<fs::path> data;
  bool peers = false;
  bool detail = false;
  int repeat = 1;
  std::vector<std::string> targets;
  std::vector<std::string> sets;
};

// Sums of squares of one method on one set.
struct Score {
  int valid = 0, refused = 0, gross = 0, invalid = 0, false_accepts = 0, numbers = 0, um_numbers = 0;
  double squares = 0.0, over_bound = 0.0, pull = 0.0, um = 0.0, um_exact = 0.0, ms = 0.0, worst = 0.0;
  int frames = 0;

  void add(const Score& o) {
    valid += o.valid, refused += o.refused, gross += o.gross, invalid += o.invalid, false_accepts += o.false_accepts;
    numbers += o.numbers, um_numbers += o.um_numbers, frames += o.frames;
    squares += o.squares, over_bound += o.over_bound, pull += o.pull, um += o.um, um_exact += o.um_exact, ms += o.ms;
    worst = std::max(worst, o.worst);
  }
  double rmse() const { return numbers > 0 ? std::sqrt(squares / numbers) : std::nan(""); }
};

using Key = std::pair<std::string, std::string>;     // set, "plates" or "ball"
std::map<std::string, std::map<Key, Score>> scores;  // by method

constexpr double gross_px = 0.5;

// Processor time: what else runs on the machine does not count.
double cpu_ms() {
  return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void count(Score& score, const BenchFrame& frame, bool ok, double x, double y, double sx, double sy) {
  ++score.frames;
  if (!frame.valid) {
    ++score.invalid;
    score.false_accepts += ok;
    return;
  }
  ++score.valid;
  if (!ok) {
    ++score.refused;
    return;
  }
  const double dx = x - frame.x_px;
  const double dy = y - frame.y_px;
  if (std::hypot(dx, dy) > gross_px) {
    ++score.gross;
    return;
  }
  score.numbers += 2;
  score.squares += dx * dx + dy * dy;
  score.over_bound += std::pow(dx / frame.bound_x_px, 2) + std::pow(dy / frame.bound_y_px, 2);
  if (sx > 0.0) score.pull += std::pow(dx / sx, 2) + std::pow(dy / sy, 2);
  score.worst = std::max({score.worst, std::abs(dx), std::abs(dy)});
}

std::optional<vision::Calibration> calibration_of(const BenchSession& session, const vision::Target* target) {
  std::vector<vision::CalibrationView> views;
  for (const BenchView& view : session.views) {
    vision::CalibrationView one{"", view.x_mm, view.y_mm, view.true_x_px, view.true_y_px, 0.0, 0.0};
    if (target != nullptr) {
      const vision::Location at = target->locate(view.image);
      if (!at.ok) continue;
      one.x_px = at.x_px;
      one.y_px = at.y_px;
    }
    views.push_back(one);
  }
  auto result = vision::calibrate(std::move(views));
  if (!result) {
    fmt::print("{} {}: {}\n", session.set, session.target, describe(result.error()));
    return std::nullopt;
  }
  return *result;
}

void run_ours(const BenchSession& session, const Options& options, Score& score) {
  auto target = vision::Target::create(session.picture, session.region, std::nullopt, "template");
  if (!target) {
    fmt::print("{} {}: {}\n", session.set, session.target, describe(target.error()));
    return;
  }
  std::vector<vision::GrayImage> moved;
  for (const BenchView& view : session.views) moved.push_back(view.image);
  const vision::Target masked = target->learned_from(moved);
  std::vector<vision::Target> marks;
  for (const vision::Region& at : session.marks) {
    if (auto mark = vision::Target::create(session.picture, at, std::nullopt, "template")) marks.push_back(*mark);
  }
  const auto calibration = calibration_of(session, &masked);
  const auto exact = calibration_of(session, nullptr);
  for (const BenchFrame& frame : session.frames) {
    vision::Location at;
    double least_ms = std::numeric_limits<double>::infinity();
    for (int k = 0; k < options.repeat; ++k) {
      const double start = cpu_ms();
      at = masked.locate(frame.image);
      least_ms = std::min(least_ms, cpu_ms() - start);
    }
    score.ms += least_ms;
    count(score, frame, at.ok, at.x_px, at.y_px, at.sigma_x_px, at.sigma_y_px);
    if (options.detail) {
      fmt::print(
          "{:12} {:13} {} {:32} err {:+9.5f} {:+9.5f} sigma {:.5f} {:.5f} bound {:.5f} corr {:.4f} inl {:.2f} "
          "contrast {:.2f} blur {:.2f} bend {:.4f} structure {:.2f} lens {:.2f} +- {:.2f}\n",
          session.set, session.target, frame.name, at.ok ? "ok" : at.reason, at.x_px - frame.x_px, at.y_px - frame.y_px,
          at.sigma_x_px, at.sigma_y_px, frame.bound_x_px, at.correlation, at.inlier_share, at.contrast, at.blur_px2,
          (at.linear - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff(), at.structure, 1e8 * at.lens.per_px2,
          1e8 * at.lens.sigma_per_px2);
    }
    if (!frame.valid || !at.ok || !calibration || !exact) continue;
    const vision::Location against = vision::locate_against(masked, marks, frame.image);
    if (!against.ok) continue;
    vision::Location true_at = against;
    true_at.x_px = frame.x_px;
    true_at.y_px = frame.y_px;
    const vision::ErrorUm um = calibration->to_um(against);
    const vision::ErrorUm um_exact = exact->to_um(true_at);
    score.um_numbers += 2;
    score.um += std::pow(um.x_um - frame.ex_um, 2) + std::pow(um.y_um - frame.ey_um, 2);
    if (!marks.empty()) continue;  // the exact positions hold the camera's drift too
    score.um_exact += std::pow(um_exact.x_um - frame.ex_um, 2) + std::pow(um_exact.y_um - frame.ey_um, 2);
  }
}

void run_one_peer(const std::string& name, const BenchSession& session, Score& score) {
  for (const BenchFrame& frame : session.frames) {
    const double start = cpu_ms();
    const auto answer = run_peer(name, session.picture, session.region, frame.image);
    score.ms += cpu_ms() - start;
    const bool ok = answer && (answer->accepted || frame.valid);
    count(score, frame, ok, answer ? answer->x_px : 0.0, answer ? answer->y_px : 0.0, 0.0, 0.0);
  }
}

void print_table(const std::string& method) {
  fmt::print("\n{}\n{:13} {:7} {:>6} {:>5} {:>5} {:>6} {:>9} {:>7} {:>7} {:>9} {:>7} {:>8} {:>6}\n", method, "set",
             "kind", "frames", "refus", "gross", "accept", "1e-3 px", "/bound", "/sigma", "worst px", "um", "um exact",
             "ms");
  for (const auto& [key, s] : scores[method]) {
    const double n = std::max(s.numbers, 1);
    const double um_n = std::max(s.um_numbers, 1);
    fmt::print("{:13} {:7} {:6} {:5} {:5} {:6} {:9.3f} {:7.2f} {:7.2f} {:9.4f} {:7.3f} {:8.3f} {:6.1f}\n", key.first,
               key.second, s.frames, s.refused, s.gross, s.false_accepts, 1e3 * s.rmse(), std::sqrt(s.over_bound / n),
               std::sqrt(s.pull / n), s.worst, std::sqrt(s.um / um_n),
               s.um_exact > 0.0 ? std::sqrt(s.um_exact / um_n) : std::nan(""), s.ms / std::max(s.frames, 1));
  }
}

// Geometric mean over the sets of ours over the best peer.
void print_ratio() {
  double sum = 0.0;
  int sets = 0;
  for (const auto& [key, ours] : scores["zerodrift"]) {
    double best = 1e9;
    for (const std::string& peer : peer_names()) {
      const Score& other = scores[peer][key];
      if (other.numbers > 0 && other.gross * 10 < other.valid) best = std::min(best, other.rmse());
    }
    if (ours.numbers == 0 || best > 1e8) continue;
    fmt::print("{:13} {:7} ours / best peer {:.3f}\n", key.first, key.second, ours.rmse() / best);
    sum += std::log(ours.rmse() / best);
    ++sets;
  }
  if (sets > 0) fmt::print("geometric mean {:.3f}\n", std::exp(sum / sets));
}

bool wanted(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

int run(const Options& options) {
  for (const fs::path& data : options.data) {
    for (const auto& set : fs::directory_iterator(data)) {
      if (!set.is_directory() || !wanted(options.sets, set.path().filename().string())) continue;
      for (const auto& folder : fs::directory_iterator(set)) {
        if (!wanted(options.targets, folder.path().filename().string())) continue;
        const auto session = read_session(folder.path());
        if (!session) {
          fmt::print(stderr, "{}: {}\n", folder.path().string(), describe(session.error()));
          continue;
        }
        const Key key{session->set, session->target == "ball" ? "ball" : "plates"};
        Score ours;
        run_ours(*session, options, ours);
        scores["zerodrift"][key].add(ours);
        if (!options.peers) continue;
        for (const std::string& peer : peer_names()) {
          Score score;
          run_one_peer(peer, *session, score);
          scores[peer][key].add(score);
        }
      }
    }
  }
  print_table("zerodrift");
  if (!options.peers) return 0;
  for (const std::string& peer : peer_names()) print_table(peer);
  print_ratio();
  return 0;
}

}  // namespace
}  // namespace zerodrift::bench

int main(int argc, char** argv) {
  zerodrift::bench::Options options;
  CLI::App app("Accuracy of the image measurement on rendered sessions");
  app.add_option("--data", options.data, "folders written by render_frames")->required();
  app.add_flag("--peers", options.peers, "measure the peers too");
  app.add_flag("--detail", options.detail, "a line a frame");
  app.add_option("--repeat", options.repeat, "locate each frame so often: for a profile, or for the least of the times")
      ->check(CLI::PositiveNumber);
  app.add_option("--targets", options.targets)->delimiter(',');
  app.add_option("--sets", options.sets)->delimiter(',');
  CLI11_PARSE(app, argc, argv);
  return zerodrift::bench::run(options);
}

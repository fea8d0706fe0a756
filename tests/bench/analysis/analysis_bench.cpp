// Prints how well errors of unseen cycles are predicted: our methods and plain peers on the same recording, in the same
// run. Usage: analysis_bench RECORDING.csv [--split HOURS]; and analysis_bench TRAIN.csv --test TEST.csv for two runs.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>

#include "core/analysis/budget.h"
#include "core/analysis/fit.h"
#include "core/analysis/predict.h"
#include "core/recording/csv.h"
#include "tests/bench/analysis/peers.h"

namespace zerodrift {
namespace {

using analysis::Model;
using analysis::TrainingSet;
using recording::Recording;

struct Means {
  double rms_um = 0.0;
  double peak_um = 0.0;
  double removed_percent = 0.0;
};

Means means_of(const std::vector<analysis::ResidualFigures>& figures) {
  Means m;
  const auto n = static_cast<double>(figures.size());
  for (const auto& f : figures) {
    m.rms_um += f.rms_um / n;
    m.peak_um += f.peak_um / n;
    m.removed_percent += f.removed_percent / n;
  }
  return m;
}

void print(const std::string& name, const Means& m, const std::string& more = {}) {
  std::printf("  %-44s rms %6.2f um  peak %6.2f um  removed %5.1f %%  %s\n", name.c_str(), m.rms_um, m.peak_um,
              m.removed_percent, more.c_str());
}

std::vector<analysis::ResidualFigures> figures_of(const analysis::Prediction& p) {
  std::vector<analysis::ResidualFigures> f;
  for (const auto& e : p.errors) f.push_back(e.residual);
  return f;
}

/// Fits, predicts the other recording and prints; false when refused.
bool ours(const std::string& name, const Recording& train, const Recording& test, const analysis::FitOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const auto model = analysis::fit({train}, options);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!model) {
    std::printf("  %-44s refused: %s\n", name.c_str(), describe(model.error()).c_str());
    return false;
  }
  const auto p = analysis::predict(*model, test);
  if (!p) {
    std::printf("  %-44s refused: %s\n", name.c_str(), describe(p.error()).c_str());
    return false;
  }
  double coverage = 1.0;
  double half_width_um = 0.0;
  for (const auto& e : p->errors) {
    coverage = std::min(coverage, e.coverage);
    for (const double w : e.half_width_um) {
      half_width_um += w / static_cast<double>(e.half_width_um.size() * p->errors.size());
    }
  }
  char more[200];
  std::snprintf(more, sizeof more, "%zu sensors, coverage >= %.0f %%, half-width %.1f um, fit %.2f s, table +%.0f %%",
                model->sensors.size(), 100.0 * coverage, half_width_um, seconds, model->table_lost_percent);
  print(name + " (" + std::string(analysis::name_of(model->method)) + ")", means_of(figures_of(*p)), more);
  return true;
}

void peers_on_split(const Recording& whole, double split_s) {
  const auto set = analysis::make_training({whole}, {});
  if (!set) return;
  std::vector<int> train;
  std::vector<int> test;
  for (int i = 0; i < static_cast<int>(set->time_s.size()); ++i) {
    (set->time_s[static_cast<std::size_t>(i)] < split_s ? train : test).push_back(i);
  }
  for (const auto peer : bench::all_peers()) {
    const Eigen::MatrixXd p = bench::predict(peer, *set, train, test);
    std::vector<analysis::ResidualFigures> figures;
    for (Eigen::Index e = 0; e < p.cols(); ++e) {
      Eigen::VectorXd truth(p.rows());
      for (Eigen::Index i = 0; i < p.rows(); ++i) truth(i) = set->error_um(test[static_cast<std::size_t>(i)], e);
      figures.push_back(analysis::residual_figures(truth, p.col(e)));
    }
    print(bench::name_of(peer), means_of(figures));
  }
}

void leave_one_cycle_out(const Recording& whole) {
  const auto set = analysis::make_training({whole}, {});
  if (!set) return;
  std::printf("Leave one cycle out, %s\n", set->folds.in_words.c_str());
  for (const auto peer : bench::all_peers()) {
    double rms = 0.0;
    for (int fold = 0; fold < set->folds.count; ++fold) {
      std::vector<int> train;
      std::vector<int> test;
      for (int i = 0; i < static_cast<int>(set->time_s.size()); ++i) {
        (set->folds.fold_of[static_cast<std::size_t>(i)] == fold ? test : train).push_back(i);
      }
      const Eigen::MatrixXd p = bench::predict(peer, *set, train, test);
      for (Eigen::Index e = 0; e < p.cols(); ++e) {
        Eigen::VectorXd truth(p.rows());
        for (Eigen::Index i = 0; i < p.rows(); ++i) truth(i) = set->error_um(test[static_cast<std::size_t>(i)], e);
        rms += analysis::residual_figures(truth, p.col(e)).rms_um / static_cast<double>(set->folds.count * p.cols());
      }
    }
    std::printf("  %-44s mean rms %6.2f um\n", bench::name_of(peer).c_str(), rms);
  }
  for (const auto method :
       {analysis::Method::ridge, analysis::Method::pcr, analysis::Method::lasso, analysis::Method::robust,
        analysis::Method::dynamic, analysis::Method::arx, analysis::Method::greybox}) {
    const auto e = analysis::evaluate(*set, analysis::make_recipe(method, set->sensors, *set), 0.9);
    if (!e) continue;
    double rms = 0.0;
    for (int fold = 0; fold < set->folds.count; ++fold) {
      for (Eigen::Index c = 0; c < set->error_um.cols(); ++c) {
        Eigen::VectorXd truth = set->error_um.col(c);
        for (Eigen::Index i = 0; i < truth.size(); ++i) {
          if (set->folds.fold_of[static_cast<std::size_t>(i)] != fold) truth(i) = std::nan("");
        }
        rms += analysis::residual_figures(truth, e->predicted_um.col(c)).rms_um /
               static_cast<double>(set->folds.count * set->error_um.cols());
      }
    }
    std::printf("  ours: %-38s mean rms %6.2f um\n", std::string(analysis::name_of(method)).c_str(), rms);
  }
}

void budget(const Recording& train) {
  const auto set = analysis::make_training({train}, {});
  if (!set) return;
  const auto curve = analysis::budget_curve(*set, analysis::Method::dynamic, 8);
  if (!curve) return;
  std::printf("Sensor budget (dynamic, left-out cycles of the training part)\n");
  for (const auto& p : *curve) {
    std::printf("  %zu sensors, last %-6s rms %6.2f um  peak %6.2f um\n", p.sensors.size(), p.sensors.back().c_str(),
                p.held_out_rms_um, p.held_out_peak_um);
  }
}

int run(const std::string& file, const std::string& test_file, double split_h) {
  const auto whole = recording::read_recording(file);
  if (!whole) {
    std::printf("%s\n", describe(whole.error()).c_str());
    return 1;
  }
  Recording train = *whole;
  Recording test;
  if (test_file.empty()) {
    const double split_s = 3600.0 * split_h;
    train = recording::slice_time(*whole, -1e12, split_s);
    test = recording::slice_time(*whole, split_s, 1e12);
    std::printf("Trained to %.1f h, predicted after\n", split_h);
    peers_on_split(*whole, split_s);
  } else {
    auto other = recording::read_recording(test_file);
    if (!other) return 1;
    test = *other;
    std::printf("Trained on %s, predicted %s\n", file.c_str(), test_file.c_str());
  }
  analysis::FitOptions options;
  ours("auto", train, test, options);
  for (const auto method : {analysis::Method::mlr, analysis::Method::ridge, analysis::Method::dynamic}) {
    options.method = method;
    ours("ours", train, test, options);
  }
  for (const int most : {1, 2, 3, 4, 5, 8}) {
    for (const auto method : {analysis::Method::ridge, analysis::Method::dynamic}) {
      options.method = method;
      options.max_sensors = most;
      ours("ours, at most " + std::to_string(most), train, test, options);
    }
  }
  if (test_file.empty()) {
    leave_one_cycle_out(*whole);
    budget(train);
  }
  return 0;
}

}  // namespace
}  // namespace zerodrift

int main(int argc, char** argv) {
  CLI::App app("Errors of unseen cycles: our methods and plain peers");
  std::string file;
  std::string test;
  double split_h = 24.1;
  app.add_option("recording", file, "Recording to train on")->required();
  app.add_option("--test", test, "Another recording to predict");
  app.add_option("--split", split_h, "Hours of the recording to train on, when there is no other one");
  CLI11_PARSE(app, argc, argv);
  return zerodrift::run(file, test, split_h);
}

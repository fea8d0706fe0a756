#include "core/analysis/evaluate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/analysis/budget.h"
#include "core/analysis/cleaning.h"
#include "core/analysis/regressions.h"
#include "core/analysis/structural.h"

namespace zerodrift::analysis {
namespace {

/// What a fold's predictions add to the figures of one error.
struct FoldResult {
  std::vector<double> studentised;  // |residual| / deviation of the prediction
};

/// Predicts left-out rows; the slow noise is carried on from rows of the same run before them (never from after).
Eigen::VectorXd predict_left_out(const RidgeFit& fit, const Rows& train, const Rows& test) {
  Eigen::VectorXd predicted = fit.predict(test.x);
  if (fit.noise.memory_s <= 0.0) return predicted;
  const double from_s = test.time_s.front();
  const double amplitude = remembered_um(fit, train, from_s, test.run.front());
  for (Eigen::Index i = 0; i < predicted.size(); ++i) {
    predicted(i) += amplitude * std::exp(-(test.time_s[static_cast<std::size_t>(i)] - from_s) / fit.noise.memory_s);
  }
  return predicted;
}

/// Deviations within which a normal value lies with this probability.
double normal_reach(double probability) {
  double low = 0.0;
  double high = 10.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (std::erf(middle / std::sqrt(2.0)) < probability ? low : high) = middle;
  }
  return high;
}

/// `by_prior`: the deviations know what one cycle leaves open, so a coverage can be stated where nothing repeats.
Band band_of(const std::vector<FoldResult>& folds, const std::vector<double>& deviations,
             const std::vector<double>& studentised, double coverage, int cycles, bool by_prior) {
  // Never narrower than the model's own claim; the worst cycle speaks for the next one.
  Band band;
  // One cycle leaves nothing out that is like another speed: without a prior the band is the scatter about this run,
  // and no more is claimed for it.
  band.stated_coverage = cycles >= 2 || by_prior ? coverage : 0.0;
  band.guaranteed_coverage = cycles >= 2 ? static_cast<double>(cycles) / (cycles + 1.0) : 0.0;
  band.factor = normal_reach(coverage);
  for (const auto& fold : folds) band.factor = std::max(band.factor, upper_quantile(fold.studentised, coverage));
  band.half_width_um = band.factor * median(deviations);
  double inside = 0.0;
  for (const double s : studentised) inside += s <= band.factor ? 1.0 : 0.0;
  if (!studentised.empty()) band.measured_coverage = inside / static_cast<double>(studentised.size());
  return band;
}

/// The room's channel: the ambient one, else the sensor that the inputs explain least.
std::string room_of(const TrainingSet& set, const std::vector<std::string>& allowed) {
  for (const auto& name : allowed) {
    if (recording::kind_of(name) == recording::ChannelKind::ambient) return name;
  }
  for (const auto& name : spread_order(set, Method::dynamic)) {
    if (std::find(allowed.begin(), allowed.end(), name) != allowed.end()) return name;
  }
  return allowed.front();
}

}  // namespace

Recipe make_recipe(Method method, const std::vector<std::string>& sensors, const TrainingSet& set) {
  Recipe recipe{method, sensors, {}};
  switch (method) {
    case Method::dynamic:
      recipe.features = dynamic_features(sensors, set.runs.front());
      break;
    case Method::arx:
      recipe.features = arx_features(sensors, set.runs.front());
      break;
    case Method::greybox:
      recipe.sensors = {room_of(set, sensors)};
      recipe.features = greybox_features(recipe.sensors.front(), set.runs.front());
      break;
    case Method::physics:
      recipe.features = physics_features(sensors, set.runs.front());
      break;
    default:
      recipe.features = static_features(sensors);
  }
  return recipe;
}

Eigen::MatrixXd errors_at(const TrainingSet& set, const ErrorGroup& group, const std::vector<int>& samples) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(samples.size()), static_cast<Eigen::Index>(group.errors.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t e = 0; e < group.errors.size(); ++e) {
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(e)) = set.error_um(samples[i], group.errors[e]);
    }
  }
  return out;
}

namespace {

/// One cycle: the mean of ridge fits on the first so many sensors (nothing tells which number is right, and their
/// errors on other speeds point different ways), judged by the structural fit on all of them. With many sensors the
/// mean of both is taken; on few the structural fit is loose and only says how far off the others may be.
std::vector<RidgeFit> fit_nested(const Rows& rows, const Eigen::MatrixXd& errors_um, const Recipe& recipe,
                                 const TrainingSet& set) {
  // A controller low-passes its readings, so less is given up than single readings would ask for; the mean of several
  // fits is quieter as well.
  constexpr double share_of_noise = 0.5;
  constexpr Eigen::Index few = 8;
  const Eigen::VectorXd noise_C = share_of_noise * set.feature_noise_C(recipe.features);
  const RidgeChoice choice = default_choice(set.duration_s());
  std::vector<std::vector<RidgeFit>> members;
  for (const std::size_t count : recipe.nested) {
    const auto columns = static_cast<Eigen::Index>(count);
    Rows part = rows;
    part.x = rows.x.leftCols(columns);
    members.push_back(fit_ridge(part, errors_um, choice));
    for (auto& fit : members.back()) fit = for_noisy_readings(fit, part.x, noise_C.head(columns));
  }
  const auto largest = static_cast<Eigen::Index>(recipe.nested.back());
  std::vector<RidgeFit> fits = mean_of(members, largest);
  RidgeFit whole;
  whole.mean = rows.x.colwise().mean().transpose();
  whole.scale = feature_scale(rows.x.rowwise() - whole.mean.transpose());
  for (auto& fit : fits) {  // of all columns, also where no member reached
    whole.beta = Eigen::VectorXd::Zero(rows.x.cols());
    whole.beta.head(largest) = fit.beta;
    whole.intercept = fit.intercept;
    whole.penalty = fit.penalty;
    fit = whole;
  }
  // Its coefficients are small by the prior: the noise of readings needs no further care.
  judge_by(fit_structural(rows, errors_um), rows.x.cols() > few, fits);
  return fits;
}

}  // namespace

Result<std::vector<RidgeFit>> fit_rows(const Rows& rows, const Eigen::MatrixXd& errors_um, const Recipe& recipe,
                                       const TrainingSet& set) {
  const Method method = recipe.method;
  const Eigen::Index needed = method == Method::mlr ? rows.x.cols() + 2 : 6;
  if (rows.size() < needed) {
    return fail(ErrorCode::not_enough_data, {{"what", "the regression"},
                                             {"found", fmt::format("{} measurements", rows.size())},
                                             {"needed", fmt::format("at least {}", needed)}});
  }
  if (method == Method::arx || method == Method::greybox) {
    return fit_poles(rows, errors_um, pole_groups(recipe.features, method == Method::greybox), set.duration_s());
  }
  if (!recipe.nested.empty()) return fit_nested(rows, errors_um, recipe, set);
  std::vector<RidgeFit> fits;
  if (method == Method::ridge || method == Method::dynamic || method == Method::physics) {
    fits = fit_ridge(rows, errors_um, default_choice(set.duration_s()));
  } else {
    Rows one = rows;
    for (Eigen::Index e = 0; e < errors_um.cols(); ++e) {
      one.y = errors_um.col(e);
      fits.push_back(method == Method::mlr     ? fit_multiple(one.x, one.y)
                     : method == Method::pcr   ? fit_components(one.x, one.y)
                     : method == Method::lasso ? fit_lasso(one.x, one.y)
                                               : fit_robust(one));
    }
  }
  if (is_static(method) && method != Method::mlr) {  // the textbook's stays as it is in the textbook
    const Eigen::VectorXd noise_C = set.feature_noise_C(recipe.features);
    for (auto& fit : fits) fit = for_noisy_readings(fit, rows.x, noise_C);
  }
  return fits;
}

namespace {

/// Residuals of the left-out samples of one error, for its band.
struct BandData {
  std::vector<FoldResult> folds;
  std::vector<double> deviations;
  std::vector<double> studentised;
  double noise_square = 0.0;  // summed over the left-out samples
};

/// Leaves one fold out of one group of errors and predicts it.
Status leave_out(const TrainingSet& set, const Recipe& recipe, const Eigen::MatrixXd& x, const ErrorGroup& group,
                 int fold, Evaluation& out, std::vector<BandData>& bands) {
  std::vector<int> in;
  std::vector<int> left_out;
  for (const int s : group.samples) {
    (set.folds.fold_of[static_cast<std::size_t>(s)] == fold ? left_out : in).push_back(s);
  }
  if (left_out.empty()) return {};
  Rows train = rows_of(set, x, in, group.errors.front());
  Rows test = rows_of(set, x, left_out, group.errors.front());
  ZD_TRY(const std::vector<RidgeFit> fits, fit_rows(train, errors_at(set, group, in), recipe, set));
  const Eigen::VectorXd noise_C = set.feature_noise_C(recipe.features);
  for (std::size_t g = 0; g < group.errors.size(); ++g) {
    const Eigen::Index e = group.errors[g];
    train = rows_of(set, x, in, e);
    test = rows_of(set, x, left_out, e);
    const Eigen::VectorXd predicted =
        is_static(recipe.method) ? fits[g].predict(test.x) : predict_left_out(fits[g], train, test);
    const Eigen::VectorXd deviation = fits[g].deviation(test.x);
    BandData& band = bands[static_cast<std::size_t>(e)];
    // Every fold speaks for as many samples as it has.
    band.noise_square +=
        static_cast<double>(test.size()) * fits[g].raw_coefficients().cwiseProduct(noise_C).squaredNorm();
    for (Eigen::Index i = 0; i < test.size(); ++i) {
      out.predicted_um(left_out[static_cast<std::size_t>(i)], e) = predicted(i);
      band.deviations.push_back(deviation(i));
      band.studentised.push_back(std::abs(test.y(i) - predicted(i)) / std::max(deviation(i), 1e-9));
      band.folds[static_cast<std::size_t>(fold)].studentised.push_back(band.studentised.back());
    }
  }
  return {};
}

}  // namespace

namespace {

/// Error to expect of each left-out stretch alone: rms over its samples with the noise of readings, mean over errors.
std::vector<double> expected_by_fold(const TrainingSet& set, const Evaluation& e) {
  std::vector<double> out;
  for (int fold = 0; fold < set.folds.count; ++fold) {
    double sum = 0.0;
    for (Eigen::Index c = 0; c < set.error_um.cols(); ++c) {
      Eigen::VectorXd truth = set.error_um.col(c);
      for (Eigen::Index i = 0; i < truth.size(); ++i) {
        if (set.folds.fold_of[static_cast<std::size_t>(i)] != fold) truth(i) = missing_sample;
      }
      const double rms_um = residual_figures(truth, e.predicted_um.col(c)).rms_um;
      sum += std::hypot(rms_um, e.noise_um[static_cast<std::size_t>(c)]);
    }
    out.push_back(sum / static_cast<double>(set.error_um.cols()));
  }
  return out;
}

}  // namespace

Result<Evaluation> evaluate(const TrainingSet& set, const Recipe& recipe, double coverage, const TaskContext& context) {
  ZD_TRY(const Eigen::MatrixXd x, design(set, recipe.features));
  Evaluation out;
  out.predicted_um = Eigen::MatrixXd::Constant(set.error_um.rows(), set.error_um.cols(), missing_sample);
  std::vector<BandData> bands(set.errors.size());
  for (auto& b : bands) b.folds.resize(static_cast<std::size_t>(set.folds.count));
  for (const auto& group : error_groups(set)) {
    for (int k = 0; k < set.folds.count; ++k) {
      if (context.cancelled()) return fail(ErrorCode::cancelled);
      ZD_CHECK(leave_out(set, recipe, x, group, k, out, bands));
    }
  }
  for (std::size_t e = 0; e < set.errors.size(); ++e) {
    const auto column = static_cast<Eigen::Index>(e);
    out.held_out.push_back(residual_figures(set.error_um.col(column), out.predicted_um.col(column)));
    out.bands.push_back(band_of(bands[e].folds, bands[e].deviations, bands[e].studentised, coverage, set.folds.cycles,
                                !recipe.nested.empty()));
    const double noise_square =
        bands[e].noise_square / static_cast<double>(std::max<std::size_t>(bands[e].deviations.size(), 1));
    out.noise_um.push_back(std::sqrt(noise_square));
    out.mean_noise_um += out.noise_um.back() / static_cast<double>(set.errors.size());
    out.expected_um +=
        std::hypot(out.held_out.back().rms_um, out.noise_um.back()) / static_cast<double>(set.errors.size());
    out.rms_um += out.held_out.back().rms_um / static_cast<double>(set.errors.size());
    out.peak_um += out.held_out.back().peak_um / static_cast<double>(set.errors.size());
  }
  out.fold_um = expected_by_fold(set, out);
  return out;
}

}  // namespace zerodrift::analysis

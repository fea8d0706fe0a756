#include "core/compensation/residual.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace zerodrift::compensation {
namespace {

using Samples = std::vector<ResidualSample>;

/// Error without the constant offset and without limits: what the temperatures cause.
Result<double> thermal_um(const AxisTable& axis, const ResidualSample& sample) {
  AxisTable hot = axis;
  hot.offset_um = 0.0;
  hot.max_um = 1e9;
  AxisTable cold = hot;
  for (auto& term : cold.terms) term.um_per_K = term.slope_um_per_m_per_K = 0.0;
  for (auto& point : cold.points) point.um_per_K = 0.0;
  ZD_TRY(const double with, error_um(hot, sample.position_mm, Approach::up, sample.temperatures));
  ZD_TRY(const double without, error_um(cold, sample.position_mm, Approach::up, sample.temperatures));
  return with - without;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Without the missing ones and without what stands alone: further than 5 robust deviations from the median.
Samples trusted(const Samples& all) {
  Samples present;
  std::copy_if(all.begin(), all.end(), std::back_inserter(present),
               [](const ResidualSample& one) { return std::isfinite(one.residual_um); });
  if (present.size() < 3) return present;
  std::vector<double> values;
  for (const auto& one : present) values.push_back(one.residual_um);
  const double centre = median(values);
  for (double& value : values) value = std::abs(value - centre);
  const double reach = 5.0 * std::max(1.4826 * median(values), 0.5);  // um; below 0.5 all is noise
  std::erase_if(present, [&](const ResidualSample& one) { return std::abs(one.residual_um - centre) > reach; });
  return present;
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

std::vector<double> residuals_of(const Samples& samples) {
  std::vector<double> out;
  for (const auto& one : samples) out.push_back(one.residual_um);
  return out;
}

/// What these samples would leave with the changed table.
Result<std::vector<double>> left_over(const AxisTable& old_axis, const AxisTable& new_axis, const Samples& samples) {
  std::vector<double> out;
  for (const auto& one : samples) {
    ZD_TRY(const double before, error_um(old_axis, one.position_mm, Approach::up, one.temperatures));
    ZD_TRY(const double after, error_um(new_axis, one.position_mm, Approach::up, one.temperatures));
    out.push_back(one.residual_um - (after - before));
  }
  return out;
}

Status measure_after(const AxisTable& old_axis, const AxisTable& new_axis, const Samples& samples,
                     AxisCorrection& row) {
  ZD_TRY(const auto left, left_over(old_axis, new_axis, samples));
  row.rms_after_um = rms(left);
  row.largest_after_um = largest(left);
  return {};
}

/// Fills what does not depend on the method; false when there is no reason to correct.
bool worth_it(const Samples& samples, const ResidualOptions& options, AxisCorrection& row) {
  row.samples = static_cast<int>(samples.size());
  row.rms_before_um = row.rms_after_um = rms(residuals_of(samples));
  row.largest_before_um = row.largest_after_um = largest(residuals_of(samples));
  if (row.samples < options.fewest_samples) {
    row.reason = fmt::format("{} measurements are too few to correct anything", row.samples);
    return false;
  }
  const auto over = std::count_if(samples.begin(), samples.end(), [&](const ResidualSample& one) {
    return std::abs(one.residual_um) > options.threshold_um;
  });
  if (over < options.fewest_samples) {
    row.reason = fmt::format("{} of {} measurements exceed {:.1f} um: no need to correct", over, row.samples,
                             options.threshold_um);
    return false;
  }
  return true;
}

void scale_terms(AxisTable& axis, double kappa) {
  for (auto& term : axis.terms) {
    term.um_per_K *= kappa;
    term.slope_um_per_m_per_K *= kappa;
  }
  for (auto& point : axis.points) point.um_per_K *= kappa;
}

/// residual = (kappa - 1) e_T + offset by least squares with a normal prior round the model as it is; kappa only when
/// it explains more than chance does. A residual is for the most part slow: however many measurements there are, a
/// verification counts as a few independent ones whose scatter is that of the model. What is far outside the prior
/// widens it: a machine that has really changed is believed.
struct Change {
  double kappa = 0.0;
  double offset_um = 0.0;
};

Change shrunk(const Eigen::VectorXd& thermal, const Eigen::VectorXd& residual, const ResidualOptions& options) {
  const auto n = static_cast<double>(thermal.size());
  Eigen::MatrixXd design(thermal.size(), 2);
  design << thermal, Eigen::VectorXd::Ones(thermal.size());
  const Eigen::Vector2d plain = design.colPivHouseholderQr().solve(residual);
  const double left = (residual - design * plain).squaredNorm();
  const double scatter_um = std::max(std::sqrt(left / n), options.model_scatter_um);
  const double weight = std::min(options.independent, n) / n / (scatter_um * scatter_um);
  const auto precision = [](double sigma, double seen) {
    const double excess = std::max(std::abs(seen) - 2.0 * sigma, 0.0);
    return 1.0 / (sigma * sigma + excess * excess);
  };
  const double mean_um = residual.mean();
  const double explained = weight * ((residual.array() - mean_um).matrix().squaredNorm() - left);
  if (explained < options.kappa_evidence) {
    return {0.0, weight * n * mean_um / (weight * n + precision(options.offset_sigma_um, mean_um))};
  }
  Eigen::Matrix2d normal = weight * design.transpose() * design;
  normal(0, 0) += precision(options.kappa_sigma, plain(0));
  normal(1, 1) += precision(options.offset_sigma_um, plain(1));
  const Eigen::Vector2d change = normal.ldlt().solve(weight * design.transpose() * residual);
  return {change(0), change(1)};
}

/// The offset alone where e_T is small; kappa alone where it is large and does not vary.
Status fit_kappa(const AxisTable& axis, const Samples& samples, const ResidualOptions& options, AxisCorrection& row) {
  Eigen::VectorXd thermal(std::ssize(samples));
  Eigen::VectorXd residual(std::ssize(samples));
  for (Eigen::Index i = 0; i < thermal.size(); ++i) {
    const ResidualSample& one = samples[static_cast<std::size_t>(i)];
    ZD_TRY(thermal(i), thermal_um(axis, one));
    residual(i) = one.residual_um;
  }
  const double n = static_cast<double>(thermal.size());
  const double mean_t = thermal.mean();
  const double varies_um = (thermal.array() - mean_t).matrix().norm() / std::sqrt(n);
  double change = 0.0;
  row.kind = CorrectionKind::offset;
  row.offset_um = residual.mean();
  if (varies_um >= options.resolution_um) {  // slope and offset can be told apart
    const Change both = shrunk(thermal, residual, options);
    change = both.kappa;
    row.kind = change == 0.0 ? CorrectionKind::offset : CorrectionKind::both;
    row.offset_um = both.offset_um;
    if (change == 0.0) {
      row.reason = fmt::format(
          "the offset is moved by {:.2f} um; the run does not show that the temperature terms are wrong, so they stay",
          options.smoothing * row.offset_um);
    }
  } else if (thermal.norm() / std::sqrt(n) >= options.resolution_um) {
    // One state only: the whole residual is laid on the temperatures, as kappa = 1 + residual / e_T.
    change = thermal.dot(residual) / thermal.squaredNorm();
    row.kind = CorrectionKind::kappa;
    row.offset_um = 0.0;
  }
  row.offset_um *= options.smoothing;
  row.kappa = std::clamp(1.0 + options.smoothing * change, options.kappa_low, options.kappa_high);
  return {};
}

std::string sentence(const AxisCorrection& row) {
  switch (row.kind) {
    case CorrectionKind::kappa:
      return fmt::format("the temperature terms are multiplied by {:.3f}", row.kappa);
    case CorrectionKind::offset:
      return fmt::format("the prediction is near zero, so the offset is moved by {:.2f} um", row.offset_um);
    case CorrectionKind::both:
      return fmt::format("the temperature terms are multiplied by {:.3f} and the offset is moved by {:.2f} um",
                         row.kappa, row.offset_um);
    case CorrectionKind::none:
      break;
  }
  return row.reason;
}

using AxisMethod = std::function<Status(AxisTable&, const Samples&, AxisCorrection&)>;

Result<Correction> each_axis(const Table& table, const std::map<std::string, Samples>& samples,
                             const ResidualOptions& options, const AxisMethod& method) {
  Correction out{table, {}};
  bool changed = false;
  for (const auto& [name, all] : samples) {
    AxisCorrection row;
    row.axis = name;
    const Samples used = trusted(all);
    if (worth_it(used, options, row)) {
      const AxisTable before = table.axes.contains(name) ? table.axes.at(name) : AxisTable{};
      AxisTable after = before;
      ZD_CHECK(method(after, used, row));
      ZD_CHECK(measure_after(before, after, used, row));
      if (row.rms_after_um < row.rms_before_um) {
        out.table.axes[name] = after;
        changed = true;
      } else {
        row.kind = CorrectionKind::none;
        row.kappa = 1.0;
        row.offset_um = 0.0;
        row.reason = "no correction of the temperature terms makes the residual smaller";
        row.rms_after_um = row.rms_before_um;
        row.largest_after_um = row.largest_before_um;
      }
    }
    out.axes.push_back(row);
  }
  if (changed) ++out.table.version;
  return out;
}

}  // namespace

Result<Correction> correct_residual(const Table& table, const std::map<std::string, Samples>& samples,
                                    const ResidualOptions& options) {
  return each_axis(table, samples, options, [&](AxisTable& axis, const Samples& used, AxisCorrection& row) -> Status {
    ZD_CHECK(fit_kappa(axis, used, options, row));
    scale_terms(axis, row.kappa);
    axis.offset_um += row.offset_um;
    if (row.reason.empty()) row.reason = sentence(row);
    return {};
  });
}

Result<Correction> update_coefficients(const Table& table, const std::map<std::string, Samples>& samples,
                                       const ResidualOptions& options) {
  return each_axis(table, samples, options, [&](AxisTable& axis, const Samples& used, AxisCorrection& row) -> Status {
    // residual = sum of change_i * (T_i - reference_i) + change of the offset; normal prior with mean 0 on each change.
    const auto terms = static_cast<Eigen::Index>(axis.terms.size());
    const auto rows = static_cast<Eigen::Index>(used.size());
    Eigen::MatrixXd design = Eigen::MatrixXd::Ones(rows, terms + 1);
    Eigen::VectorXd seen(rows);
    for (Eigen::Index r = 0; r < rows; ++r) {
      const ResidualSample& one = used[static_cast<std::size_t>(r)];
      const double weight = 1.0 / std::max(one.sigma_um, 0.05);
      for (Eigen::Index c = 0; c < terms; ++c) {
        const TemperatureTerm& term = axis.terms[static_cast<std::size_t>(c)];
        design(r, c) = one.temperatures.at(term.sensor) - term.reference_C;
      }
      design.row(r) *= weight;
      seen(r) = one.residual_um * weight;
    }
    Eigen::VectorXd precision(terms + 1);
    for (Eigen::Index c = 0; c < terms; ++c) {
      const double trust = std::abs(axis.terms[static_cast<std::size_t>(c)].um_per_K) * options.prior_relative_sigma;
      precision(c) = 1.0 / std::pow(std::max(trust, 0.02), 2);  // 0.02 um/K: below this no coefficient is known
    }
    precision(terms) = 1.0 / std::pow(options.threshold_um, 2);
    Eigen::MatrixXd normal = design.transpose() * design;
    normal.diagonal() += precision;
    const Eigen::VectorXd change = normal.ldlt().solve(design.transpose() * seen);
    for (Eigen::Index c = 0; c < terms; ++c) axis.terms[static_cast<std::size_t>(c)].um_per_K += change(c);
    axis.offset_um += change(terms);
    row.kind = CorrectionKind::both;
    row.offset_um = change(terms);
    row.reason = fmt::format("{} coefficients and the offset ({:+.2f} um) were updated", terms, change(terms));
    return {};
  });
}

}  // namespace zerodrift::compensation

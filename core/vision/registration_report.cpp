// What a finished registration says of itself: fit, uncertainty, residuals.

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/vision/other_print.h"
#include "core/vision/registration_solver.h"

namespace zerodrift::vision {
namespace {

constexpr int tiles = tiles_a_side * tiles_a_side;
constexpr double tile_weight = 30.0;  // pixels' worth: a tile with less says nothing
constexpr double most_of_part = 0.95;
constexpr double least_of_tile = 0.5;
constexpr double beyond_noise = 3.3;          // times: 0.1 % of chi-square of eight over eight is above
constexpr double halves_beyond_noise = 25.0;  // the same of one, five standard deviations: it is seldom noise
constexpr double whole_target = 0.97;         // of the pixels: nothing lies over it
constexpr std::size_t least_tiles = 8;        // that tell how even the errors are
constexpr double even_ratio = 1.75;           // upper quartile of the tiles' variances over the lower
constexpr double uneven_ratio = 2.75;         // the same, of covers that were taken for a part of the target
constexpr double at_rest_px = 5e-4;           // a larger last step was followed by others, if it had been let
constexpr double steps_to_come = 3.0;         // times: they shrink slowly where weights and motion wait for each other
constexpr double hidden_weight = 0.05;        // a pixel with less does not show the target
constexpr double least_rim_energy = 0.05;     // of the gradient energy: with less the rim says nothing

bool in_rim(int tile) {
  const int row = tile / tiles_a_side;
  const int column = tile % tiles_a_side;
  return std::min(row, column) == 0 || std::max(row, column) == tiles_a_side - 1;
}

}  // namespace

struct RegistrationSolver::Scores {
  std::array<Vector, tiles> gradient;
  std::array<Normal, tiles> normal;
  std::array<bool, tiles> used{};
  std::array<bool, tiles> hidden{};  // most of what it should show does not fit

  Scores() {
    gradient.fill(Vector::Zero());
    normal.fill(Normal::Zero());
  }
};

std::vector<float> RegistrationSolver::residual_map(int width, int height) const {
  std::vector<float> out(static_cast<std::size_t>(width) * height, std::nanf(""));
  for (int k = 0; k < m_model.pixels; ++k) {
    if (m_pixel_state[k] != FramePatch::seen) continue;
    const auto scale = static_cast<float>(m_scale);
    out[static_cast<std::size_t>(m_model.row[k]) * width + m_model.column[k]] = m_error(k) * m_noise_root(k) / scale;
  }
  return out;
}

void RegistrationSolver::tell_fit(int count, Registration& out) const {
  double sum_w = 0.0, sum_m = 0.0, sum_g = 0.0, energy = 0.0, kept_energy = 0.0, rim_energy = 0.0, rim_kept = 0.0;
  int inliers = 0, seen = 0, bright = 0;
  // The smooth field is taken off the frame first: it is no part of the target.
  Eigen::Matrix<float, row_length, 1> light = Eigen::Matrix<float, row_length, 1>::Zero();
  light.segment<light_count>(motion_count) = -m_light.cast<float>();
  Eigen::VectorXf model = Eigen::VectorXf::Zero(count);
  subtract_model(m_rows.data(), light.data(), count, model.data(), model.data());
  std::vector<std::uint8_t> hidden(static_cast<std::size_t>(count), 0);
  for (int k = 0; k < count; ++k) {
    const double w = m_robust(k);
    hidden[k] = m_pixel_state[k] != FramePatch::seen ? 2 : w < hidden_weight ? 1 : 0;
    sum_w += w;
    sum_m += w * model(k);
    sum_g += w * (model(k) + m_error(k));
    const double e = double{m_model.fx[k]} * m_model.fx[k] + double{m_model.fy[k]} * m_model.fy[k];
    energy += e;
    if (w > 0.25) kept_energy += e;
    if (m_pixel_state[k] == FramePatch::seen && in_rim(m_model.tile[k])) {
      rim_energy += e;
      if (w > 0.25) rim_kept += e;
    }
    inliers += w > 0.25;
    seen += m_pixel_state[k] != FramePatch::outside;
    bright += m_pixel_state[k] == FramePatch::too_bright;
  }
  const Eigen::Map<const Eigen::VectorXf> value(m_model.value.data(), count);
  out.printed_otherwise =
      printed_otherwise(m_model, value + m_error.head(count) / static_cast<float>(std::max(m_light(0), 0.05)), hidden);
  const double mean_m = sum_m / sum_w;
  const double mean_g = sum_g / sum_w;
  double mm = 0.0, gg = 0.0, mg = 0.0;
  for (int k = 0; k < count; ++k) {
    const double w = m_robust(k);
    const double m = model(k) - mean_m;
    const double g = model(k) + m_error(k) - mean_g;
    mm += w * m * m;
    gg += w * g * g;
    mg += w * m * g;
  }
  out.correlation = mg / std::sqrt(mm * gg + 1e-9);
  out.inlier_share = static_cast<double>(inliers) / count;
  out.informed_share = kept_energy / energy;
  out.rim_share = rim_energy > least_rim_energy * energy ? rim_kept / rim_energy : 1.0;
  out.seen_share = static_cast<double>(seen) / count;
  out.saturated_share = static_cast<double>(bright) / count;
}

// Sums over tiles of the region: of weight times error times row (with the field's share taken off) and of weight times
// row times row.
RegistrationSolver::Scores RegistrationSolver::scores_of_tiles(int count) const {
  Scores out;
  std::array<int, tiles + 1> first{};
  for (int k = 0; k < count; ++k) ++first[m_model.tile[k] + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  const auto gain_now = static_cast<float>(m_prepared.gain);
  Rows without_field;
  if (m_field != nullptr) {
    without_field = m_rows.leftCols(count);
    without_field.topRows<motion_count>() *= gain_now;
    m_field->take_off(without_field, count, m_prepared.field.share.cast<float>());
  }
  const Rows& from = m_field != nullptr ? without_field : m_rows;
  // Tile after tile, for sums over many pixels at once.
  Rows rows(row_length, count);
  Eigen::VectorXf weights(count), weighted_errors(count);
  std::array<int, tiles + 1> next = first;
  for (int k = 0; k < count; ++k) {
    const int at = next[m_model.tile[k]]++;
    rows.col(at) = from.col(k);
    weights(at) = m_weight(k);
    weighted_errors(at) = m_weight(k) * m_error(k);
  }
  if (m_field == nullptr) rows.topRows<motion_count>() *= gain_now;
  std::array<double, tiles> energy{}, kept{};
  for (int k = 0; k < count; ++k) {
    if (m_pixel_state[k] != FramePatch::seen) continue;
    const double e = double{m_model.fx[k]} * m_model.fx[k] + double{m_model.fy[k]} * m_model.fy[k];
    energy[m_model.tile[k]] += e;
    if (m_robust(k) * m_neighbours(k) > 0.25f) kept[m_model.tile[k]] += e;
  }
  for (int tile = 0; tile < tiles; ++tile) {
    out.hidden[tile] = kept[tile] < least_of_tile * energy[tile];
    const int begin = first[tile];
    const int size = first[tile + 1] - begin;
    if (size == 0) continue;
    out.used[tile] = weights.segment(begin, size).maxCoeff() > 0.0f;
    Eigen::Matrix<double, row_length, 1> gradient = Eigen::Matrix<double, row_length, 1>::Zero();
    add_products(rows.col(begin).data(), weighted_errors.data() + begin, size, gradient.data());
    out.gradient[tile] = gradient.head<column_count>();
    out.normal[tile] = normal_of(rows.data(), weights.data(), begin, begin + size);
  }
  return out;
}

// Variance of the shift by leaving out each part in turn (Quenouille's and Tukey's jackknife): a few parts that
// carry the result, as a ball's limb does, draw it towards themselves and would look innocent in a sum of squared
// scores. `part_of` tells the part of each tile.
template <typename PartOf>
Eigen::Vector2d RegistrationSolver::jackknife(const Scores& scores, PartOf part_of) const {
  std::array<int, tiles> part{};
  int parts = 0;
  for (int tile = 0; tile < tiles; ++tile) {
    part[tile] = part_of(tile);
    parts = std::max(parts, part[tile] + 1);
  }
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  for (int one = 0; one < parts; ++one) {
    // What is left without the part; at least a share of it, where the others cannot tell a column at all.
    Normal without = m_prepared.normal;
    Vector gradient = Vector::Zero();
    for (int tile = 0; tile < tiles; ++tile) {
      if (part[tile] != one || !scores.used[tile]) continue;
      without -= most_of_part * scores.normal[tile];
      gradient += scores.gradient[tile];
    }
    const Eigen::LDLT<Normal> solved(without);
    if (solved.info() != Eigen::Success) continue;
    squares += solved.solve(gradient).head<2>().cwiseAbs2();
  }
  return squares;
}

// By tiles, and where an error is the same all along an edge, as the blocks of a JPEG picture or folded-down grooves
// make it, by their columns and rows: these are few, so they count only where noise would hardly make so much of them.
Eigen::Vector2d RegistrationSolver::variance_by_parts(const Scores& scores) const {
  Eigen::Vector2d out = jackknife(scores, [](int tile) { return tile; });
  const Eigen::Vector2d by_columns = jackknife(scores, [](int tile) { return tile % tiles_a_side; });
  const Eigen::Vector2d by_rows = jackknife(scores, [](int tile) { return tile / tiles_a_side; });
  const Eigen::Vector2d by_tiles = out;
  for (const Eigen::Vector2d& along : {by_columns, by_rows}) {
    for (int axis = 0; axis < 2; ++axis) {
      if (along(axis) > beyond_noise * by_tiles(axis)) out(axis) = std::max(out(axis), along(axis));
    }
  }
  // Two halves that moved by different amounts: of many parts each says little of that.
  constexpr int half = tiles_a_side / 2;
  const Eigen::Vector2d left_and_right = jackknife(scores, [](int tile) { return tile % tiles_a_side / half; });
  const Eigen::Vector2d above_and_below = jackknife(scores, [](int tile) { return tile / tiles_a_side / half; });
  for (const Eigen::Vector2d& halves : {left_and_right, above_and_below}) {
    for (int axis = 0; axis < 2; ++axis) {
      if (halves(axis) > halves_beyond_noise * by_tiles(axis)) out(axis) = std::max(out(axis), 0.5 * halves(axis));
    }
  }
  return out;
}

// How far the means of the errors over tiles are beyond their noise; returns the variance of single errors.
double RegistrationSolver::tell_structure(int count, Registration& out) const {
  double psi2 = 0.0;
  int used = 0;
  std::array<double, tiles> error{};
  std::array<double, tiles> weight{};
  for (int k = 0; k < count; ++k) {
    const double w = m_robust(k) * m_neighbours(k);
    if (w <= 0.0) continue;
    const double z = m_error(k) * m_noise_root(k);
    ++used;
    psi2 += w * z * w * z;
    const int tile = m_model.tile[k];
    error[tile] += w * z;
    weight[tile] += w;
  }
  const double variance = std::max(psi2 / std::max(used - static_cast<int>(column_count), 1), m_least_variance);
  double structure = 0.0;
  int tiles_used = 0;
  for (int tile = 0; tile < tiles; ++tile) {
    if (weight[tile] < tile_weight) continue;
    structure += error[tile] * error[tile] / (weight[tile] * variance);
    ++tiles_used;
  }
  // The blur's correlated noise alone gives a tile's mean so much; of a part of the pixels, less.
  const double correlated = 1.0 + (m_model.noise_correlation - 1.0) * count / m_model.pixels;
  out.structure = tiles_used > 4 ? std::sqrt(structure / tiles_used / correlated) : 0.0;
  return variance;
}

// By how much what fits badly, and yet fits, may have drawn the result: 1 where the frame shows the target whole, or
// equally well wherever it shows it. A cover that looks like the target by chance, or is made like it by a field and a
// change of light, leaves errors that are rougher than those of the target.
double RegistrationSolver::doubt_of_uneven(int count, const Registration& fit) const {
  if (fit.inlier_share + fit.saturated_share > whole_target) return 1.0;
  std::array<double, tiles> squares{}, weight{};
  for (int k = 0; k < count; ++k) {
    const double w = m_robust(k) * m_neighbours(k);
    if (w <= 0.25) continue;
    const double z = m_error(k) * m_noise_root(k);
    squares[m_model.tile[k]] += w * z * z;
    weight[m_model.tile[k]] += w;
  }
  std::vector<double> variances;
  for (int tile = 0; tile < tiles; ++tile) {
    if (weight[tile] > tile_weight) variances.push_back(std::max(squares[tile] / weight[tile], m_least_variance));
  }
  if (variances.size() < least_tiles) return 1.0;
  std::sort(variances.begin(), variances.end());
  const double ratio = variances[variances.size() * 3 / 4] / variances[variances.size() / 4];
  return 1.0 + (ratio - 1.0) * std::clamp((ratio - even_ratio) / (uneven_ratio - even_ratio), 0.0, 1.0);
}

// A point beside the target's middle moves with every turn, and a template's own noise passes for evidence of one. The
// turn that was found is believed by as much as makes its expected error least (Wiener's filter for one unknown): what
// is expected of it before, against what the noise makes of it. The middle stays where it was found.
void RegistrationSolver::believe_turn(const Normal& inverse, double factor, Registration& out) const {
  const HiddenMotion& hidden = m_model.hidden;
  const Eigen::Vector4d part = hidden.direction / hidden.direction.squaredNorm();
  const Eigen::Vector4d column_part = part / registration_length_px;
  const double formula = column_part.dot(inverse.block<4, 4>(axx, axx) * column_part);
  const double prior = m_prepared.linear_prior / column_part.squaredNorm();
  const double told = std::max(1.0 / formula - prior, 0.0);
  const double all = told * hidden.shown + prior;
  const double seen = told * hidden.shown / all;
  const double noise = factor * told / (all * all);
  const double expected = expected_turn * expected_turn;
  // Round targets tell nothing of it, and by rounding less than nothing.
  const double believed = told > 0.0 ? seen * expected / (seen * seen * expected + noise) : 0.0;
  const double left = 1.0 - believed * seen;
  const double variance = left * left * expected + believed * believed * noise;

  const Eigen::Matrix2d change = out.linear - Eigen::Matrix2d::Identity();
  const double turn = part.dot(Eigen::Vector4d(change(0, 0), change(0, 1), change(1, 0), change(1, 1)));
  Eigen::Matrix2d direction;
  direction << hidden.direction(0), hidden.direction(1), hidden.direction(2), hidden.direction(3);
  const Eigen::Vector2d lever = direction * m_middle;
  out.displacement_px += (1.0 - believed) * turn * lever;
  out.linear -= (1.0 - believed) * turn * direction;
  out.unseen_turn_px2 = std::max(variance - factor * formula, 0.0) * lever * lever.transpose();
  out.covariance_px2 += out.unseen_turn_px2;
}

// Noise: Huber's covariance of an M-estimate, E psi^2 / (E psi')^2, with the blur's noise correlation. Structure left
// in the residual: the scores summed over parts instead of pixels, each part left out in turn, which sees what the
// noise formula cannot: a shade, a lens or a blur that the model misses. The larger of both counts.
void RegistrationSolver::tell_uncertainty(Registration& out) const {
  const int count = m_model.pixels;
  const double variance = tell_structure(count, out);
  double slope = 0.0, sum_w = 0.0;
  int used = 0;
  for (int k = 0; k < count; ++k) {
    const double w = m_robust(k) * m_neighbours(k);
    if (w <= 0.0) continue;
    // The weights are those before the last step, after which an error may lie beyond their reach.
    const double u2 = std::min(std::pow(m_error(k) * m_noise_root(k) / (m_tukey * m_scale), 2), 1.0);
    ++used;
    sum_w += w;
    slope += m_neighbours(k) * (1.0 - u2) * (1.0 - 5.0 * u2);
  }
  const Scores scores = scores_of_tiles(count);
  const double shrink = sum_w / std::max(slope, 0.1 * sum_w);
  // Where most does not fit, what does may do so by chance: an even cover is somewhere as bright as an edge. Such tiles
  // take part in the solve and not in what is said to be known.
  Normal known = m_prepared.normal;
  for (int tile = 0; tile < tiles; ++tile) {
    if (scores.hidden[tile]) known -= most_of_part * scores.normal[tile];
  }
  const Normal inverse = known.inverse();
  const double factor = variance * used / sum_w * shrink * shrink;
  const Eigen::Vector2d growth(std::sqrt(m_model.noise_growth_x), std::sqrt(m_model.noise_growth_y));
  const Eigen::Matrix2d noise = growth.asDiagonal() * inverse.topLeftCorner<2, 2>() * growth.asDiagonal() * factor;
  const Eigen::Vector2d by_parts = variance_by_parts(scores) * (shrink * shrink);
  out.noise_variance_px2 = noise.diagonal();
  Eigen::Matrix<double, 2, column_count> at_middle = Eigen::Matrix<double, 2, column_count>::Zero();
  const Eigen::RowVector2d lever = m_middle.transpose() / registration_length_px;
  at_middle(0, tx) = at_middle(1, ty) = 1.0;
  at_middle.block<1, 2>(0, axx) = lever;
  at_middle.block<1, 2>(1, ayx) = lever;
  const Eigen::Matrix2d middle = at_middle * inverse * at_middle.transpose();
  out.middle_variance_px2 = middle.diagonal().cwiseProduct(growth.cwiseAbs2()) * factor;
  out.middle_px = out.displacement_px + (out.linear - Eigen::Matrix2d::Identity()) * m_middle;
  // Each axis grows to what the parts say; the correlation of the noise formula is kept.
  const Eigen::Vector2d ratio(std::sqrt(std::max(1.0, by_parts(0) / noise(0, 0))),
                              std::sqrt(std::max(1.0, by_parts(1) / noise(1, 1))));
  out.covariance_px2 = ratio.asDiagonal() * noise * ratio.asDiagonal();
  out.covariance_px2 *= std::pow(doubt_of_uneven(count, out), 2);
  if (m_last_step_px > at_rest_px) {
    out.covariance_px2.diagonal().array() += std::pow(steps_to_come * m_last_step_px, 2);
  }
  believe_turn(inverse, factor, out);
  out.lens.per_px2 = m_lens;
  out.lens.sigma_per_px2 = std::sqrt(std::max(inverse(bend, bend) * factor, 0.0)) * registration_lens_unit;
}

}  // namespace zerodrift::vision

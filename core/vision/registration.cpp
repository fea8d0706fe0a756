#include "core/vision/registration.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/vision/blur_match.h"
#include "core/vision/circle_finder.h"
#include "core/vision/frame_patches.h"
#include "core/vision/outline.h"
#include "core/vision/registration_solver.h"
#include "core/vision/smooth_field.h"
#include "core/vision/window_likeness.h"

namespace zerodrift::vision {
namespace {

constexpr double prefilter_px2 = 0.25;  // variance of the blur on both images: keeps the spline's bias below the noise
// In a clear picture what the sampling has folded down outweighs the noise: most of it lies at high frequencies.
constexpr double clear_prefilter_px2 = 0.4;
constexpr double aliased_share = 0.003;  // of the gradients' energy: with less noise a picture is clear
constexpr double aliased_share_along_rows = 0.012;
constexpr double structure_limit = 1.55;     // tile means over their noise: above it a smooth field is solved as well
constexpr double doubtful_structure = 1.1;   // from here on it is tried whether a field moves the result
constexpr double reflected_structure = 0.9;  // from here on what a ball reflects may have moved
constexpr double glance_structure = 3.4;     // the same on a quarter of the pixels, when there is no doubt
constexpr double glance_structure_expected = 1.7;
constexpr double strong_blur_px2 = 1.0;
constexpr double as_good = 0.93;       // of the best fit: blur fits shapes nearly as well before it fits them better
constexpr double glare_share = 0.005;  // of saturated pixels
constexpr double clean_inliers = 0.97;
constexpr double field_spacing_px = 18.0;
constexpr double poor_residual = 4.0;      // grey levels at middle grey: no camera's noise is so large after the blur
constexpr double doubtful_residual = 2.4;  // the same where not all of the target is explained
constexpr double some_hidden = 0.93;       // of the pixels
constexpr int likeness_window_px = 15;
constexpr int largest_rounds = 6;
constexpr int shared_patch_px = 24;         // further apart, two patches are less work than one around both
constexpr double one_body = 0.0015;         // of the linear part
constexpr double straight = 0.01;           // a solve that bent the target more may have been caught by a reflection
constexpr double least_field_bias = 4.0;    // to first order: less of it is not solved for
constexpr double field_bias = 16.0;         // chi-square: four standard deviations, for blur's shape moves both
constexpr double learned_px = 0.002;        // that what was learned of what stands behind moves a target by
constexpr double outline_known_px = 0.003;  // what stands behind is not known better, and draws the outline
constexpr double outline_bias = 6.0;        // one frame in twenty without need: what is reflected is hardly missed
constexpr double outline_in_part = 0.75;    // of the gradient energy: less of it is no better than the whole
constexpr double drawn_middle_px = 5.0;     // a point further from the middle was named on purpose
constexpr double all_but_chips = 0.9;       // of a rim's pixels
constexpr double parts_apart = 25.0;        // chi-square of two numbers
constexpr double all_of_it = 0.98;          // of the pixels
constexpr double turn_step_px = 0.8;        // at the region's edge: a glance follows thin lines half as far
constexpr double least_turn_step_rad = 0.004;
constexpr double nearly_all = 0.9;       // of the gradient energy
constexpr double more_explained = 1.05;  // times what is explained without a turn; covers change it by less

// More of the target explained, and to a smaller residual.
double fit_of(const Registration& r) {
  return r.informed_share * std::max(r.correlation, 0.0) / r.residual;
}

bool needs_field(const Registration& r) {
  return r.structure > structure_limit || (r.saturated_share > glare_share && r.inlier_share < clean_inliers);
}

// Hausman's test (Econometrica 46 (1978) 1251): of two solves one is the more precise, the other - with a field, or
// with less of the target - the more robust. Where they differ by more than their noise allows, the first is biased.
// `limit` is a chi-square of two numbers. True then.
bool biased(const Eigen::Vector2d& moved, const Eigen::Vector2d& precise_variance,
            const Eigen::Vector2d& robust_variance, double limit, double known_px = 0.0) {
  constexpr double least_share = 0.1;  // of the variance, where both hardly differ
  const Eigen::Vector2d expected =
      (robust_variance - precise_variance).cwiseMax(least_share * precise_variance).array() + known_px * known_px;
  return (moved.cwiseAbs2().array() / expected.array()).sum() > limit;
}

bool biased(const Registration& precise, const Registration& robust, double limit, double known_px = 0.0) {
  return biased(robust.displacement_px - precise.displacement_px, precise.noise_variance_px2, robust.noise_variance_px2,
                limit, known_px);
}

bool biased_at_middle(const Registration& precise, const Registration& robust, double limit, double known_px) {
  return biased(robust.middle_px - precise.middle_px, precise.middle_variance_px2, robust.middle_variance_px2, limit,
                known_px);
}

Eigen::Matrix2d turn_of(const Eigen::Matrix2d& linear) {
  return Eigen::Rotation2Dd(std::atan2(linear(1, 0) - linear(0, 1), linear.trace())).toRotationMatrix();
}

Glance glance_from(const RegistrationStart& start, const TemplateModel& model, const FramePatch& patch) {
  Glance out;
  out.ended = start;
  RegistrationSolver solver(model, patch, nullptr, start);
  if (!solver.glance()) return out;
  out.seen = solver.fit(model.pixels / 4);
  solver.hand_over(out.ended);
  out.extra_blur_px2 = solver.extra_blur_px2();
  return out;
}

bool alike(const ImageSetup& a, const ImageSetup& b) {
  return a.template_blur == b.template_blur && a.frame_blur == b.frame_blur;
}

}  // namespace

Registrar::Registrar(TemplateSource source)
    : m_source(completed(std::move(source))),
      m_model(make_template_model(m_source, prefilter_px2 * Eigen::Matrix2d::Identity(),
                                  prefilter_px2 * Eigen::Matrix2d::Identity())) {
  const double noise_ratio = m_source.frame_noise_levels / m_source.noise_levels;
  const double clear_below = runs_along_rows(m_model) ? aliased_share_along_rows : aliased_share;
  if (m_model.noise_share * noise_ratio * noise_ratio < clear_below) {
    const Eigen::Matrix2d wide = clear_prefilter_px2 * Eigen::Matrix2d::Identity();
    m_model = make_template_model(m_source, wide, wide);
  }
  find_noise_effects(m_model);
  m_outline = outline_of(m_source, m_model);
  m_middle = middle_of_turn(m_model);
  if (!m_source.circles) m_source.circles = circles_in(m_source);
  m_rim = Rim::seen_in(m_source, m_model.blur_px2);
  if (m_outline) {
    m_outline_model.emplace(make_template_model(*m_outline, m_model.blur_px2, m_model.blur_px2));
    m_middle = middle_of_turn(*m_outline_model);
    find_noise_effects(*m_outline_model);
  }
  if (m_rim && !m_outline) m_middle = m_rim->middle_px();
}

// Places near each other share a patch: a pattern that repeats has many, a period apart.
std::vector<Glance> Registrar::glances(FramePatches& frame, const std::vector<std::array<int, 2>>& places,
                                       const LensTerm& lens) const {
  std::vector<Glance> out(places.size());
  std::vector<bool> done(places.size(), false);
  for (std::size_t first = 0; first < places.size(); ++first) {
    if (done[first]) continue;
    std::vector<std::size_t> together;
    Region box = patch_around(m_source.region, places[first][0], places[first][1]);
    for (std::size_t k = first; k < places.size(); ++k) {
      const int dx = places[k][0] - places[first][0];
      const int dy = places[k][1] - places[first][1];
      if (done[k] || std::max(std::abs(dx), std::abs(dy)) > shared_patch_px) continue;
      done[k] = true;
      together.push_back(k);
      const Region own = patch_around(m_source.region, places[k][0], places[k][1]);
      const int right = std::max(box.x + box.width, own.x + own.width);
      const int bottom = std::max(box.y + box.height, own.y + own.height);
      box.x = std::min(box.x, own.x), box.y = std::min(box.y, own.y);
      box.width = right - box.x, box.height = bottom - box.y;
    }
    const FramePatch& patch = frame.around(box, m_model.blur_px2);
    for (const std::size_t k : together) {
      RegistrationStart start;
      start.whole_px = {places[k][0], places[k][1]};
      start.lens = lens;
      out[k] = glance_from(start, m_model, patch);
    }
  }
  return out;
}

// Finds on a quarter of the pixels how the frame is blurred against the template and blurs the sharper of the two: only
// then can the rest be solved well, and a smooth field must not take for itself what a blur does.
double Registrar::match_blur_at_a_glance(const PlaceInFrame& place, ImageSetup& setup,
                                         std::optional<TemplateModel>& blurred_model, RegistrationStart& start,
                                         const Glance* glance) const {
  ImageSetup tried = setup;
  std::optional<TemplateModel> tried_model;
  double best = 0.0;
  double saturated_share = 0.0;
  for (int round = 0; round < largest_rounds; ++round) {
    const TemplateModel& model = tried_model ? *tried_model : m_model;
    const Glance look = round == 0 && glance != nullptr ? *glance : glance_from(start, model, place.with(tried));
    const Registration& seen = look.seen;
    if (!seen.converged) break;
    const double now = fit_of(seen);
    saturated_share = seen.saturated_share;
    if (now < as_good * best) break;  // what looked like a blur was none: a chip over the edges, for example
    best = std::max(best, now);
    setup = tried;
    start.shift_px = look.ended.shift_px;
    start.linear = look.ended.linear;
    start.light = look.ended.light;
    if (tried_model) blurred_model = std::move(tried_model);
    if (round == 0 && seen.saturated_share > glare_share && seen.residual > poor_residual) {
      // So much is left under a glaring spot's halo that a blur cannot be told from it: the field comes first.
      setup.with_field = true;
      break;
    }
    if (!match_blur(look.extra_blur_px2, !m_rim, tried)) {
      // Glare has a halo, and a strong blur is never quite of the shape that the template is given.
      const double blur_px2 = (setup.template_blur + setup.frame_blur - 2.0 * m_model.blur_px2).trace();
      const bool expected = seen.saturated_share > glare_share || blur_px2 > strong_blur_px2;
      setup.with_field = seen.structure > (expected ? glance_structure_expected : glance_structure);
      break;
    }
    tried_model = make_template_model(m_source, tried.template_blur, tried.frame_blur);
  }
  return saturated_share;
}

Registration Registrar::run(FramePatches& frame, int dx_px, int dy_px, const LensTerm& lens, bool with_residual_map,
                            const Glance* glance) const {
  const PlaceInFrame place{frame, patch_around(m_source.region, dx_px, dy_px)};
  RegistrationStart start;
  start.whole_px = {dx_px, dy_px};
  start.lens = lens;
  Registration best = attempt(place, start, with_residual_map, glance);
  const auto stuck = [&] {
    return !best.converged || best.residual > (best.inlier_share < some_hidden ? doubtful_residual : poor_residual);
  };
  const auto keep_better = [&](Registration other) {
    best.partly_unlit = best.partly_unlit || other.partly_unlit;
    if (other.converged && (!best.converged || fit_of(other) > fit_of(best))) best = std::move(other);
  };
  if (!stuck()) return best;
  // Under many chips the light, which is guessed first, may have been guessed from them: once more from that of the
  // template.
  start.light.emplace();
  start.light->setZero();
  (*start.light)(0) = 1.0;
  keep_better(attempt(place, start, with_residual_map));
  if (!stuck()) return best;
  // Something in the way that is large against what the target shows pulls at the start: once more from the windows
  // that are like the target where the coarse search has found it.
  const std::vector<std::uint8_t> doubted = unlike(frame.image(), dx_px, dy_px);
  start.light.reset();
  start.doubted = &doubted;
  keep_better(attempt(place, start, with_residual_map));
  return best;
}

// Where a turn moves the ends of thin lines by more than their width, they lie on even paper and count as outliers: the
// middle alone is then fitted, and nothing of what is left pulls towards the turn. Among many starts one fits part of
// nearly anything: only a turn that shows nearly all of the target is worth a look.
std::optional<Registration> Registrar::run_turned(FramePatches& frame, int dx_px, int dy_px, const LensTerm& lens,
                                                  double largest_turn_rad, bool with_residual_map) const {
  const PlaceInFrame place{frame, patch_around(m_source.region, dx_px, dy_px)};
  const FramePatch& patch = place.with({m_model.blur_px2, m_model.blur_px2, false});
  RegistrationStart start;
  start.whole_px = {dx_px, dy_px};
  start.lens = lens;
  const auto explained_from = [&] {
    const Registration seen = glance_from(start, m_model, patch).seen;
    return seen.informed_share * std::max(seen.correlation, 0.0);
  };
  double most = std::max(more_explained * explained_from(), nearly_all);
  double best_rad = 0.0;
  const auto turn_to = [&](double turn_rad) {
    start.linear = Eigen::Rotation2Dd(turn_rad).toRotationMatrix();
    start.shift_px = m_middle - start.linear * m_middle;
  };
  const double half_px = 0.5 * std::max(m_source.region.width, m_source.region.height);
  const double step_rad = std::max(turn_step_px / half_px, least_turn_step_rad);
  const int steps = static_cast<int>(std::lround(largest_turn_rad / step_rad));
  for (int k = -steps; k <= steps; ++k) {
    if (k == 0) continue;
    turn_to(k * step_rad);
    const double explained = explained_from();
    if (explained > most) most = explained, best_rad = k * step_rad;
  }
  if (best_rad == 0.0) return std::nullopt;
  turn_to(best_rad);
  return attempt(place, start, with_residual_map);
}

std::vector<std::uint8_t> Registrar::unlike(const GrayImage& frame, int dx_px, int dy_px) const {
  const Region& region = m_source.region;
  FloatImage weight(region.width, region.height);
  for (std::size_t k = 0; k < weight.values.size(); ++k) weight.values[k] = m_source.usable[k] != 0 ? 1.0f : 0.0f;
  const int margin = m_source.margin_px;
  FloatImage shown(region.width, region.height);
  for (int y = 0; y < region.height; ++y) {
    std::copy_n(m_source.pixels.row(y + margin) + margin, region.width, shown.row(y));
  }
  const FloatImage there = crop(frame, {region.x + dx_px, region.y + dy_px, region.width, region.height});
  const FloatImage likeness = window_likeness(shown, there, weight, likeness_window_px, 1.0);
  std::vector<std::uint8_t> out(likeness.values.size());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = likeness.values[k] > 0.0f ? 0 : 1;
  return out;
}

// What goes from solve to solve: how the images are blurred, the template's model if that is not the usual one, and
// where to start.
struct Registrar::Course {
  const PlaceInFrame& place;
  RegistrationStart start;
  ImageSetup setup;
  std::optional<TemplateModel> blurred_model;
  bool glare = false;
  bool with_residual_map = false;
};

// Light that has changed across a ball is what it reflects, which tells nothing of where it is.
Registration Registrar::attempt(const PlaceInFrame& place, RegistrationStart start, bool with_residual_map,
                                const Glance* glance) const {
  Registration out = by_levels(place, std::move(start), with_residual_map, glance);
  if (!m_rim || !out.converged || out.saturated_share > glare_share) return out;
  out.growth = 0.5 * out.linear.trace() - 1.0;
  const double fits = out.inlier_share + out.saturated_share;
  // Where what stands behind is known the levels tell several times as much, unless what is reflected has moved them:
  // then they do not explain all without more.
  const bool by_rim = m_source.backdrop ? (out.by_outline || out.setup.with_field) && fits > all_but_chips
                                        : out.light_changed || out.structure >= reflected_structure;
  // What does not fit may be the ball itself, and what fits what stands still around it.
  if (!by_rim && (m_source.backdrop || fits > all_of_it)) return out;
  const FramePatch& patch = place.with({m_model.blur_px2, m_model.blur_px2, false});
  const Eigen::Matrix2d blur_px2 = out.setup.template_blur - out.setup.frame_blur;
  auto rim = m_rim->find(patch, out.middle_px, out.contrast, blur_px2);
  if (!by_rim) {
    if (rim && rim->fitting_share > all_but_chips) {
      const Eigen::Vector2d variance = (rim->covariance_px2 + out.covariance_px2).diagonal();
      out.parts_apart = ((rim->moved_px - out.middle_px).array().square() / variance.array()).sum() > parts_apart;
    }
    return out;
  }
  if (m_source.backdrop && (!rim || !biased(rim->moved_px - out.middle_px, out.middle_variance_px2,
                                            rim->covariance_px2.diagonal(), field_bias, outline_known_px))) {
    return out;
  }
  if (out.converged = rim.has_value(); !rim) return out;
  out.growth = rim->growth;
  // Of a rim that is hidden in part the levels know more.
  if (rim->fitting_share < all_but_chips) return out;
  out.structure = 1.0;
  // A strong blur along one direction smears a rim of uneven contrast, and a cover may draw a part of it: where it
  // disagrees neither is known better than that. Changed light may pass for a blur, but seldom moves as one body.
  const bool smeared = blur_px2.trace() > strong_blur_px2 && linear_change(out) < one_body &&
                       !(blur_px2 - 0.5 * blur_px2.trace() * Eigen::Matrix2d::Identity()).isZero();
  const Eigen::Vector2d apart = rim->moved_px - out.middle_px;
  const bool levels_do =
      smeared && !biased(apart, out.middle_variance_px2, rim->covariance_px2.diagonal(), outline_bias);
  const bool doubtful = smeared || fits <= all_of_it;
  if (doubtful) (levels_do ? out.covariance_px2 : rim->covariance_px2).diagonal() += apart.cwiseAbs2();
  if (levels_do) return out;
  out.by_rim = true;
  out.middle_px = out.displacement_px = rim->moved_px;
  out.covariance_px2 = rim->covariance_px2;
  out.unseen_turn_px2.setZero();
  if (m_middle.norm() > drawn_middle_px) {
    const Eigen::Vector2d turned = (out.linear - Eigen::Matrix2d::Identity()) * m_middle;
    out.covariance_px2.diagonal() += turned.cwiseAbs2();
  }
  out.linear.setIdentity();
  out.informed_share = out.inlier_share = rim->fitting_share;
  return out;
}

Registration Registrar::by_levels(const PlaceInFrame& place, RegistrationStart start, bool with_residual_map,
                                  const Glance* glance) const {
  const ImageSetup plain{m_model.blur_px2, m_model.blur_px2, false};
  Course course{place, std::move(start), plain, std::nullopt, false, with_residual_map};
  course.start.middle_px = m_middle;
  const RegistrationStart first_start = course.start;
  course.glare = match_blur_at_a_glance(place, course.setup, course.blurred_model, course.start, glance) > glare_share;
  Registration whole = solve(m_source, m_model, first_start, course);
  whole.light_changed = course.setup.with_field || whole.structure > doubtful_structure;
  if (!outline_tells_more(whole)) return whole;
  // What disagrees may be what is reflected within the outline, and what agrees so far may have been moved by less than
  // the residual shows.
  if (course.setup.with_field && whole.structure < doubtful_structure) return whole;
  course.setup.with_field = false;
  course.start.outline_alone = true;
  const RegistrationStart seen_whole = course.start;
  const ImageSetup setup = course.setup;
  const auto outline_from = [&](const Eigen::Matrix2d& linear) {
    course.setup = setup;
    course.start = seen_whole;
    course.start.linear = linear;
    course.blurred_model.reset();
    return solve(*m_outline, *m_outline_model, course.start, course);
  };
  Registration outline = outline_from(Eigen::Matrix2d::Identity());
  if (!outline.converged) return whole;
  // The outline of thin lines shows a turn, and may do so only from where they overlap: else it is found at the middle
  // alone, and the rest looks hidden. A round one does not care where it starts.
  if (linear_change(whole) > straight && more_explained * outline.informed_share < whole.informed_share) {
    Registration turned = outline_from(turn_of(whole.linear));
    if (turned.converged && turned.informed_share > more_explained * outline.informed_share)
      outline = std::move(turned);
  }
  if (whole.structure < structure_limit && !biased_at_middle(whole, outline, outline_bias, outline_known_px)) {
    // A print turns with the target and fits all over; what is reflected turns with the lamp and does not.
    const bool all_fits = whole.inlier_share + whole.saturated_share > all_of_it;
    if (all_fits || !biased(whole, outline, outline_bias, outline_known_px)) return whole;
  }
  // Of an outline that is hidden in part nothing says that what is left is not drawn by the cover's edge.
  if (outline.informed_share + outline.saturated_share < outline_in_part) {
    const Eigen::Vector2d apart = outline.displacement_px - whole.displacement_px;
    outline.covariance_px2.diagonal() += apart.cwiseAbs2();
  }
  // A region drawn by hand has its own middle some pixels off: a reflection that seems to turn says nothing of that.
  const Eigen::Vector2d lever = course.start.middle_px;
  if (lever.norm() > drawn_middle_px) {
    outline.covariance_px2.diagonal().array() += ((whole.linear - outline.linear) * lever).array().square();
  }
  outline.light_changed = whole.light_changed;
  outline.by_outline = true;
  return outline;
}

// Of a target that was found by all that it shows: whether it is to be found by its outline too.
bool Registrar::outline_tells_more(const Registration& whole) const {
  return m_outline && whole.converged && (m_outline_model->pixels < m_model.pixels || linear_change(whole) > straight);
}

Registration Registrar::solve(const TemplateSource& source, const TemplateModel& usual,
                              const RegistrationStart& first_start, Course& course) const {
  const ImageSetup plain{m_model.blur_px2, m_model.blur_px2, false};
  ImageSetup& setup = course.setup;
  std::optional<TemplateModel>& blurred_model = course.blurred_model;
  Registration out;
  bool field_helped = false;
  bool on_trial = false;
  bool unlit = false;
  const auto remodel = [&] {
    blurred_model.reset();
    if (!alike(setup, plain)) blurred_model = make_template_model(source, setup.template_blur, setup.frame_blur);
  };
  if (!blurred_model) remodel();
  for (int round = 0; round < largest_rounds; ++round) {
    const TemplateModel& model = blurred_model ? *blurred_model : usual;
    std::optional<SmoothField> field;
    if (setup.with_field) field.emplace(model, m_source.region.width, m_source.region.height, field_spacing_px);
    RegistrationSolver solver(model, course.place.with(setup), field ? &*field : nullptr, course.start);
    if (!solver.run()) {
      unlit = unlit || solver.was_partly_unlit();
      // A first attempt without the field may fail in a strong halo; one with it is the last.
      if (setup.with_field && (!course.glare || out.converged || alike(setup, plain))) break;
      // What looked like a strong blur may have been the halo.
      if (setup.with_field) {
        setup = plain;
        course.start = first_start;
        blurred_model.reset();
      }
      setup.with_field = true;
      continue;
    }
    Registration found = solver.fit(model.pixels);
    const bool field_is_new = setup.with_field && out.converged && !field_helped;
    if (field_is_new && found.structure > out.structure) break;  // it explained nothing
    field_helped = setup.with_field;
    if (on_trial) {
      // A trial of the field: what was found without it stands unless it was biased.
      solver.tell_uncertainty(found);
      if (!biased(out, found, field_bias)) break;
    }
    const bool told = on_trial;
    out = found;
    if (course.with_residual_map) {
      out.residual_map = solver.residual_map(m_source.region.width, m_source.region.height);
    }
    solver.hand_over(course.start);
    ImageSetup next = setup;
    const bool blurs = match_blur(solver.extra_blur_px2(), !m_rim, next);
    // The outline comes before a field.
    const bool doubted = &source == &m_source && outline_tells_more(out) && out.structure > doubtful_structure;
    on_trial = !doubted && !setup.with_field && !blurs && !needs_field(out) && out.structure > doubtful_structure;
    next.with_field = setup.with_field || (!doubted && !blurs && (needs_field(out) || on_trial));
    bool last = doubted || (!blurs && next.with_field == setup.with_field) || round + 1 == largest_rounds;
    // What only leads to a better matched blur need not be known so well.
    if (!told && (last || !blurs)) {
      if (blurred_model && blurred_model->noise_growth_x == 0.0) find_noise_effects(*blurred_model);
      solver.tell_uncertainty(out);
    }
    if (on_trial && !last) {
      const SmoothField asked(model, m_source.region.width, m_source.region.height, field_spacing_px);
      const auto step = solver.step_with(asked, out);
      last = !step || !biased(step->moved_px, out.noise_variance_px2, step->noise_variance_px2, least_field_bias);
    }
    if (doubted) setup = next;
    if (last) break;
    setup = next;
    if (blurs) remodel();
  }
  out.partly_unlit = unlit;
  const TemplateModel& last = blurred_model ? *blurred_model : usual;
  out.expected_residual =
      std::hypot(source.noise_levels, source.frame_noise_levels) / std::sqrt(last.noise_correlation);
  out.converged = out.converged && (out.covariance_px2.diagonal().array() > 0.0).all();
  if (m_outline && m_source.backdrop) out.covariance_px2.diagonal().array() += learned_px * learned_px;
  out.setup = setup;
  out.blur_px2 = (setup.template_blur - setup.frame_blur).trace() / 2.0;
  return out;
}

}  // namespace zerodrift::vision

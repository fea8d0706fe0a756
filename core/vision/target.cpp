#include "core/vision/target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/memory.h"
#include "core/vision/acceptance.h"
#include "core/vision/bare_place.h"
#include "core/vision/moved_apart.h"
#include "core/vision/spoilt_picture.h"
#include "core/vision/target_impl.h"
#include "core/vision/target_mask.h"

namespace zerodrift::vision {
namespace {

constexpr int smallest_region_px = 24;
constexpr int candidates_refined = 2;
constexpr double same_place_px = 0.05;
constexpr double rival_merit = 0.75;           // of the best glance: the candidate is refined as well, unless
constexpr double clear_inliers = 0.9;          // the best explains nearly all of the target
constexpr double hopeless_correlation = 0.25;  // of the coarse search: nothing like the target is in the frame
constexpr int candidates_glanced = 8;
constexpr double twin_correlation = 0.95, twin_reach_px = 12.0;
constexpr int most_periods_off = 6;         // that a pattern which repeats is followed back to its place
constexpr double rival_correlation = 0.3;   // a candidate further behind the best is not looked at, and half of it
constexpr double clear_correlation = 0.85;  // when the best is above this
constexpr double sure_correlation = 0.98;   // of the best candidate with its rivals far behind: they need no look
constexpr double sure_lead = 0.15;
// Of the best glance: targets under glare, chips or strong blur have 0.9 and more, other patterns seldom 0.8.
constexpr double least_glance_correlation = 0.8;
constexpr double sure_glance_correlation = 0.98, sure_glance_share = 0.6;
constexpr double least_energy = 4.0;  // mean squared gradient, grey levels^2 / px^2: below it is noise

constexpr double some_covered = 0.05;  // of the region, by what neither travels nor stood there before

bool like_the_target(const Glance& glance) {
  const Registration& seen = glance.seen;
  return seen.converged && seen.correlation >= least_glance_correlation && seen.contrast >= least_contrast;
}

// Enough of it that no place so far behind can be as good.
bool surely_the_target(const Glance& glance) {
  return like_the_target(glance) && glance.seen.correlation > sure_glance_correlation &&
         glance.seen.informed_share > sure_glance_share;
}

bool may_be_turned(Refusal why) {
  return why == Refusal::wrong_target || why == Refusal::occluded || why == Refusal::too_different;
}

// Better of two registrations: more of the target explained, and to a smaller residual; a bad fit has no outliers
// because its scale is large. Below the floor the residual of a glance tells how far it has settled, not how well it
// fits: a pattern that repeats fits one period further as sharply, but not with all of its pixels.
double merit(const Registration& r) {
  constexpr double floor = 2.0;  // grey levels at middle grey
  return r.converged ? r.informed_share * std::max(r.correlation, 0.0) / std::max(r.residual, floor) : -1.0;
}

}  // namespace

std::vector<Target::Impl::Likely> Target::Impl::likeliest(FramePatches& frame, const std::vector<Candidate>& candidates,
                                                          const LensTerm& lens) const {
  const double lead = candidates.size() > 1 ? candidates[0].correlation - candidates[1].correlation : 1.0;
  if (candidates[0].correlation > sure_correlation - sure_lead && lead > sure_lead)
    return {{candidates[0], std::nullopt}};
  double most_saturated = 0.0;
  std::vector<Glance> glances;
  const auto look_at_those_within = [&](double behind) {
    std::vector<std::array<int, 2>> places;
    for (std::size_t k = glances.size(); k < candidates.size(); ++k) {
      if (candidates[k].correlation < candidates.front().correlation - behind) break;
      places.push_back({candidates[k].dx_px, candidates[k].dy_px});
    }
    for (Glance& one : fine.glances(frame, places, lens)) glances.push_back(std::move(one));
  };
  look_at_those_within(0.5 * rival_correlation);
  if (candidates[0].correlation <= clear_correlation &&
      std::none_of(glances.begin(), glances.end(), surely_the_target)) {
    look_at_those_within(rival_correlation);
  }
  for (const Glance& one : glances) most_saturated = std::max(most_saturated, one.seen.saturated_share);
  const auto settled = [](const Glance& one) { return one.seen.converged; };
  // If no glance settles, the fine registration is tried nevertheless; nor does a glance know a halo from the target.
  const bool told = std::any_of(glances.begin(), glances.end(), settled) && most_saturated < some_glare;
  if (told && std::none_of(glances.begin(), glances.end(), like_the_target) &&
      candidates.front().correlation < alike_correlation) {
    return {};
  }
  std::vector<std::size_t> order(glances.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // An even place leaves a small residual without being like the target.
  const auto alike = [&](std::size_t k) { return like_the_target(glances[k]); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return alike(a) != alike(b) ? alike(a) : merit(glances[a].seen) > merit(glances[b].seen);
  });
  // One of two alike is the one that stands nearer to where it stood than to where the other did.
  const auto is_twin = [&](std::size_t k) {
    return std::any_of(twins.begin(), twins.end(), [&](const Candidate& one) {
      return std::hypot(candidates[k].dx_px - one.dx_px, candidates[k].dy_px - one.dy_px) < twin_reach_px;
    });
  };
  const auto as_good = [&](std::size_t k) {
    return !is_twin(k) && alike(k) && merit(glances[k].seen) > rival_merit * merit(glances[order[0]].seen);
  };
  if (is_twin(order[0]) && std::any_of(order.begin(), order.end(), as_good)) {
    order.erase(std::remove_if(order.begin(), order.end(), is_twin), order.end());
  }
  std::vector<Likely> out;
  for (std::size_t k = 0; k < std::min<std::size_t>(order.size(), candidates_refined); ++k) {
    const Registration& seen = glances[order[k]].seen;
    if (k > 0) {
      const Registration& first = glances[order[0]].seen;
      if (alike(order[k]) != alike(order[0]) || merit(seen) <= rival_merit * merit(first)) break;
      // A rival that came to the same place would be the same once more.
      if ((seen.displacement_px - first.displacement_px).norm() < same_place_px) continue;
    }
    out.push_back({candidates[order[k]], glances[order[k]]});
  }
  return out;
}

std::vector<Candidate> Target::Impl::seen_again() const {
  std::vector<Candidate> out = coarse.find(image, candidates_glanced);
  const double apart_px = 0.5 * std::min(region.width, region.height);
  const auto itself = [&](const Candidate& one) {
    return one.correlation < twin_correlation || std::hypot(one.dx_px, one.dy_px) < apart_px;
  };
  out.erase(std::remove_if(out.begin(), out.end(), itself), out.end());
  return out;
}

std::vector<std::uint8_t> Target::Impl::under_a_cover(const GrayImage& frame, const Location& at,
                                                      const std::vector<float>& residual_map) const {
  std::vector<std::uint8_t> out = pixels_under_a_cover(image, region, point, place_of(frame, at), residual_map);
  std::size_t covered = 0;
  for (std::size_t k = 0; k < out.size(); ++k) covered += out[k] != 0 && mask[k] != 0;
  if (static_cast<double>(covered) <= some_covered * static_cast<double>(mask.size())) out.clear();
  return out;
}

TemplateSource Target::Impl::source_of(const Impl& self) {
  TemplateSource source;
  const Region& at = self.region;
  source.pixels = crop(self.image, {at.x - template_margin_px, at.y - template_margin_px,
                                    at.width + 2 * template_margin_px, at.height + 2 * template_margin_px});
  source.margin_px = template_margin_px;
  source.region = at;
  source.point = {self.point.x_px - at.x, self.point.y_px - at.y};
  source.usable = self.mask;
  source.backdrop = self.backdrop;
  source.ball = self.ball;
  if (self.gathered) {
    source.frame_noise_levels = completed(source).noise_levels;
    source.pixels = self.gathered->pixels;
  } else {
    source.circles = self.circles;
  }
  return source;
}

Result<Target> Target::create(const GrayImage& image, const Region& region, std::optional<PixelPoint> point,
                              const std::string& name) {
  const std::string size = fmt::format("{}x{}", image.width, image.height);
  if (!inside(region, image)) {
    return fail(ErrorCode::region_outside_image,
                {{"file", name},
                 {"region", fmt::format("{},{},{},{}", region.x, region.y, region.width, region.height)},
                 {"size", size}});
  }
  if (std::min(region.width, region.height) < smallest_region_px) {
    return fail(ErrorCode::bad_argument, {{"what", "the region of the target"},
                                          {"found", fmt::format("{}x{} pixels", region.width, region.height)},
                                          {"expected", fmt::format("at least {0}x{0}", smallest_region_px)}});
  }
  keep_freed_memory();  // a frame frees and asks for some MB many times, which took a quarter of its time
  const PixelPoint named = point.value_or(centre_of(region));
  const std::optional<RepeatingTarget> telling = RepeatingTarget::that_tells(image, region);
  if (!telling) return fail(ErrorCode::pattern_repeats, {{"file", name}});
  if (!std::isfinite(named.x_px) || !std::isfinite(named.y_px) || std::abs(named.x_px) > 1e5 ||
      std::abs(named.y_px) > 1e5) {
    return fail(ErrorCode::bad_argument,
                {{"what", "the named point"}, {"found", "not a place"}, {"expected", "X,Y in pixels"}});
  }
  std::vector<std::uint8_t> usable = usable_pixels(image, telling->region());
  auto impl = std::make_shared<const Impl>(image, *telling, named,
                                           Learned{std::move(usable), nullptr, nullptr, std::nullopt, std::nullopt});
  const TemplateModel& model = impl->fine.model();
  if ((model.gradient_energy < least_energy && !impl->fine.rim()) || model.pixels < 200) {
    return fail(ErrorCode::template_without_texture, {{"file", name}});
  }
  return Target(std::move(impl));
}

Location Target::locate(const GrayImage& frame) const {
  Registration found;
  std::vector<float> residual_map;
  FramePatches patches(frame);
  Location out = search(patches, &residual_map, &found);
  if (!out.ok) {
    const Eigen::Vector2d moved_px(out.point.x_px - m_impl->point.x_px, out.point.y_px - m_impl->point.y_px);
    out.refusal = told_by_the_picture(out.refusal, frame, m_impl->image, m_impl->region, moved_px);
    out.reason = words_of(out.refusal);
  }
  if (!out.ok) return out;
  const auto refuse = [&](Refusal why) {
    out.ok = false;
    out.refusal = why;
    out.reason = words_of(why);
    out.x_px = out.y_px = out.sigma_x_px = out.sigma_y_px = std::numeric_limits<double>::quiet_NaN();
    return out;
  };
  for (const Disc& disc : m_impl->discs) {
    const Disc::Seen seen = disc.in(frame, m_impl->point, found);
    if (seen == Disc::Seen::elsewhere) return refuse(Refusal::moved_apart);
    if (seen == Disc::Seen::of_another_size) return refuse(Refusal::wrong_target);
  }
  found.residual_map = std::move(residual_map);
  // What a ball shows within its rim is a reflection; where the rim itself is was asked.
  if (!m_impl->fine.rim() && moved_apart(m_impl->fine, m_impl->image, patches, found)) {
    return refuse(Refusal::moved_apart);
  }
  return out;
}

Location Target::search(const GrayImage& frame) const {
  FramePatches patches(frame);
  return search(patches, nullptr, nullptr);
}

Location Target::search(FramePatches& patches, std::vector<float>* residual_map, Registration* fit) const {
  const GrayImage& frame = patches.image();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Location out;
  out.point = m_impl->point;
  out.x_px = out.y_px = out.sigma_x_px = out.sigma_y_px = nan;
  const auto refuse = [&](Refusal why) {
    out.refusal = why;
    out.reason = words_of(why);
    return out;
  };
  if (frame.width != m_impl->image.width || frame.height != m_impl->image.height) return refuse(Refusal::other_size);
  const std::vector<Candidate> candidates = m_impl->coarse.find(frame, candidates_glanced);
  if (candidates.empty() || candidates.front().correlation < hopeless_correlation) return refuse(Refusal::missing);

  Registration best;
  double best_coarse = candidates.front().correlation;
  std::vector<Impl::Likely> likeliest = m_impl->likeliest(patches, candidates, m_lens);
  if (m_impl->backdrop) {
    const auto bare = [&](const Candidate& one) {
      return is_bare(frame, m_impl->image, m_impl->region, *m_impl->backdrop, one.dx_px, one.dy_px);
    };
    likeliest.erase(std::remove_if(likeliest.begin(), likeliest.end(), bare), likeliest.end());
  }
  if (likeliest.empty()) return refuse(Refusal::missing);
  for (const Impl::Likely& one : likeliest) {
    const Registration found = m_impl->fine.run(patches, one.dx_px, one.dy_px, m_lens, residual_map != nullptr,
                                                one.glance ? &*one.glance : nullptr);
    if (merit(found) > merit(best)) {
      best = found;
      best_coarse = one.correlation;
    }
    best.partly_unlit = best.partly_unlit || found.partly_unlit;
    if (refusal_of(best, best_coarse) != Refusal::none || best.correlation <= sure_correlation) continue;
    if (best.inlier_share > clear_inliers) break;
  }
  // All of it may be there, but turned by more than the fit can follow. Of less than all a turn sought so is no
  // evidence.
  for (std::size_t k = 0; k < likeliest.size() && may_be_turned(refusal_of(best, best_coarse)); ++k) {
    const Candidate& one = likeliest[k];
    const auto found =
        m_impl->fine.run_turned(patches, one.dx_px, one.dy_px, m_lens, largest_linear, residual_map != nullptr);
    if (!found || merit(*found) <= merit(best) || refusal_of(*found, one.correlation) != Refusal::none) continue;
    if (found->inlier_share + found->saturated_share < nothing_hidden) continue;
    best = *found;
    best_coarse = one.correlation;
  }
  RepeatingTarget::Doubt doubt;
  if (best.converged) doubt = m_impl->repeating.doubt(frame, best);
  for (int step = 0; doubt.likelier_px && step < most_periods_off; ++step) {
    const Eigen::Vector2d there = best.displacement_px + *doubt.likelier_px;
    const Registration found =
        m_impl->fine.run(patches, static_cast<int>(std::lround(there(0))), static_cast<int>(std::lround(there(1))),
                         m_lens, residual_map != nullptr);
    if (!found.converged || (found.displacement_px - there).norm() > 0.25 * doubt.likelier_px->norm()) break;
    const RepeatingTarget::Doubt left = m_impl->repeating.doubt(frame, found);
    if (left.unlike >= doubt.unlike) break;
    best = found;
    doubt = left;
  }
  out.correlation = best.correlation;
  out.inlier_share = best.inlier_share;
  out.contrast = best.contrast;
  out.blur_px2 = best.blur_px2;
  out.linear = best.linear;
  out.lens = best.lens;
  out.structure = best.structure;
  if (best.converged) {
    out.point = {m_impl->point.x_px + best.displacement_px(0), m_impl->point.y_px + best.displacement_px(1)};
  }
  if (residual_map != nullptr) *residual_map = std::move(best.residual_map);
  if (fit != nullptr) *fit = best;
  const Refusal why = refusal_of(best, best_coarse);
  if (why != Refusal::none) return refuse(why);
  if (doubt.may_be_elsewhere) return refuse(Refusal::ambiguous);
  out.ok = true;
  out.refusal = Refusal::none;
  Eigen::Vector2d moved_px = best.displacement_px;
  Eigen::Matrix2d covariance_px2 = best.covariance_px2;
  if (m_impl->gathered) {
    moved_px -= m_impl->gathered->zero_px;
    covariance_px2 += m_impl->gathered->zero_covariance_px2;
  }
  out.x_px = moved_px(0);
  out.y_px = moved_px(1);
  out.sigma_x_px = std::sqrt(covariance_px2(0, 0));
  out.sigma_y_px = std::sqrt(covariance_px2(1, 1));
  out.covariance_xy_px2 = covariance_px2(0, 1);
  return out;
}

Target Target::with_lens(const LensTerm& lens) const {
  return Target(m_impl, lens);
}

Target Target::with_mask(const std::vector<std::uint8_t>& mask) const {
  if (mask.size() != m_impl->mask.size()) return *this;
  std::vector<std::uint8_t> both = m_impl->mask;
  for (std::size_t k = 0; k < both.size(); ++k) both[k] = both[k] && mask[k];
  Learned learned = *m_impl;
  learned.mask = std::move(both);
  auto impl = std::make_shared<const Impl>(*m_impl, std::move(learned));
  // A mask that leaves hardly anything was learned from frames that do not show the target's motion.
  const double kept = static_cast<double>(impl->fine.model().pixels) / std::max(m_impl->fine.model().pixels, 1);
  return kept > 0.4 ? Target(std::move(impl), m_lens) : *this;
}

Target Target::with_backdrop(std::shared_ptr<const Backdrop> backdrop) const {
  const bool fits = !backdrop || (backdrop->clear.width == m_impl->region.width + 2 * template_margin_px &&
                                  backdrop->clear.height == m_impl->region.height + 2 * template_margin_px);
  if (!fits) return *this;
  Learned learned = *m_impl;
  learned.backdrop = std::move(backdrop);
  return Target(std::make_shared<const Impl>(*m_impl, std::move(learned)), m_lens);
}

// Where the template's own picture shows the target against its mean is the zero; a picture that does not show it has
// none.
Target Target::with_gathered(FloatImage pixels) const {
  const Region& at = m_impl->region;
  if (pixels.width != at.width + 2 * template_margin_px || pixels.height != at.height + 2 * template_margin_px) {
    return *this;
  }
  const auto mean = std::make_shared<GatheredTemplate>();
  mean->pixels = std::move(pixels);
  Learned learned = *m_impl;
  learned.gathered = mean;
  Target out(std::make_shared<const Impl>(*m_impl, std::move(learned)), m_lens);
  const Location zero = out.search(m_impl->image);
  if (!zero.ok) return *this;
  mean->zero_px = {zero.x_px, zero.y_px};
  mean->zero_covariance_px2 << zero.sigma_x_px * zero.sigma_x_px, zero.covariance_xy_px2, zero.covariance_xy_px2,
      zero.sigma_y_px * zero.sigma_y_px;
  return out;
}

const FloatImage* Target::gathered() const {
  return m_impl->gathered ? &m_impl->gathered->pixels : nullptr;
}
const std::shared_ptr<const Backdrop>& Target::backdrop() const {
  return m_impl->backdrop;
}
const LensTerm& Target::lens() const {
  return m_lens;
}
const Region& Target::region() const {
  return m_impl->region;
}
const PixelPoint& Target::point() const {
  return m_impl->point;
}
const GrayImage& Target::image() const {
  return m_impl->image;
}
const std::vector<std::uint8_t>& Target::mask() const {
  return m_impl->mask;
}

}  // namespace zerodrift::vision

#include "core/vision/camera_controls.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace zerodrift::vision {
namespace {

// A camera takes the step of its own next to what is asked.
constexpr double largest_step = 0.1;

}  // namespace

bool HeldControls::change(Control control, double value) {
  const auto before = m_port.value(control);
  if (!before) return false;
  if (*before == value) return true;
  if (!m_port.set(control, value)) return false;
  m_found.push_back({control, *before});
  return true;
}

Status HeldControls::set_asked(Control control, const char* what, double value, double per_unit) {
  const bool taken = change(control, std::round(value / per_unit));
  const auto now = m_port.value(control);
  if (taken && now && std::abs(*now * per_unit - value) <= std::max(largest_step * std::abs(value), per_unit))
    return {};
  return fail(ErrorCode::camera_setting, {{"what", what},
                                          {"found", now ? fmt::format("{:g}", *now * per_unit) : "none"},
                                          {"expected", fmt::format("{:g}", value)}});
}

Status HeldControls::hold(std::optional<double> exposure_us, std::optional<double> gain) {
  // Read before its automatic is off: some devices fall back to a default then.
  const auto holding = [this](Control automatic, double off, Control value) {
    const auto found = m_port.value(value);
    if (!change(automatic, off) || !found) return;
    change(value, *found);
  };
  holding(Control::auto_focus, 0.0, Control::focus);
  holding(Control::auto_white_balance, 0.0, Control::white_balance);
  holding(Control::auto_exposure, manual_exposure, Control::exposure);
  if (exposure_us) ZD_CHECK(set_asked(Control::exposure, "exposure", *exposure_us, exposure_unit_us));
  if (gain) ZD_CHECK(set_asked(Control::gain, "gain", *gain, 1.0));
  return {};
}

void HeldControls::restore() {
  for (auto one = m_found.rbegin(); one != m_found.rend(); ++one) m_port.set(one->control, one->value);
  m_found.clear();
}

std::optional<double> HeldControls::exposure_us() const {
  const auto automatic = m_port.value(Control::auto_exposure);
  const auto exposure = m_port.value(Control::exposure);
  if (!exposure || (automatic && *automatic != manual_exposure)) return std::nullopt;
  return *exposure * exposure_unit_us;
}

std::optional<double> HeldControls::gain() const {
  return m_port.value(Control::gain);
}

}  // namespace zerodrift::vision

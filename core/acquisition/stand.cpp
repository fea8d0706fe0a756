#include "core/acquisition/stand.h"

#include <cmath>

namespace zerodrift::acquisition {
namespace {

constexpr double patience_s = 5.0;  // host time for a controller whose flags follow its axes late
constexpr double pause_s = 0.01;

std::array<double, 3> way_mm(const MachineSample& from, const std::map<std::string, double>& to_mm) {
  std::array<double, 3> way{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string axis(1, "XYZ"[i]);
    const auto at = from.axes.find(axis);
    const auto wanted = to_mm.find(axis);
    if (at != from.axes.end() && wanted != to_mm.end()) way[i] = std::abs(at->second - wanted->second);
  }
  return way;
}

}  // namespace

Stand standing_now(Clock& host) {
  Stand stand;
  stand.left = stand.since = stand.until = host.steady();
  return stand;
}

Status stands_at(const MachineSample& sample, const std::map<std::string, double>& position_mm) {
  const auto not_there = [](const std::string& reason) {
    return fail(ErrorCode::machine_not_ready, {{"what", "a measurement"}, {"reason", reason}});
  };
  if (sample.moving || sample.cycling) return not_there("the axes move");
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string axis(1, "XYZ"[i]);
    const auto at = sample.axes.find(axis);
    const auto wanted = position_mm.find(axis);
    if (at == sample.axes.end() || wanted == position_mm.end()) continue;
    // A controller may show where the axis went by its compensation.
    const double compensated_mm = std::isfinite(sample.applied_um[i]) ? std::abs(sample.applied_um[i]) / 1000.0 : 0.0;
    if (std::abs(at->second - wanted->second) <= there_mm + compensated_mm) continue;
    return not_there("the machine is not at the measuring position");
  }
  return {};
}

Result<Stand> come_to(MachineIo& machine, const std::map<std::string, double>& position_mm, Clock& host) {
  return come_to([&machine] { return machine.read(); },
                 [&machine, &position_mm] { return machine.move_to(position_mm); }, position_mm, host);
}

Result<Stand> come_to(const Reader& read, const std::function<Status()>& move,
                      const std::map<std::string, double>& position_mm, Clock& host) {
  Stand stand;
  ZD_TRY(const MachineSample from, read());
  stand.came_mm = way_mm(from, position_mm);
  stand.left = host.steady();
  ZD_CHECK(move());
  const Seconds end = host.steady() + Seconds(patience_s);
  for (;;) {
    ZD_TRY(const MachineSample now, read());
    const Status there = stands_at(now, position_mm);
    if (there) break;
    if (host.steady() >= end) return fail(there.error());
    host.wait_for(Seconds(pause_s), {});
  }
  stand.since = stand.until = host.steady();
  stand.check = [read, position_mm]() -> Status {
    ZD_TRY(const MachineSample now, read());
    return stands_at(now, position_mm);
  };
  return stand;
}

}  // namespace zerodrift::acquisition

#pragma once
// The table as the controller understands it: the words of docs/register-map.md, decoded, checked and evaluated.
// All of it is compensation (= -error) in um.

#include <array>
#include <cstdint>
#include <span>
#include <tl/expected.hpp>
#include <vector>

namespace zerodrift::machine {

/// Reasons of register 212.
enum class Rejection : std::uint16_t {
  none = 0,
  crc = 1,
  count = 2,
  format = 3,
  limit = 4,
  switch_on = 5,
  axes_move = 6,
  scale = 7,
  sequence = 8,
};

struct TableTerm {
  int sensor = 0;  // 0: the room
  double um_per_K = 0.0;
  double reference_C = 0.0;
  double um_per_m_K = 0.0;
};

struct TablePoint {
  double position_mm = 0.0;
  double up_um = 0.0;
  double down_um = 0.0;
  double um_per_K = 0.0;
};

struct AxisRecord {
  int axis = 0;
  double offset_um = 0.0;
  double reference_mm = 0.0;
  double largest_um = 0.0;
  double rate_um_s = 0.0;
  std::vector<TableTerm> terms;
  std::vector<TablePoint> points;
};

using CompensationTable = std::vector<AxisRecord>;
/// 0 the room, 1 to 20 the sensors.
using TableTemperatures = std::array<double, 21>;

/// The machine's own limits stand in docs/register-map.md.
inline constexpr double largest_compensation_um = 200.0;
inline constexpr double largest_slope_um_per_K = 50.0;

tl::expected<CompensationTable, Rejection> decode_table(std::span<const std::uint16_t> words);
/// Before rate limit and ramp, clamped.
double evaluate(const AxisRecord& record, double position_mm, bool upwards, const TableTemperatures& temperature_C);

float float_of(std::uint16_t high, std::uint16_t low);
std::array<std::uint16_t, 2> words_of(float value);

}  // namespace zerodrift::machine

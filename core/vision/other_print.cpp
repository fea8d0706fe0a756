#include "core/vision/other_print.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace zerodrift::vision {
namespace {

constexpr int bins = 32;
constexpr float levels_a_bin = 8.0f;
constexpr double even_energy = 0.5;       // of the mean squared gradient
constexpr int near_end = 3;               // bins from the darkest or the brightest tone
constexpr double own_share = 0.06;        // of the even pixels: a tone of the target
constexpr double most_tones = 0.5;        // of the range from the darkest tone to the brightest
constexpr float another_tone = 24.0f;     // grey levels
constexpr double least_hidden = 0.05;     // of the even pixels
constexpr double least_both_ways = 0.15;  // of those that show another tone

int bin_of(float level) {
  return std::clamp(static_cast<int>(level / levels_a_bin), 0, bins - 1);
}

}  // namespace

double printed_otherwise(const TemplateModel& model, const Eigen::VectorXf& tone,
                         const std::vector<std::uint8_t>& hidden) {
  std::vector<int> even;
  std::array<int, bins> count{};
  for (int k = 0; k < static_cast<int>(tone.size()); ++k) {
    const double energy = double{model.fx[k]} * model.fx[k] + double{model.fy[k]} * model.fy[k];
    if (energy > even_energy * model.gradient_energy) continue;
    even.push_back(k);
    ++count[bin_of(model.value[k])];
  }
  std::array<bool, bins> own{};
  int first = bins, last = -1, tones = 0;
  for (int b = 0; b < bins; ++b) {
    const int near = count[b] + (b > 0 ? count[b - 1] : 0) + (b + 1 < bins ? count[b + 1] : 0);
    own[b] = near >= own_share * static_cast<double>(even.size());
    if (!own[b]) continue;
    first = std::min(first, b), last = b;
    ++tones;
  }
  if (tones == 0 || tones > most_tones * (last - first + 1)) return 0.0;
  int gone = 0, brighter = 0, darker = 0;
  for (const int k : even) {
    const float change = tone(k) - model.value[k];
    if (hidden[k] != 1 || std::abs(change) < another_tone) continue;
    ++gone;
    const int shown = bin_of(tone(k));
    // A cover of a tone in between - of the backdrop's, say - is brighter here and darker there as well.
    if (own[shown] && std::min(shown - first, last - shown) <= near_end) ++(change > 0.0f ? brighter : darker);
  }
  if (gone < least_hidden * static_cast<double>(even.size())) return 0.0;
  if (std::min(brighter, darker) < least_both_ways * (brighter + darker)) return 0.0;
  return static_cast<double>(brighter + darker) / gone;
}

}  // namespace zerodrift::vision

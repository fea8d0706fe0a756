#include "ui/plots/series.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zerodrift::ui {
namespace {

constexpr float nanF = std::numeric_limits<float>::quiet_NaN();
constexpr double nanD = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void Series::clear() {
  m_time.clear();
  m_value.clear();
  m_levels.clear();
}

void Series::append(const double* time, const double* value, qsizetype count) {
  for (qsizetype i = 0; i < count; ++i) {
    if (!m_time.empty() && !(time[i] > m_time.back())) continue;
    m_time.push_back(time[i]);
    m_value.push_back(value[i]);
    size_t blocks = m_time.size();
    for (size_t level = 0; blocks % factor == 0; ++level) {
      blocks /= factor;
      if (level == m_levels.size()) m_levels.emplace_back();
      float low = nanF;
      float high = nanF;
      for (size_t k = (blocks - 1) * factor; k < blocks * factor; ++k) {
        // fmin and fmax pass over NaN.
        low = std::fmin(low, level == 0 ? static_cast<float>(m_value[k]) : m_levels[level - 1].low[k]);
        high = std::fmax(high, level == 0 ? static_cast<float>(m_value[k]) : m_levels[level - 1].high[k]);
      }
      m_levels[level].low.push_back(low);
      m_levels[level].high.push_back(high);
    }
  }
}

qsizetype Series::indexAt(double time) const {
  return std::lower_bound(m_time.begin(), m_time.end(), time) - m_time.begin();
}

QPair<double, double> Series::extremes(qsizetype first, qsizetype last) const {
  double low = nanD;
  double high = nanD;
  first = std::max<qsizetype>(first, 0);
  last = std::min(last, size());
  while (first < last) {
    // The largest complete block that starts here and ends in time.
    qsizetype length = 1;
    size_t level = 0;
    while (level < m_levels.size() && first % (length * factor) == 0 && first + length * factor <= last) {
      length *= factor;
      ++level;
    }
    if (level == 0) {
      low = std::fmin(low, m_value[static_cast<size_t>(first)]);
      high = std::fmax(high, m_value[static_cast<size_t>(first)]);
    } else {
      const auto block = static_cast<size_t>(first / length);
      low = std::fmin(low, static_cast<double>(m_levels[level - 1].low[block]));
      high = std::fmax(high, static_cast<double>(m_levels[level - 1].high[block]));
    }
    first += length;
  }
  return {low, high};
}

bool Series::view(double from, double to, int columns, QVector<double>* times, QVector<double>* values) const {
  times->clear();
  values->clear();
  if (m_time.empty() || columns < 1) return false;
  const qsizetype first = std::max<qsizetype>(0, indexAt(from) - 1);
  const qsizetype last = std::min(size(), indexAt(to) + 1);
  const qsizetype count = last - first;
  if (count <= 4 * static_cast<qsizetype>(columns)) {
    times->reserve(count);
    values->reserve(count);
    for (qsizetype i = first; i < last; ++i) {
      times->append(time(i));
      values->append(value(i));
    }
    return false;
  }
  times->reserve(qsizetype{2} * columns);
  values->reserve(qsizetype{2} * columns);
  for (int column = 0; column < columns; ++column) {
    const qsizetype a = first + count * column / columns;
    const qsizetype b = first + count * (column + 1) / columns;
    const auto [low, high] = extremes(a, std::min(b + 1, last));
    const bool rising = value(a) <= value(b - 1);
    times->append(time(a));
    values->append(rising ? low : high);
    times->append(time((a + b) / 2));
    values->append(rising ? high : low);
  }
  return true;
}

}  // namespace zerodrift::ui

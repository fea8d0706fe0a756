#pragma once
// One recorded curve with a min/max pyramid: a day at 10 Hz draws as fast as a minute, and no peak is lost.

#include <QPair>
#include <QVector>
#include <vector>

namespace zerodrift::ui {

class Series {
 public:
  void clear();
  /// Times ascending; earlier ones than the last stored are ignored. A value may be NaN: a gap.
  void append(const double* time, const double* value, qsizetype count);
  qsizetype size() const { return static_cast<qsizetype>(m_time.size()); }
  double time(qsizetype i) const { return m_time[static_cast<size_t>(i)]; }
  double value(qsizetype i) const { return m_value[static_cast<size_t>(i)]; }
  /// Index of the first sample not before this time.
  qsizetype indexAt(double time) const;
  /// Smallest and largest value of the samples first .. last-1; NaN when there is none.
  QPair<double, double> extremes(qsizetype first, qsizetype last) const;
  /// Points to draw the stretch from .. to on this many pixel columns: at most two a column, and one beyond each end.
  /// True: there are more than that, and they are pairs, the lowest and the highest of a column and of the next sample.
  bool view(double from, double to, int columns, QVector<double>* times, QVector<double>* values) const;

 private:
  struct Level {
    std::vector<float> low, high;
  };
  static constexpr qsizetype factor = 16;

  std::vector<double> m_time;
  std::vector<double> m_value;
  std::vector<Level> m_levels;  // complete blocks only: level k covers factor^(k+1) samples each
};

}  // namespace zerodrift::ui

#include "core/physics/skyline.h"

#include <algorithm>

namespace zerodrift::physics {

Skyline::Skyline(std::vector<int> first, std::vector<int> order)
    : m_first(std::move(first)), m_order(std::move(order)), m_sorted(m_order.size(), 0.0) {
  std::ptrdiff_t total = 0;
  for (int i = 0; i < static_cast<int>(m_first.size()); ++i) {
    m_start.push_back(total);
    total += i - m_first[i];
    m_chain = m_chain && i - m_first[i] <= 1;
    m_band = m_band && i - m_first[i] <= 2;
  }
  m_below.assign(total, 0.0);
  m_diagonal.assign(m_first.size(), 0.0);
  m_inverse.assign(m_first.size(), 0.0);
  m_chain = m_chain && m_order.empty();
  m_band = m_band && !m_chain;
  if (m_band) {
    m_near.assign(m_first.size() + 2, 0.0);  // two rows of nothing below the last
    m_far = m_near;
  }
  if (m_chain) {
    m_link.assign(m_first.size(), 0.0);
    m_factor.assign(m_first.size(), 0.0);
  }
}

void Skyline::clear() {
  std::fill(m_below.begin(), m_below.end(), 0.0);
  std::fill(m_diagonal.begin(), m_diagonal.end(), 0.0);
}

void Skyline::factor_chain() {
  const int n = static_cast<int>(m_first.size());
  const int middle = n / 2;
  for (int i = 1; i < n; ++i) m_link[i] = m_first[i] < i ? m_below[m_start[i]] : 0.0;
  for (int i = 0; i < middle; ++i) {
    const double pivot = m_diagonal[i] - (i > 0 ? m_factor[i - 1] * m_link[i] : 0.0);
    m_inverse[i] = 1.0 / pivot;
    m_factor[i] = m_link[i + 1] * m_inverse[i];
  }
  for (int i = n - 1; i > middle; --i) {
    const double pivot = m_diagonal[i] - (i + 1 < n ? m_factor[i + 1] * m_link[i + 1] : 0.0);
    m_inverse[i] = 1.0 / pivot;
    m_factor[i] = m_link[i] * m_inverse[i];
  }
  double pivot = m_diagonal[middle];
  if (middle > 0) pivot -= m_factor[middle - 1] * m_link[middle];
  if (middle + 1 < n) pivot -= m_factor[middle + 1] * m_link[middle + 1];
  m_inverse[middle] = 1.0 / pivot;
}

void Skyline::factor() {
  if (m_first.empty()) return;
  if (m_chain) return factor_chain();
  if (m_band) return factor_band();
  const int n = static_cast<int>(m_first.size());
  for (int i = 0; i < n; ++i) {
    double* row = m_below.data() + m_start[i];
    const int low = m_first[i];
    for (int j = low; j < i; ++j) {
      const double* other = m_below.data() + m_start[j];
      const int from = std::max(low, m_first[j]);
      double sum = row[j - low];
      for (int k = from; k < j; ++k) sum -= row[k - low] * other[k - m_first[j]];
      row[j - low] = sum;  // L_ij D_j until the row is complete
    }
    double pivot = m_diagonal[i];
    for (int j = low; j < i; ++j) {
      const double scaled = row[j - low];
      row[j - low] = scaled * m_inverse[j];
      pivot -= scaled * row[j - low];
    }
    m_inverse[i] = 1.0 / pivot;
  }
}

void Skyline::solve_chain(double* x) const {
  const int n = static_cast<int>(m_first.size());
  const int middle = n / 2;
  const double* f = m_factor.data();
  // The upper half has as many rows as the lower or one more; the rows that both have go side by side.
  const int lower = n - 1 - middle;
  if (middle > lower) x[1] -= f[0] * x[0];
  for (int i = middle - lower, k = n - 1; i < middle; ++i, --k) {
    if (i + 1 < middle) x[i + 1] -= f[i] * x[i];
    if (k - 1 > middle) x[k - 1] -= f[k] * x[k];
  }
  if (middle > 0 && n > 2) x[middle] -= f[middle - 1] * x[middle - 1];
  if (middle + 1 < n) x[middle] -= f[middle + 1] * x[middle + 1];
  for (int i = 0; i < n; ++i) x[i] *= m_inverse[i];
  for (int i = middle - 1, k = middle + 1; k < n; --i, ++k) {
    x[i] -= f[i] * x[i + 1];
    x[k] -= f[k] * x[k - 1];
  }
  if (middle > lower) x[0] -= f[0] * x[1];
}

ZERODRIFT_WIDE void Skyline::solve_chain(double* x, std::size_t columns) const {
  const int n = static_cast<int>(m_first.size());
  const int middle = n / 2;
  const auto eliminate = [&](int target, int source, double factor) {
    double* t = x + static_cast<std::size_t>(target) * columns;
    const double* s = x + static_cast<std::size_t>(source) * columns;
    for (std::size_t c = 0; c < columns; ++c) t[c] -= factor * s[c];
  };
  for (int i = 0; i < middle; ++i) eliminate(i + 1, i, m_factor[i]);
  for (int i = n - 1; i > middle; --i) eliminate(i - 1, i, m_factor[i]);
  for (int i = 0; i < n; ++i) {
    double* own = x + static_cast<std::size_t>(i) * columns;
    for (std::size_t c = 0; c < columns; ++c) own[c] *= m_inverse[i];
  }
  for (int i = middle - 1; i >= 0; --i) eliminate(i, i + 1, m_factor[i]);
  for (int i = middle + 1; i < n; ++i) eliminate(i, i - 1, m_factor[i]);
}

void Skyline::factor_band() {
  const int n = static_cast<int>(m_first.size());
  for (int i = 0; i < n; ++i) {
    const double* row = m_below.data() + m_start[i];
    const int width = i - m_first[i];
    const double far = width == 2 ? row[0] : 0.0;  // L_ij D_j
    double near = width == 2 ? row[1] : width == 1 ? row[0] : 0.0;
    double pivot = m_diagonal[i];
    if (far != 0.0) {
      near -= far * m_near[i - 1];
      m_far[i] = far * m_inverse[i - 2];
      pivot -= far * m_far[i];
    } else {
      m_far[i] = 0.0;
    }
    m_near[i] = i > 0 ? near * m_inverse[i - 1] : 0.0;
    m_inverse[i] = 1.0 / (pivot - near * m_near[i]);
  }
}

void Skyline::solve_band(double* x) const {
  const int n = static_cast<int>(m_first.size());
  double before = 0.0, last = 0.0;
  for (int i = 0; i < n; ++i) {
    const double now = x[i] - m_far[i] * before - m_near[i] * last;
    x[i] = now;
    before = last;
    last = now;
  }
  double after = 0.0, next = 0.0;  // rows i + 2 and i + 1
  for (int i = n - 1; i >= 0; --i) {
    const double now = x[i] * m_inverse[i] - m_far[i + 2] * after - m_near[i + 1] * next;
    x[i] = now;
    after = next;
    next = now;
  }
}

void Skyline::solve(double* given) {
  const int n = static_cast<int>(m_first.size());
  if (m_chain) return solve_chain(given);
  double* x = given;
  if (!m_order.empty()) {
    x = m_sorted.data();
    for (int i = 0; i < n; ++i) x[i] = given[m_order[i]];
  }
  if (m_band) {
    solve_band(x);
    for (int i = 0; i < n && x != given; ++i) given[m_order[i]] = x[i];
    return;
  }
  for (int i = 0; i < n; ++i) {
    const double* row = m_below.data() + m_start[i];
    double sum = x[i];
    for (int j = m_first[i]; j < i; ++j) sum -= row[j - m_first[i]] * x[j];
    x[i] = sum;
  }
  for (int i = 0; i < n; ++i) x[i] *= m_inverse[i];
  for (int i = n - 1; i >= 0; --i) {
    const double* row = m_below.data() + m_start[i];
    for (int j = m_first[i]; j < i; ++j) x[j] -= row[j - m_first[i]] * x[i];
  }
  for (int i = 0; i < n && x != given; ++i) given[m_order[i]] = x[i];
}

ZERODRIFT_WIDE void Skyline::solve(double* x, std::size_t columns) const {
  if (m_chain) return solve_chain(x, columns);
  const int n = static_cast<int>(m_first.size());
  const auto at = [&](int i) { return x + static_cast<std::size_t>(m_order.empty() ? i : m_order[i]) * columns; };
  if (m_band) {
    for (int i = 1; i < n; ++i) {
      double* own = at(i);
      const double* last = at(i - 1);
      const double* before = at(std::max(0, i - 2));
      const double near = m_near[i], far = m_far[i];
      for (std::size_t c = 0; c < columns; ++c) own[c] -= near * last[c] + far * before[c];
    }
    for (int i = n - 1; i >= 0; --i) {
      double* own = at(i);
      const double* next = at(std::min(n - 1, i + 1));
      const double* after = at(std::min(n - 1, i + 2));
      const double inverse = m_inverse[i], near = m_near[i + 1], far = m_far[i + 2];
      for (std::size_t c = 0; c < columns; ++c) own[c] = own[c] * inverse - near * next[c] - far * after[c];
    }
    return;
  }
  for (int i = 0; i < n; ++i) {
    double* target = at(i);
    for (int j = m_first[i]; j < i; ++j) {
      const double factor = m_below[m_start[i] + j - m_first[i]];
      if (factor == 0.0) continue;
      const double* other = at(j);
      for (std::size_t c = 0; c < columns; ++c) target[c] -= factor * other[c];
    }
  }
  for (int i = 0; i < n; ++i) {
    double* own = at(i);
    for (std::size_t c = 0; c < columns; ++c) own[c] *= m_inverse[i];
  }
  for (int i = n - 1; i >= 0; --i) {
    const double* own = at(i);
    for (int j = m_first[i]; j < i; ++j) {
      const double factor = m_below[m_start[i] + j - m_first[i]];
      if (factor == 0.0) continue;
      double* other = at(j);
      for (std::size_t c = 0; c < columns; ++c) other[c] -= factor * own[c];
    }
  }
}

}  // namespace zerodrift::physics

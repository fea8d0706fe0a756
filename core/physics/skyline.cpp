#include "core/physics/skyline.h"

#include <algorithm>

namespace zerodrift::physics {

Skyline::Skyline(std::vector<int> first) : m_first(std::move(first)) {
  std::ptrdiff_t total = 0;
  for (int i = 0; i < static_cast<int>(m_first.size()); ++i) {
    m_start.push_back(total);
    total += i - m_first[i];
    m_chain = m_chain && i - m_first[i] <= 1;
  }
  m_below.assign(total, 0.0);
  m_diagonal.assign(m_first.size(), 0.0);
  m_inverse.assign(m_first.size(), 0.0);
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

void Skyline::solve_chain(double* x, std::size_t columns) const {
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

void Skyline::solve(double* x) const {
  const int n = static_cast<int>(m_first.size());
  if (m_chain) return solve_chain(x);
  for (int i = 0; i < n; ++i) {
    const double* row = m_below.data() + m_start[i];
    for (int j = m_first[i]; j < i; ++j) x[i] -= row[j - m_first[i]] * x[j];
  }
  for (int i = 0; i < n; ++i) x[i] *= m_inverse[i];
  for (int i = n - 1; i >= 0; --i) {
    const double* row = m_below.data() + m_start[i];
    for (int j = m_first[i]; j < i; ++j) x[j] -= row[j - m_first[i]] * x[i];
  }
}

void Skyline::solve(double* x, std::size_t columns) const {
  if (m_chain) return solve_chain(x, columns);
  const int n = static_cast<int>(m_first.size());
  for (int i = 0; i < n; ++i) {
    double* target = x + static_cast<std::size_t>(i) * columns;
    for (int j = m_first[i]; j < i; ++j) {
      const double factor = m_below[m_start[i] + j - m_first[i]];
      const double* other = x + static_cast<std::size_t>(j) * columns;
      for (std::size_t c = 0; c < columns; ++c) target[c] -= factor * other[c];
    }
  }
  for (int i = 0; i < n; ++i) {
    double* own = x + static_cast<std::size_t>(i) * columns;
    for (std::size_t c = 0; c < columns; ++c) own[c] *= m_inverse[i];
  }
  for (int i = n - 1; i >= 0; --i) {
    const double* own = x + static_cast<std::size_t>(i) * columns;
    for (int j = m_first[i]; j < i; ++j) {
      const double factor = m_below[m_start[i] + j - m_first[i]];
      double* other = x + static_cast<std::size_t>(j) * columns;
      for (std::size_t c = 0; c < columns; ++c) other[c] -= factor * own[c];
    }
  }
}

}  // namespace zerodrift::physics

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
}

void Skyline::clear() {
  std::fill(m_below.begin(), m_below.end(), 0.0);
  std::fill(m_diagonal.begin(), m_diagonal.end(), 0.0);
}

void Skyline::factor() {
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

void Skyline::solve(double* x) const {
  const int n = static_cast<int>(m_first.size());
  if (m_chain) {
    // The same as below with the row loops written out: at most one entry a row.
    for (int i = 1; i < n; ++i) {
      if (m_first[i] < i) x[i] -= m_below[m_start[i]] * x[i - 1];
    }
    for (int i = 0; i < n; ++i) x[i] *= m_inverse[i];
    for (int i = n - 1; i > 0; --i) {
      if (m_first[i] < i) x[i - 1] -= m_below[m_start[i]] * x[i];
    }
    return;
  }
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

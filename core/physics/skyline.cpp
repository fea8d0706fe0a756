#include "core/physics/skyline.h"

#include <algorithm>

namespace zerodrift::physics {

Skyline::Skyline(const std::vector<std::vector<int>>& columns, std::vector<int> order) : m_order(std::move(order)) {
  const std::size_t n = columns.size();
  const auto place = [&](std::size_t i) { return m_order.empty() ? i : static_cast<std::size_t>(m_order[i]); };
  m_up.assign(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    m_start.push_back(m_column.size());
    for (const int column : columns[i]) {
      const auto at = static_cast<std::size_t>(column);
      m_column.push_back(at);
      m_place.push_back(place(at));
      ++m_up[at + 1];
      m_chain = m_chain && at + 1 == i;
      m_band = m_band && at + 2 >= i;
    }
  }
  m_start.push_back(m_column.size());
  for (std::size_t i = 0; i < n; ++i) m_up[i + 1] += m_up[i];
  m_up_entry.resize(m_column.size());
  m_up_place = m_up_entry;
  std::vector<std::size_t> next(m_up.begin(), m_up.end() - 1);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t e = m_start[i]; e < m_start[i + 1]; ++e) {
      const std::size_t to = next[m_column[e]]++;
      m_up_entry[to] = e;
      m_up_place[to] = place(i);
    }
  }
  m_below.assign(m_column.size(), 0.0);
  m_diagonal.assign(n, 0.0);
  m_inverse = m_work = m_diagonal;
  m_chain = m_chain && m_order.empty();
  constexpr std::size_t worth_two_halves = 8;
  m_band = m_band && !m_chain && n >= worth_two_halves;
  if (m_band) m_near = m_far = m_near_up = m_far_up = m_diagonal;
  if (m_chain) m_link = m_factor = m_diagonal;
}

std::size_t Skyline::find(std::size_t row, std::size_t column) const {
  std::size_t at = m_start[row];
  while (at < m_start[row + 1] && m_column[at] != column) ++at;
  return at;
}

double Skyline::entry(std::size_t row, std::size_t column) const {
  const std::size_t at = find(row, column);
  return at < m_start[row + 1] ? m_below[at] : 0.0;
}

void Skyline::clear() {
  std::fill(m_below.begin(), m_below.end(), 0.0);
  std::fill(m_diagonal.begin(), m_diagonal.end(), 0.0);
}

void Skyline::factor_chain() {
  const int n = static_cast<int>(size());
  const int middle = n / 2;
  for (int i = 1; i < n; ++i) m_link[i] = m_start[i] < m_start[i + 1] ? m_below[m_start[i]] : 0.0;
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
  if (m_chain) return size() == 0 ? void() : factor_chain();
  if (m_band) return factor_band();
  for (std::size_t i = 0; i < size(); ++i) {
    double pivot = m_diagonal[i];
    for (std::size_t e = m_start[i]; e < m_start[i + 1]; ++e) {
      const std::size_t j = m_column[e];
      double sum = m_below[e];
      for (std::size_t f = m_start[j]; f < m_start[j + 1]; ++f) sum -= m_below[f] * m_work[m_column[f]];
      m_work[j] = sum;  // L_ij D_j
    }
    for (std::size_t e = m_start[i]; e < m_start[i + 1]; ++e) {
      const std::size_t j = m_column[e];
      m_below[e] = m_work[j] * m_inverse[j];
      pivot -= m_below[e] * m_work[j];
      m_work[j] = 0.0;
    }
    m_inverse[i] = 1.0 / pivot;
  }
}

/// The last row of each half stays in a register: written and read again it would be waited for.
ZERODRIFT_WIDE void Skyline::solve_chain(double* x) const {
  const std::size_t n = size();
  const std::size_t middle = n / 2;
  const double* f = m_factor.data();
  const double* inverse = m_inverse.data();
  double up = middle > 0 ? x[0] : 0.0;
  double down = n > middle + 1 ? x[n - 1] : 0.0;
  // The upper half has as many rows as the lower or one more; the rows that both have go side by side.
  std::size_t i = 1;
  for (std::size_t k = n - 2; k + 1 > middle + 1; ++i, --k) {
    x[i] = up = x[i] - f[i - 1] * up;
    x[k] = down = x[k] - f[k + 1] * down;
  }
  if (i < middle) x[i] = up = x[i] - f[i - 1] * up;
  double centre = x[middle];
  if (middle > 0) centre -= f[middle - 1] * up;
  if (middle + 1 < n) centre -= f[middle + 1] * down;
  up = down = x[middle] = centre * inverse[middle];
  i = middle;
  for (std::size_t k = middle + 1; k < n; ++k) {
    --i;
    x[i] = up = x[i] * inverse[i] - f[i] * up;
    x[k] = down = x[k] * inverse[k] - f[k] * down;
  }
  if (i > 0) x[0] = x[0] * inverse[0] - f[0] * up;
}

ZERODRIFT_WIDE void Skyline::solve_lanes_of_chain(double* x) const {
  const std::size_t n = size();
  const std::size_t middle = n / 2;
  Four* rows = reinterpret_cast<Four*>(x);
  for (std::size_t i = 0; i < middle; ++i) {
    rows[2 * i + 2] -= m_factor[i] * rows[2 * i];
    rows[2 * i + 3] -= m_factor[i] * rows[2 * i + 1];
  }
  for (std::size_t i = n - 1; i > middle; --i) {
    rows[2 * i - 2] -= m_factor[i] * rows[2 * i];
    rows[2 * i - 1] -= m_factor[i] * rows[2 * i + 1];
  }
  for (std::size_t i = 0; i < n; ++i) {
    rows[2 * i] *= m_inverse[i];
    rows[2 * i + 1] *= m_inverse[i];
  }
  for (std::size_t i = middle; i-- > 0;) {
    rows[2 * i] -= m_factor[i] * rows[2 * i + 2];
    rows[2 * i + 1] -= m_factor[i] * rows[2 * i + 3];
  }
  for (std::size_t i = middle + 1; i < n; ++i) {
    rows[2 * i] -= m_factor[i] * rows[2 * i - 2];
    rows[2 * i + 1] -= m_factor[i] * rows[2 * i - 1];
  }
}

void Skyline::factor_band() {
  const std::size_t n = size();
  const std::size_t m = middle();
  // Entries of the matrix beside the diagonal, 0 outside the envelope.
  const auto beside = [&](std::size_t i, std::size_t distance) {
    return i < n && i >= distance ? entry(i, i - distance) : 0.0;
  };
  std::vector<double>& pivot = m_inverse;  // the diagonal as it is left; rows already eliminated hold 1 / pivot
  for (std::size_t i = 0; i < n; ++i) pivot[i] = m_diagonal[i];
  for (std::size_t i = 0; i <= m + 1; ++i) {
    const double far = i >= 2 ? beside(i, 2) : 0.0;
    m_far[i] = i >= 2 ? far * m_inverse[i - 2] : 0.0;
    pivot[i] -= far * m_far[i];
    if (i > m) break;
    const double near = i >= 1 ? beside(i, 1) - far * m_near[i - 1] : 0.0;
    m_near[i] = i >= 1 ? near * m_inverse[i - 1] : 0.0;
    pivot[i] -= near * m_near[i];
    if (i < m) m_inverse[i] = 1.0 / pivot[i];
  }
  for (std::size_t k = n; k-- > m;) {
    const double far = beside(k + 2, 2);
    m_far_up[k] = k + 2 < n ? far * m_inverse[k + 2] : 0.0;
    pivot[k] -= far * m_far_up[k];
    if (k == m) break;
    const double near = k + 1 < n ? beside(k + 1, 1) - far * m_near_up[k + 1] : 0.0;
    m_near_up[k] = k + 1 < n ? near * m_inverse[k + 1] : 0.0;
    pivot[k] -= near * m_near_up[k];
    if (k > m + 1) m_inverse[k] = 1.0 / pivot[k];
  }
  const double across = beside(m + 1, 1) - beside(m + 1, 2) * m_near[m] - beside(m + 2, 2) * m_near_up[m + 1];
  const double scale = 1.0 / (pivot[m] * pivot[m + 1] - across * across);
  m_middle[0] = pivot[m + 1] * scale;
  m_middle[1] = -across * scale;
  m_middle[2] = pivot[m] * scale;
}

ZERODRIFT_WIDE void Skyline::solve_band(double* x) const {
  const std::size_t n = size();
  const std::size_t m = middle();
  const int* order = m_order.empty() ? nullptr : m_order.data();
  const auto at = [&](std::size_t i) -> double& {
    return x[order == nullptr ? i : static_cast<std::size_t>(order[i])];
  };
  double before = 0.0, last = 0.0, before_up = 0.0, last_up = 0.0;
  for (std::size_t i = 0, k = n - 1; k >= m + 2; ++i, --k) {
    const double up = at(k) - m_far_up[k] * before_up - m_near_up[k] * last_up;
    before_up = last_up;
    last_up = at(k) = up;
    if (i >= m) break;
    const double now = at(i) - m_far[i] * before - m_near[i] * last;
    before = last;
    last = at(i) = now;
  }
  const double one = at(m) - m_far[m] * before - m_near[m] * last - m_far_up[m] * last_up;
  const double two = at(m + 1) - m_far[m + 1] * last - m_near_up[m + 1] * last_up - m_far_up[m + 1] * before_up;
  double next = at(m) = m_middle[0] * one + m_middle[1] * two;
  double next_up = at(m + 1) = m_middle[1] * one + m_middle[2] * two;
  double after = next_up, after_up = next;
  // The nearest row comes last: it is the one that is waited for.
  for (std::size_t i = m, k = m + 2; k < n; ++k) {
    const double up = at(k) * m_inverse[k] - m_far_up[k - 2] * after_up - m_near_up[k - 1] * next_up;
    after_up = next_up;
    next_up = at(k) = up;
    if (i == 0) continue;
    --i;
    const double now = at(i) * m_inverse[i] - m_far[i + 2] * after - m_near[i + 1] * next;
    after = next;
    next = at(i) = now;
  }
}

ZERODRIFT_WIDE void Skyline::solve(double* x) const {
  if (m_chain) return solve_chain(x);
  if (m_band) return solve_band(x);
  const std::size_t n = size();
  const auto place = [&](std::size_t i) { return m_order.empty() ? i : static_cast<std::size_t>(m_order[i]); };
  for (std::size_t i = 0; i < n; ++i) {
    double sum = x[place(i)];
    for (std::size_t e = m_start[i]; e < m_start[i + 1]; ++e) sum -= m_below[e] * x[m_place[e]];
    x[place(i)] = sum;
  }
  for (std::size_t i = n; i-- > 0;) {
    double sum = x[place(i)] * m_inverse[i];
    for (std::size_t u = m_up[i]; u < m_up[i + 1]; ++u) sum -= m_below[m_up_entry[u]] * x[m_up_place[u]];
    x[place(i)] = sum;
  }
}

/// The two rows that the next one of its half needs stay in registers, and the halves take turns, so that neither waits
/// for itself alone. Everything is written out here: what is called would be
/// compiled for the narrow registers.
ZERODRIFT_WIDE void Skyline::solve_lanes_of_band(double* x) const {
  const std::size_t n = size();
  const std::size_t m = middle();
  const int* order = m_order.empty() ? nullptr : m_order.data();
  const auto at = [&](std::size_t i) {
    return reinterpret_cast<Four*>(x + (order == nullptr ? i : static_cast<std::size_t>(order[i])) * lanes);
  };
  Four last_a{}, last_b{}, before_a{}, before_b{};
  Four last_up_a{}, last_up_b{}, before_up_a{}, before_up_b{};
  for (std::size_t i = 0, k = n - 1; k >= m + 2; ++i, --k) {
    Four* low = at(k);
    const double near_up = m_near_up[k], far_up = m_far_up[k];
    const Four up_a = low[0] - far_up * before_up_a - near_up * last_up_a;
    const Four up_b = low[1] - far_up * before_up_b - near_up * last_up_b;
    before_up_a = last_up_a;
    before_up_b = last_up_b;
    low[0] = last_up_a = up_a;
    low[1] = last_up_b = up_b;
    if (i >= m) break;
    Four* own = at(i);
    const double near = m_near[i], far = m_far[i];
    const Four now_a = own[0] - far * before_a - near * last_a;
    const Four now_b = own[1] - far * before_b - near * last_b;
    before_a = last_a;
    before_b = last_b;
    own[0] = last_a = now_a;
    own[1] = last_b = now_b;
  }
  Four* middle_one = at(m);
  Four* middle_two = at(m + 1);
  Four one_a = middle_one[0] - m_far[m] * before_a - m_near[m] * last_a;
  Four one_b = middle_one[1] - m_far[m] * before_b - m_near[m] * last_b;
  Four two_a = middle_two[0] - m_far[m + 1] * last_a;
  Four two_b = middle_two[1] - m_far[m + 1] * last_b;
  one_a -= m_far_up[m] * last_up_a;
  one_b -= m_far_up[m] * last_up_b;
  two_a -= m_near_up[m + 1] * last_up_a + m_far_up[m + 1] * before_up_a;
  two_b -= m_near_up[m + 1] * last_up_b + m_far_up[m + 1] * before_up_b;
  const Four first_a = m_middle[0] * one_a + m_middle[1] * two_a, second_a = m_middle[1] * one_a + m_middle[2] * two_a;
  const Four first_b = m_middle[0] * one_b + m_middle[1] * two_b, second_b = m_middle[1] * one_b + m_middle[2] * two_b;
  middle_one[0] = last_a = before_up_a = first_a;
  middle_one[1] = last_b = before_up_b = first_b;
  middle_two[0] = before_a = last_up_a = second_a;
  middle_two[1] = before_b = last_up_b = second_b;
  for (std::size_t i = m, k = m + 2; k < n; ++k) {
    Four* low = at(k);
    const double inverse_up = m_inverse[k], near_up = m_near_up[k - 1], far_up = m_far_up[k - 2];
    const Four up_a = low[0] * inverse_up - far_up * before_up_a - near_up * last_up_a;
    const Four up_b = low[1] * inverse_up - far_up * before_up_b - near_up * last_up_b;
    before_up_a = last_up_a;
    before_up_b = last_up_b;
    low[0] = last_up_a = up_a;
    low[1] = last_up_b = up_b;
    if (i == 0) continue;
    Four* own = at(--i);
    const double inverse = m_inverse[i], near = m_near[i + 1], far = m_far[i + 2];
    const Four now_a = own[0] * inverse - far * before_a - near * last_a;
    const Four now_b = own[1] * inverse - far * before_b - near * last_b;
    before_a = last_a;
    before_b = last_b;
    own[0] = last_a = now_a;
    own[1] = last_b = now_b;
  }
}

ZERODRIFT_WIDE void Skyline::solve_lanes(double* x) const {
  if (m_chain) return size() == 0 ? void() : solve_lanes_of_chain(x);
  if (m_band) return solve_lanes_of_band(x);
  const std::size_t n = size();
  const int* order = m_order.empty() ? nullptr : m_order.data();
  for (std::size_t i = 0; i < n; ++i) {
    Four* own = reinterpret_cast<Four*>(x + (order == nullptr ? i : static_cast<std::size_t>(order[i])) * lanes);
    Four a = own[0], b = own[1];
    for (std::size_t e = m_start[i]; e < m_start[i + 1]; ++e) {
      const Four* other = reinterpret_cast<const Four*>(x + m_place[e] * lanes);
      a -= m_below[e] * other[0];
      b -= m_below[e] * other[1];
    }
    own[0] = a;
    own[1] = b;
  }
  for (std::size_t i = n; i-- > 0;) {
    Four* own = reinterpret_cast<Four*>(x + (order == nullptr ? i : static_cast<std::size_t>(order[i])) * lanes);
    Four a = own[0] * m_inverse[i], b = own[1] * m_inverse[i];
    for (std::size_t u = m_up[i]; u < m_up[i + 1]; ++u) {
      const Four* other = reinterpret_cast<const Four*>(x + m_up_place[u] * lanes);
      const double factor = m_below[m_up_entry[u]];
      a -= factor * other[0];
      b -= factor * other[1];
    }
    own[0] = a;
    own[1] = b;
  }
}

}  // namespace zerodrift::physics

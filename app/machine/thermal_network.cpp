#include "app/machine/thermal_network.h"

#include <algorithm>
#include <utility>

namespace zerodrift::machine {

int ThermalNetwork::add_node(double capacity_J_K) {
  m_capacity.push_back(capacity_J_K);
  m_heat.push_back(0.0);
  return nodes() - 1;
}

int ThermalNetwork::add_link(int node_a, int node_b, double conductance_W_K) {
  const auto [low, high] = std::minmax(node_a, node_b);
  m_links.push_back({low, high, conductance_W_K});
  return static_cast<int>(m_links.size()) - 1;
}

int ThermalNetwork::add_boundary(double temperature_C) {
  m_boundaries.push_back(temperature_C);
  return static_cast<int>(m_boundaries.size()) - 1;
}

int ThermalNetwork::add_boundary_link(int node, int boundary, double conductance_W_K) {
  m_boundary_links.push_back({node, boundary, conductance_W_K});
  return static_cast<int>(m_boundary_links.size()) - 1;
}

void ThermalNetwork::start(double temperature_C) {
  m_temperature = Eigen::VectorXd::Constant(nodes(), temperature_C);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < nodes(); ++i) entries.emplace_back(i, i, 1.0);
  for (const Link& link : m_links) entries.emplace_back(link.b, link.a, 1.0);
  m_matrix.resize(nodes(), nodes());
  m_matrix.setFromTriplets(entries.begin(), entries.end());
  m_matrix.makeCompressed();
  for (int i = 0; i < nodes(); ++i) m_diagonal.push_back(&m_matrix.coeffRef(i, i));
  for (const Link& link : m_links) m_off_diagonal.push_back(&m_matrix.coeffRef(link.b, link.a));
  m_solver.analyzePattern(m_matrix);
  m_right_side.resize(nodes());
}

void ThermalNetwork::fill(double duration_s) {
  std::fill(m_matrix.valuePtr(), m_matrix.valuePtr() + m_matrix.nonZeros(), 0.0);
  for (int i = 0; i < nodes(); ++i) {
    const double inertia = m_capacity[i] / duration_s;
    *m_diagonal[i] = inertia;
    m_right_side[i] = inertia * m_temperature[i] + m_heat[i];
  }
  for (std::size_t k = 0; k < m_links.size(); ++k) {
    const Link& link = m_links[k];
    *m_diagonal[link.a] += link.conductance;
    *m_diagonal[link.b] += link.conductance;
    *m_off_diagonal[k] -= link.conductance;
  }
  for (const Link& link : m_boundary_links) {
    *m_diagonal[link.a] += link.conductance;
    m_right_side[link.a] += link.conductance * m_boundaries[link.b];
  }
}

void ThermalNetwork::step(double duration_s) {
  fill(duration_s);
  m_solver.factorize(m_matrix);
  m_temperature = m_solver.solve(m_right_side);
  double input_W = 0.0;
  for (const double heat : m_heat) input_W += heat;
  for (const Link& link : m_boundary_links) {
    input_W += link.conductance * (m_boundaries[link.b] - m_temperature[link.a]);
  }
  m_last_input_J = input_W * duration_s;
  std::fill(m_heat.begin(), m_heat.end(), 0.0);
}

double ThermalNetwork::energy_J() const {
  double energy = 0.0;
  for (int i = 0; i < nodes(); ++i) energy += m_capacity[i] * m_temperature[i];
  return energy;
}

}  // namespace zerodrift::machine

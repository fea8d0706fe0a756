#pragma once
// Heat in a network of lumps: C_i dT_i/dt = sum_j G_ij (T_j - T_i) + sum_b G_ib (T_b - T_i) + Q_i, in J/K, W/K, W, C.
// Implicit Euler: stable for any step, and each step's balance of energy is exact: heat in - heat out = heat stored.
// Conductances may change from step to step (films grow with speed, contacts open); the pattern of links may not.

#include <Eigen/Sparse>
#include <vector>

namespace zerodrift::machine {

class ThermalNetwork {
 public:
  int add_node(double capacity_J_K);
  int add_link(int node_a, int node_b, double conductance_W_K);
  /// A prescribed temperature: the room, a fluid.
  int add_boundary(double temperature_C);
  int add_boundary_link(int node, int boundary, double conductance_W_K);
  /// After the last node and link.
  void start(double temperature_C);

  void set_link(int link, double conductance_W_K) { m_links[link].conductance = conductance_W_K; }
  void set_boundary_link(int link, double conductance_W_K) { m_boundary_links[link].conductance = conductance_W_K; }
  void set_boundary(int boundary, double temperature_C) { m_boundaries[boundary] = temperature_C; }
  void add_heat(int node, double heat_W) { m_heat[node] += heat_W; }
  /// Heat added since the last step acts over the whole step, then is forgotten.
  void step(double duration_s);

  int nodes() const { return static_cast<int>(m_capacity.size()); }
  double temperature_C(int node) const { return m_temperature[node]; }
  /// Stored heat against 0 C.
  double energy_J() const;
  /// Heat that flowed in through heats and boundary links in the last step.
  double last_input_J() const { return m_last_input_J; }

 private:
  struct Link {
    int a;
    int b;
    double conductance;
  };
  void fill(double duration_s);

  std::vector<double> m_capacity;
  std::vector<Link> m_links;
  std::vector<Link> m_boundary_links;  // b is the boundary
  std::vector<double> m_boundaries;
  std::vector<double> m_heat;
  Eigen::VectorXd m_temperature;
  Eigen::SparseMatrix<double> m_matrix;  // lower triangle
  std::vector<double*> m_diagonal;       // into m_matrix
  std::vector<double*> m_off_diagonal;   // of each link
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> m_solver;
  Eigen::VectorXd m_right_side;
  double m_last_input_J = 0.0;
};

}  // namespace zerodrift::machine

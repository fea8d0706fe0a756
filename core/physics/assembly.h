#pragma once
// The network's equations at one moment: every term's strength from the inputs, the surroundings and the state, put
// together into heat sources, films, links and the factored matrix of a step.

#include <array>
#include <utility>
#include <vector>

#include "core/physics/inputs.h"
#include "core/physics/network.h"
#include "core/physics/skyline.h"

namespace zerodrift::physics {

struct TermNow {
  Strength strength;
  double by_hold = 0.0;
  std::vector<double> weights;
  std::vector<double> by_place;
  std::array<double, max_law_parameters> values{};
  std::array<int, max_law_parameters> columns{};  // -1: not differentiated by
  int place_column = -1;
};

struct FlatLink {
  int first;
  int second;
  double conductance;
};

/// Node temperatures of the last two steps; laws see them extrapolated by this share of their difference.
struct StateView {
  const double* now_C = nullptr;
  const double* before_C = nullptr;
  double extrapolate = 0.0;
};

class Assembly {
 public:
  /// `column`: of each parameter among the derivatives, -1 without. The network and the inputs outlive it.
  Assembly(const Network& network, const InputSet& inputs, const std::vector<double>& values,
           const std::vector<int>& column);

  /// Strengths and surroundings at `share` of the interval after `row`.
  void evaluate(std::size_t row, double share, double time_s, const StateView& state);
  /// Sources, films and links from them, and the matrix C + alpha (films + links), factored if anything changed.
  void assemble(double alpha);

  Skyline& matrix() { return m_matrix; }
  const Skyline& matrix() const { return m_matrix; }
  const TermNow& now(std::size_t term) const { return m_now[term]; }
  const std::vector<double>& film() const { return m_film; }
  const std::vector<double>& source() const { return m_source; }
  const std::vector<double>& capacity() const { return m_capacity; }
  double environment_C(int index) const { return m_environment[index]; }
  /// (column, derivative) of a surrounding.
  const std::vector<std::pair<int, double>>& environment_by(int index) const { return m_environment_by[index]; }

 private:
  Skyline empty_matrix();
  void prepare_terms(const std::vector<double>& values, const std::vector<int>& column);
  void evaluate_environments(std::size_t row, double share);
  void evaluate_term(std::size_t index, std::size_t row, bool changed, double time_s, const StateView& state);
  void build_matrix(double alpha);

  const Network& m_net;
  const InputSet& m_in;
  const std::vector<double>& m_values;
  const std::vector<int>& m_column;
  std::size_t m_n;
  double m_hold = 0.0;
  std::vector<int> m_rank;  // node -> row of the matrix
  Skyline m_matrix;
  std::vector<TermNow> m_now;
  std::vector<double> m_environment;
  std::vector<std::vector<std::pair<int, double>>> m_environment_by;
  std::vector<FlatLink> m_links;
  std::vector<double> m_film, m_source, m_capacity;
  double m_last_alpha = 0.0;
  bool m_stiffness_changed = true;
  std::size_t m_row_evaluated = static_cast<std::size_t>(-1);
};

}  // namespace zerodrift::physics

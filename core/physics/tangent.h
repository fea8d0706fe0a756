#pragma once
// Derivatives of a stepped network by its parameters: the same discrete scheme, differentiated (tangent-linear model).
// Columns go in blocks of eight through one factored matrix, so that a block stays in the nearest cache for a whole
// step. What a parameter forces is its law's derivative times what the term does at strength one, which all columns
// share.

#include <cstddef>
#include <vector>

#include "core/physics/assembly.h"

namespace zerodrift::physics {

/// TR-BDF2 (Bank et al. 1985): with A = C + alpha K, alpha = gamma dt / 2, both stages share A:
///   A T* = (C - alpha K) T + 2 alpha q, hence T* = A^-1 (2 C T + 2 alpha q) - T
///   A T' = C (c_star T* - c_old T) + alpha q
namespace tr_bdf2 {
inline constexpr double gamma = 0.58578643762690495;  // 2 - sqrt(2)
inline constexpr double c_star = 1.0 / (gamma * (2.0 - gamma));
inline constexpr double c_old = (1.0 - gamma) * (1.0 - gamma) / (gamma * (2.0 - gamma));
}  // namespace tr_bdf2

/// The step whose derivatives are wanted: node temperatures before it, at its first stage and after it.
struct StepTaken {
  const double* before_C = nullptr;
  const double* star_C = nullptr;
  const double* after_C = nullptr;
  double alpha = 0.0;
  double extrapolate = 0.0;  // of laws that follow temperatures (StateView)
};

class Tangent {
 public:
  /// `column`: of each parameter, -1 without; `columns` of them. The network and the assembly outlive it.
  Tangent(const Network& network, const Assembly& assembly, const std::vector<int>& column, std::size_t columns);

  void advance(const StepTaken& step);
  /// by[column] = derivative of a linear functional of the temperatures.
  void observe(const Probe& probe, double* by) const;

 private:
  static constexpr std::size_t lanes = Skyline::lanes;

  /// What a term does to its nodes at strength one, in the first and in the second stage of a step.
  struct Unit {
    bool used = false;
    std::vector<int> nodes;
    std::vector<std::pair<int, int>> links;  // indices into nodes
    std::vector<double> first, second;
  };
  enum class Slot { parameter, hold, place };
  struct Push {
    std::size_t term;
    Slot slot;
    std::size_t parameter;  // of the law
    std::size_t lane;
  };
  struct Stored {
    std::size_t node;
    std::size_t lane;
  };
  struct Block {
    std::vector<Push> pushes;
    std::vector<Stored> capacities;
  };

  void prepare_unit(std::size_t term);
  void prepare_pushes(std::size_t term, const std::vector<int>& column);
  void evaluate_unit(std::size_t term, const StepTaken& step);
  void advance_block(std::size_t block, const StepTaken& step);
  void force(std::size_t block, const StepTaken& step, bool first_stage);
  void force_by_driver(std::size_t block, std::size_t term, const StepTaken& step, bool first_stage);
  void force_by_surroundings(std::size_t block, std::size_t term, const StepTaken& step, bool first_stage);
  double* of_block(std::vector<double>& all, std::size_t block) const { return all.data() + block * m_n * lanes; }
  const double* of_block(const std::vector<double>& all, std::size_t block) const {
    return all.data() + block * m_n * lanes;
  }

  const Network& m_net;
  const Assembly& m_assembly;
  std::size_t m_n;
  std::size_t m_columns;
  std::vector<Unit> m_units;
  std::vector<Block> m_blocks;
  std::vector<std::size_t> m_driven;      // terms that follow temperatures
  std::vector<std::size_t> m_surrounded;  // terms towards a surrounding that is differentiated
  // Derivatives now, a step before and in the making: [(block * nodes + node) * lanes + lane]
  std::vector<double> m_s, m_before, m_r;
};

}  // namespace zerodrift::physics

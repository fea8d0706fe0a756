#include "core/physics/heat.h"

#include "core/physics/assembly.h"

namespace zerodrift::physics {

std::vector<double> heat_from_outside_W(const Network& network, const InputSet& inputs,
                                        const std::vector<double>& values, const std::vector<double>& field_C) {
  const std::vector<int> no_columns(network.parameters.size(), -1);
  Assembly assembly(network, inputs, values, no_columns);
  const std::size_t nodes = network.nodes();
  std::vector<double> heat_W(inputs.rows() > 0 ? inputs.rows() - 1 : 0, 0.0);
  for (std::size_t row = 0; row < heat_W.size(); ++row) {
    const double* from_C = field_C.data() + row * nodes;
    const double* to_C = from_C + nodes;
    const double middle_s = 0.5 * (inputs.time_s[row] + inputs.time_s[row + 1]);
    assembly.evaluate(row, 0.5, middle_s, {to_C, from_C, -0.5});
    for (std::size_t i = 0; i < network.terms.size(); ++i) {
      const Term& term = network.terms[i];
      const TermNow& now = assembly.now(i);
      if (term.kind == TermKind::link) continue;
      for (std::size_t w = 0; w < now.weights.size(); ++w) {
        double driving = 1.0;  // a source's heat stands by itself, a film's is for 1 K
        if (term.kind == TermKind::film) {
          const std::size_t node = static_cast<std::size_t>(term.first_node) + w;
          driving = assembly.environment_C(term.environment) - 0.5 * (from_C[node] + to_C[node]);
        }
        heat_W[row] += now.strength.value * now.weights[w] * driving;
      }
    }
  }
  return heat_W;
}

}  // namespace zerodrift::physics

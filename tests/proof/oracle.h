#pragma once
// What an analysis that is told the hidden effects would find: was the case decidable at all? The difference between
// "not found" and "cannot be found" is told by the evidence each hidden effect has beside the others.

#include <map>
#include <string>

#include "core/physics/machine.h"
#include "tests/proof/case_generator.h"

namespace zerodrift::proof {

struct OracleAnswer {
  double evidence = 0.0;                 // log evidence of the true structure over none
  std::map<std::string, double> beside;  // of each hidden effect beside the others
};

OracleAnswer told_the_truth(const physics::Machine& machine, const Case& one);

}  // namespace zerodrift::proof

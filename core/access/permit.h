#pragma once
// The right to write to a machine, taken when an operation begins and held until it ends: a lock that falls in the
// middle never leaves a write half done. A machine that was opened without one can only be read.

#include <string>

#include "core/base/result.h"

namespace zerodrift::access {

class Permit {
 public:
  static Permit read_only() { return Permit(false); }
  bool may_write() const { return m_may_write; }
  /// access_locked naming the operation when this permit only reads.
  Status check(const std::string& operation) const;

 private:
  friend class Access;  // nobody else gives the right away
  explicit Permit(bool may_write) : m_may_write(may_write) {}

  bool m_may_write;
};

}  // namespace zerodrift::access

#include "core/access/permit.h"

namespace zerodrift::access {

Status Permit::check(const std::string& operation) const {
  if (!m_may_write) return fail(ErrorCode::access_locked, {{"operation", operation}});
  return {};
}

}  // namespace zerodrift::access

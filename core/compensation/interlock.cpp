#include "core/compensation/interlock.h"

namespace zerodrift::compensation {

Status allow_model_measurement(bool compensation_on) {
  if (compensation_on) return fail(ErrorCode::interlock_compensation_on, {{"operation", "measuring model data"}});
  return {};
}

Status allow_staging(bool compensation_on) {
  if (compensation_on) return fail(ErrorCode::interlock_compensation_on, {{"operation", "staging a table"}});
  return {};
}

Status allow_offset_write(bool compensation_on) {
  if (!compensation_on) return fail(ErrorCode::interlock_compensation_off, {{"operation", "writing an offset"}});
  return {};
}

}  // namespace zerodrift::compensation

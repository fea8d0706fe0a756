#pragma once
// Which faults of a machine's link may pass by themselves. The one place that decides what is tried again: by the link
// within a request, and around it by the recorder, the host compensator and the upload.

#include "core/base/error.h"

namespace zerodrift::acquisition {

/// The same request may succeed a little later: the link was broken, late or spoilt, the device busy (Modbus exceptions
/// 5 and 6) or failed at it (4), or a gateway did not reach it (10 and 11). Any other refusal is the device's answer.
/// After such a fault a write may have been carried out all the same.
inline bool may_pass(const Error& error) {
  switch (error.code) {
    case ErrorCode::machine_unreachable:
    case ErrorCode::machine_silent:
    case ErrorCode::machine_link_lost:
    case ErrorCode::machine_bad_reply:
    case ErrorCode::machine_busy:
    case ErrorCode::machine_gateway:
    case ErrorCode::machine_failed:
      return true;
    default:
      return false;
  }
}

}  // namespace zerodrift::acquisition

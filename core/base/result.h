#pragma once
// Result<T>: a value or an Error. Status: done, or an Error.
// ZD_TRY(name, expression) takes the value out or returns the error to the caller; ZD_CHECK(expression) does so for a
// Status.

#include <map>
#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "core/base/error.h"

namespace zerodrift {

template <class T>
using Result = tl::expected<T, Error>;
using Status = Result<void>;

/// return fail(ErrorCode::file_not_found, {{"file", path}});
inline tl::unexpected<Error> fail(ErrorCode code, std::map<std::string, std::string> context = {}) {
  return tl::unexpected<Error>(Error{code, std::move(context)});
}
inline tl::unexpected<Error> fail(Error error) {
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace zerodrift

#define ZD_CONCAT_INNER(a, b) a##b
#define ZD_CONCAT(a, b) ZD_CONCAT_INNER(a, b)
#define ZD_TRY(declaration, expression) ZD_TRY_INNER(ZD_CONCAT(zd_try_, __LINE__), declaration, expression)
#define ZD_TRY_INNER(temporary, declaration, expression)                  \
  auto temporary = (expression);                                          \
  if (!temporary) return ::zerodrift::fail(std::move(temporary).error()); \
  declaration = std::move(*temporary)
#define ZD_CHECK(expression)                                                                               \
  do {                                                                                                     \
    if (auto zd_status = (expression); !zd_status) return ::zerodrift::fail(std::move(zd_status).error()); \
  } while (false)

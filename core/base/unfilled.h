#pragma once
// Long rows of numbers that are all written before any is read: a vector of them grows without being filled with zeros
// first, which would bring every page of it into the cache once for nothing.

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace zerodrift {

template <typename T>
struct Unfilled : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = Unfilled<U>;
  };
  template <typename U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
};

/// resize() leaves new numbers as they are in memory; assign() fills.
using UnfilledNumbers = std::vector<double, Unfilled<double>>;

}  // namespace zerodrift

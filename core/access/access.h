#pragma once
// Who may write to a machine from this computer. An operator reads; an engineer writes. Without a PIN everybody is the
// engineer. With one the engineer unlocks with it, and after a while without a touch it is locked again.
//
// The PIN is this computer's, never a job's: a job that comes from elsewhere brings no rights. /etc/zerodrift holds for
// all users and can be changed by the administrator alone; without it each user has a file of his own.
// A file that is there but cannot be read locks: it never opens.
//
// Safe to use from several threads. The time is counted also while the computer sleeps.

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "core/access/permit.h"
#include "core/access/pin.h"

namespace zerodrift::access {

enum class Role {
  operator_,  // reads
  engineer,   // writes
};
/// "operator", "engineer"
std::string_view name_of(Role role);

inline constexpr double default_idle_lock_s = 600.0;

/// Where the PIN of this computer is kept: the administrator's file if there is one, else the user's.
std::filesystem::path access_file();

class Access {
 public:
  using Now = std::function<double()>;  // seconds since an arbitrary start

  /// No PIN: everybody is the engineer.
  Access() = default;
  /// What the file says; no such file: no PIN.
  explicit Access(std::filesystem::path file, Now now = {});
  Access(const Access&) = delete;
  Access& operator=(const Access&) = delete;

  bool has_pin() const;
  Role role() const;
  double idle_lock_s() const;

  /// access_wrong_pin; after some of them access_wait with the seconds until the next try counts.
  Status unlock(std::string_view pin);
  void lock();
  /// The person is there: the idle time begins anew.
  void touch();
  /// Locks when nothing was touched for the idle time; true when it did so now.
  bool lock_when_idle();

  /// The right to write, for one operation that begins now; access_locked while locked.
  Result<Permit> permit(const std::string& operation) const;

  /// Sets or changes the PIN; `old_pin` must be right when there is one. The file is readable by its owner alone.
  Status set_pin(std::string_view old_pin, std::string_view new_pin);
  Status clear_pin(std::string_view old_pin);
  Status set_idle_lock(std::string_view pin, double seconds);

 private:
  Status check(std::string_view pin);
  Status write() const;
  bool locked() const { return (m_pin.has_value() || m_unreadable.has_value()) && !m_unlocked; }

  mutable std::mutex m_mutex;
  std::filesystem::path m_file;
  Now m_now;
  std::optional<PinHash> m_pin;
  std::optional<Error> m_unreadable;
  double m_idle_lock_s = default_idle_lock_s;
  bool m_unlocked = false;
  double m_touched_s = 0.0;
  int m_failures = 0;
  double m_wait_until_s = 0.0;
};

}  // namespace zerodrift::access

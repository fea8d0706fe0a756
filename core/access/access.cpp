#include "core/access/access.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/base/file.h"
#include "core/base/json.h"
#include "core/base/write_failure.h"

namespace zerodrift::access {
namespace {

namespace fs = std::filesystem;

constexpr const char* format_name = "zerodrift-access/1";
constexpr int free_tries = 3;
constexpr double first_wait_s = 5.0;
constexpr double longest_wait_s = 300.0;
constexpr NumberRange idle_range{30.0, 86400.0, false, "30 to 86400 seconds"};

/// Unlike the steady clock it goes on while the computer sleeps: a lid that was closed is a person who is gone.
double seconds_with_sleep() {
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Kept {
  std::optional<PinHash> pin;
  double idle_lock_s = default_idle_lock_s;
};

Result<Kept> read_kept(const fs::path& file) {
  ZD_TRY(const nlohmann::json document, read_json_file(file));
  return from_json<Kept>(document, file.string(), nullptr, [](JsonObject& o) {
    Kept kept;
    o.word("format", {format_name});
    kept.idle_lock_s = o.number_or("idle_lock_s", default_idle_lock_s, idle_range);
    if (JsonObject* pin = o.object_if("pin"); pin != nullptr) kept.pin = read_pin(*pin);
    return kept;
  });
}

}  // namespace

std::string_view name_of(Role role) {
  return role == Role::engineer ? "engineer" : "operator";
}

fs::path access_file() {
  std::error_code ignored;
  fs::path everybody = "/etc/zerodrift/access.json";
  if (fs::exists(everybody, ignored)) return everybody;
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config != '\0') return fs::path(config) / "zerodrift" / "access.json";
  const char* home = std::getenv("HOME");
  return fs::path(home != nullptr && *home != '\0' ? home : "/") / ".config" / "zerodrift" / "access.json";
}

Access::Access(fs::path file, Now now) : m_file(std::move(file)), m_now(std::move(now)) {
  if (!m_now) m_now = seconds_with_sleep;
  std::error_code error;
  const auto status = fs::symlink_status(m_file, error);
  if (status.type() == fs::file_type::not_found) return;
  auto kept = read_kept(m_file);
  if (!kept) {
    m_unreadable = kept.error();
    return;
  }
  m_pin = std::move(kept->pin);
  m_idle_lock_s = kept->idle_lock_s;
}

bool Access::has_pin() const {
  const std::scoped_lock lock(m_mutex);
  return m_pin.has_value() || m_unreadable.has_value();
}

Role Access::role() const {
  const std::scoped_lock lock(m_mutex);
  return locked() ? Role::operator_ : Role::engineer;
}

double Access::idle_lock_s() const {
  const std::scoped_lock lock(m_mutex);
  return m_idle_lock_s;
}

Status Access::check(std::string_view pin) {
  if (m_unreadable) return fail(*m_unreadable);
  if (!m_pin) return {};
  const double now_s = m_now();
  if (now_s < m_wait_until_s) {
    return fail(ErrorCode::access_wait, {{"seconds", fmt::format("{:.0f}", std::ceil(m_wait_until_s - now_s))}});
  }
  ZD_TRY(const bool right, matches(*m_pin, pin));
  if (right) {
    m_failures = 0;
    return {};
  }
  ++m_failures;
  if (m_failures >= free_tries) {
    m_wait_until_s = now_s + std::min(longest_wait_s, first_wait_s * std::exp2(m_failures - free_tries));
  }
  return fail(ErrorCode::access_wrong_pin);
}

Status Access::unlock(std::string_view pin) {
  const std::scoped_lock lock(m_mutex);
  ZD_CHECK(check(pin));
  m_unlocked = true;
  if (m_now) m_touched_s = m_now();
  return {};
}

void Access::lock() {
  const std::scoped_lock lock(m_mutex);
  m_unlocked = false;
}

void Access::touch() {
  const std::scoped_lock lock(m_mutex);
  if (m_unlocked && m_now) m_touched_s = m_now();
}

bool Access::lock_when_idle() {
  const std::scoped_lock lock(m_mutex);
  if (!m_unlocked || !m_now || m_now() - m_touched_s < m_idle_lock_s) return false;
  m_unlocked = false;
  return m_pin.has_value();
}

Result<Permit> Access::permit(const std::string& operation) const {
  const std::scoped_lock lock(m_mutex);
  const Permit permit(!locked());
  if (!permit.may_write() && m_unreadable) return fail(*m_unreadable);
  ZD_CHECK(permit.check(operation));
  return permit;
}

Status Access::write() const {
  std::error_code error;
  fs::create_directories(m_file.parent_path(), error);
  // An administrator may have let a group read it; a new one is its owner's alone.
  const auto before = fs::status(m_file, error);
  const auto mode = fs::exists(before) ? before.permissions() : fs::perms::owner_read | fs::perms::owner_write;
  nlohmann::json document = {{"format", format_name}, {"idle_lock_s", m_idle_lock_s}};
  if (m_pin) document["pin"] = to_json(*m_pin);
  ZD_CHECK(write_file(m_file, json_text(document, 2) + "\n"));
  fs::permissions(m_file, mode, error);
  if (error) return fail(write_failure(m_file, error.value()));
  return {};
}

Status Access::set_pin(std::string_view old_pin, std::string_view new_pin) {
  const std::scoped_lock lock(m_mutex);
  ZD_CHECK(check(old_pin));
  ZD_TRY(PinHash made, hash_pin(new_pin));
  const auto before = std::exchange(m_pin, std::move(made));
  if (Status written = write(); !written) {
    m_pin = before;
    return written;
  }
  m_unlocked = true;
  m_touched_s = m_now ? m_now() : 0.0;
  return {};
}

Status Access::clear_pin(std::string_view old_pin) {
  const std::scoped_lock lock(m_mutex);
  ZD_CHECK(check(old_pin));
  const auto before = std::exchange(m_pin, std::nullopt);
  if (Status written = write(); !written) {
    m_pin = before;
    return written;
  }
  return {};
}

Status Access::set_idle_lock(std::string_view pin, double seconds) {
  const std::scoped_lock lock(m_mutex);
  ZD_CHECK(check(pin));
  if (!(seconds >= idle_range.low && seconds <= idle_range.high)) {
    return fail(ErrorCode::bad_argument, {{"what", "the idle time"},
                                          {"found", fmt::format("{:g}", seconds)},
                                          {"expected", std::string(idle_range.words)}});
  }
  const double before = std::exchange(m_idle_lock_s, seconds);
  Status written = write();
  if (!written) m_idle_lock_s = before;
  return written;
}

}  // namespace zerodrift::access

#pragma once
// The tables of a job file and how older files are brought up to date: one function a version, each in a transaction of
// its own, after a copy of the file was put beside it.

#include <functional>
#include <span>

#include "core/commissioning/database.h"

namespace zerodrift::commissioning {

inline constexpr std::int64_t application_id = 0x5A444A31;  // "ZDJ1"

/// migrations[n] brings a file of version n to version n + 1.
using Migration = std::function<Status(Database&)>;
std::span<const Migration> migrations();

/// job_not_a_job for a foreign or empty file, job_newer for one of a later program; else its version.
Result<std::int64_t> known_version(Database& database, std::span<const Migration> steps);
/// Brings the file from its version to the last one. Before anything is changed in a file that holds a job already, it
/// is copied to "<file>.v<version>.bak"; a failure leaves the file as it was.
Status migrate(Database& database, std::span<const Migration> steps);

/// A job may come from elsewhere, and a trigger or a view is somebody's program in it: job_damaged for any that is not
/// exactly ours. Only reads.
Status check_schema(Database& database);
/// Puts back what keeps the audit trail and the artefacts as they are, where it was taken away.
Status restore_guards(Database& database);

}  // namespace zerodrift::commissioning

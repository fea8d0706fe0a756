#pragma once
// Whole files in and out. Reading has a size limit; writing is atomic: a temporary file beside the target, flushed to
// the disk, then renamed, so that a reader sees the old file or the new one and nothing in between.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace zerodrift {

inline constexpr std::size_t default_file_limit_bytes = std::size_t{2} << 30;

Result<std::string> read_file(const std::filesystem::path& path, std::size_t limit_bytes = default_file_limit_bytes);
/// For a program that is told to end: whatever waits for a pipe or a terminal to give bytes, now or later, fails as
/// cancelled. In all threads, for good.
void end_waiting_reads();
Status write_file(const std::filesystem::path& path, std::string_view bytes);
/// Adds whole lines at the end, flushed to the disk; makes the file. Several programs may add to one file. A line that
/// a power cut tore off is ended first, so that it does not spoil the next one.
Status append_file(const std::filesystem::path& path, std::string_view lines);

}  // namespace zerodrift

#pragma once
// What a file is that was dropped onto the window or named on the command line: by its ending, and where that says too
// little by its first lines.

#include <QString>

namespace zerodrift::desktop {

enum class FileKind {
  job,        // .zdj
  profile,    // JSON: connection profile
  plan,       // JSON: warm-up plan
  machine,    // JSON: description of a machine
  laser,      // .rtl, .REN, .pos, or a table that is no recording
  recording,  // a table with a time, of any logger
  unknown,
};

FileKind kind_of_file(const QString& path);

}  // namespace zerodrift::desktop

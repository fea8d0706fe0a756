#pragma once
// Errors in words: one sentence that says what happened and where, one that says what to do. Translatable.

#include <QString>

#include "core/base/error.h"

namespace zerodrift {

struct ErrorText {
  QString sentence;  // what happened, where
  QString remedy;    // what to do
};

/// Whose hands the remedy speaks to: a header map is a file and an option there, a table in a dialog here.
enum class Reader { command_line, window };

ErrorText textOf(const Error& error, Reader reader = Reader::command_line);
/// Both in one line, for the command line and the log.
QString lineOf(const Error& error, Reader reader = Reader::command_line);
/// A step or the artefact it makes, in words: "warmup" is "warm-up".
QString stepName(const std::string& id);

}  // namespace zerodrift

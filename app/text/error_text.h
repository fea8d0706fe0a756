#pragma once
// Errors in words: one sentence that says what happened and where, one that says what to do. Translatable.

#include <QString>

#include "core/base/error.h"

namespace zerodrift {

struct ErrorText {
  QString sentence;  // what happened, where
  QString remedy;    // what to do
};

ErrorText textOf(const Error& error);
/// Both in one line, for the command line and the log.
QString lineOf(const Error& error);
/// A step or the artefact it makes, in words: "warmup" is "warm-up".
QString stepName(const std::string& id);

}  // namespace zerodrift

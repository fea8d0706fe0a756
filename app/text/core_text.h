#pragma once
// What core says in English (reasons, warnings, names), in the user's language. Core has no Qt: the English pattern is
// the code of such a text and what stands in its gaps are its figures. Files and jobs keep the English.

#include <QString>
#include <string>
#include <vector>

namespace zerodrift {

/// The text in the user's language. Parts joined by "; " are looked up one by one; a text that is none of core's
/// phrases (a file's name, a person's remark) comes back as it is.
QString coreText(const std::string& english);
QString coreText(const QString& english);

/// Every phrase of core that people can meet, for tests; gaps are %1, %2, ...
std::vector<const char*> corePhrases();

}  // namespace zerodrift

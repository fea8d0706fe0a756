// Phrases of base, access, commissioning and recording.

#include <QCoreApplication>
#include <array>

#include "app/text/core_phrases.h"

namespace zerodrift {
namespace {

constexpr std::array<const char*, 81> files = {{
    QT_TRANSLATE_NOOP("core", "a number alone, and its unit in the heading or in a row of units"),
    QT_TRANSLATE_NOOP("core", "there is no folder %1"),
    QT_TRANSLATE_NOOP("core", "%1 is no folder"),
    QT_TRANSLATE_NOOP("core", "nothing may be written into the folder %1"),
    QT_TRANSLATE_NOOP("core", "a factor (%1) in the heading"),
    QT_TRANSLATE_NOOP("core", "a heading without one, or \"scale\" in a column map"),
    QT_TRANSLATE_NOOP("core", "kelvin, by their size (%1 at the start)"),
    QT_TRANSLATE_NOOP("core", "degrees Fahrenheit, by their size (%1 at the start)"),
    QT_TRANSLATE_NOOP("core", "the PIN could not be hashed"),
    QT_TRANSLATE_NOOP("core", "%1 hexadecimal digits"),
    QT_TRANSLATE_NOOP("core", "no random numbers"),
    QT_TRANSLATE_NOOP("core", "a power of two"),
    QT_TRANSLATE_NOOP("core", "the idle time"),
    QT_TRANSLATE_NOOP("core", "brackets within brackets, more than %1"),
    QT_TRANSLATE_NOOP("core", "\"%1\" in it was not made by this program"),
    QT_TRANSLATE_NOOP("core", "is a folder"),
    QT_TRANSLATE_NOOP("core", "more than %1"),
    QT_TRANSLATE_NOOP("core", "SHA-256 is not available"),
    QT_TRANSLATE_NOOP("core", "syntax error %1"),
    QT_TRANSLATE_NOOP("core", "an object"),
    QT_TRANSLATE_NOOP("core", "a whole number from %1"),
    QT_TRANSLATE_NOOP("core", "%1 to %2"),
    QT_TRANSLATE_NOOP("core", "true or false"),
    QT_TRANSLATE_NOOP("core", "a list of numbers"),
    QT_TRANSLATE_NOOP("core", "a list of %1"),
    QT_TRANSLATE_NOOP("core", "a list of texts"),
    QT_TRANSLATE_NOOP("core", "a list of objects"),
    QT_TRANSLATE_NOOP("core", "time stamp"),
    QT_TRANSLATE_NOOP("core", "one that is in the job"),
    QT_TRANSLATE_NOOP("core", "file of an artefact"),
    QT_TRANSLATE_NOOP("core", "one that belongs to artefact %1"),
    QT_TRANSLATE_NOOP("core", "%1 of artefact %2"),
    QT_TRANSLATE_NOOP("core", "audit trail, entry %1: %2"),
    QT_TRANSLATE_NOOP("core", "series %1, rows %2 to %3: checksum"),
    QT_TRANSLATE_NOOP("core", "series %1, row %2: checksum"),
    QT_TRANSLATE_NOOP("core", "artefact %1, %2: checksum"),
    QT_TRANSLATE_NOOP("core", "artefact %1 (%2): checksum"),
    QT_TRANSLATE_NOOP("core", "the file is there already"),
    QT_TRANSLATE_NOOP("core", "its older format needs updating"),
    QT_TRANSLATE_NOOP("core", "permission denied"),
    QT_TRANSLATE_NOOP("core", "opened for reading"),
    QT_TRANSLATE_NOOP("core", "one that is not closed"),
    QT_TRANSLATE_NOOP("core", "values of a row"),
    QT_TRANSLATE_NOOP("core", "time of a row"),
    QT_TRANSLATE_NOOP("core", "%1 s"),
    QT_TRANSLATE_NOOP("core", "after %1 s"),
    QT_TRANSLATE_NOOP("core", "channels of series %1"),
    QT_TRANSLATE_NOOP("core", "samples are stored in little endian"),
    QT_TRANSLATE_NOOP("core", "deflate failed on a buffer of its own bound"),
    QT_TRANSLATE_NOOP("core", "language of core's texts"),
    QT_TRANSLATE_NOOP("core", "it is read-only"),
    QT_TRANSLATE_NOOP("core", "it may not be read"),
    QT_TRANSLATE_NOOP("core", "it cannot be opened"),
    QT_TRANSLATE_NOOP("core", "the disk gives an error"),
    QT_TRANSLATE_NOOP("core", "entries of the job contradict one another"),
    QT_TRANSLATE_NOOP("core", "its pages do not hold together"),
    QT_TRANSLATE_NOOP("core", "a part of it is missing"),
    QT_TRANSLATE_NOOP("core", "a channel's name, for example T1_C"),
    QT_TRANSLATE_NOOP("core", "a number other than 0"),
    QT_TRANSLATE_NOOP("core", "a known unit (degC, degF, K, um, mm, inch, rpm, kW), or a scale beside it"),
    QT_TRANSLATE_NOOP("core", "more than two"),
    QT_TRANSLATE_NOOP("core", "one column, or date and time of day"),
    QT_TRANSLATE_NOOP("core", "s, ms, us, ns, min, h or d"),
    QT_TRANSLATE_NOOP("core", "one character, tab or blanks"),
    QT_TRANSLATE_NOOP("core", "a workbook (.xlsx) or a text table"),
    QT_TRANSLATE_NOOP("core", "an old Excel workbook (.xls)"),
    QT_TRANSLATE_NOOP("core", "a damaged archive"),
    QT_TRANSLATE_NOOP("core", "an archive without a workbook"),
    QT_TRANSLATE_NOOP("core", "damaged XML"),
    QT_TRANSLATE_NOOP("core", "%1, scale %2"),
    QT_TRANSLATE_NOOP("core", "X, Y or Z of a channel in um; A or B of one in urad"),
    QT_TRANSLATE_NOOP("core", "axis %1, as column %2"),
    QT_TRANSLATE_NOOP("core", "one column for each axis"),
    QT_TRANSLATE_NOOP("core", "sensors %1"),
    QT_TRANSLATE_NOOP("core", "sensors of the recording: %1"),
    QT_TRANSLATE_NOOP("core", "the kind of the job is %1"),
    QT_TRANSLATE_NOOP("core", "; "),
    QT_TRANSLATE_NOOP("core", "a channel of the warm-up run: %1"),
    QT_TRANSLATE_NOOP("core", "the role of a recording"),
    QT_TRANSLATE_NOOP("core", "training, other_day or cooling"),
    QT_TRANSLATE_NOOP("core", "the job's recordings"),
}};

}  // namespace

std::span<const char* const> phrases_of_files() {
  return files;
}

}  // namespace zerodrift

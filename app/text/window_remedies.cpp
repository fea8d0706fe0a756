#include "app/text/window_remedies.h"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <utility>

namespace zerodrift {
namespace {

constexpr std::array remedies = {
    std::pair{ErrorCode::csv_bad_header,
              QT_TRANSLATE_NOOP("errors", "Correct the header, or import the file and say in the table what it is.")},
    std::pair{ErrorCode::csv_bad_number,
              QT_TRANSLATE_NOOP("errors",
                                "Correct it; if the sample is missing, leave the cell empty or enter the word under "
                                "Missing in the import dialog.")},
    std::pair{ErrorCode::column_unclear,
              QT_TRANSLATE_NOOP("errors",
                                "Correct it in the file, or say what the column holds where the columns are asked.")},
    std::pair{ErrorCode::text_encoding, QT_TRANSLATE_NOOP("errors", "Save the file as UTF-8 and import it again.")},
    std::pair{ErrorCode::number_ambiguous,
              QT_TRANSLATE_NOOP("errors", "Choose the decimal sign in the import dialog.")},
    std::pair{
        ErrorCode::numbers_mixed,
        QT_TRANSLATE_NOOP("errors", "Write one of them otherwise, or choose the decimal sign in the import dialog.")},
    std::pair{ErrorCode::table_no_header,
              QT_TRANSLATE_NOOP("errors", "Say for each column in the table of the import dialog what it is.")},
    std::pair{ErrorCode::map_column_missing,
              QT_TRANSLATE_NOOP("errors", "Load another map, or say in the table what the columns are.")},
    std::pair{
        ErrorCode::unit_conflict,
        QT_TRANSLATE_NOOP("errors", "Correct what the column is, its unit or its scale, in its row of the table.")},
    std::pair{ErrorCode::time_missing,
              QT_TRANSLATE_NOOP("errors", "Choose \"time\" for the column that holds it, in its row of the table.")},
    std::pair{ErrorCode::time_unit_unknown,
              QT_TRANSLATE_NOOP("errors", "Choose the unit of the times in the row of that column.")},
    std::pair{
        ErrorCode::time_ambiguous,
        QT_TRANSLATE_NOOP("errors", "Enter the format in the row of that column, for example %d/%m/%Y %H:%M:%S.")},
    std::pair{ErrorCode::time_unreadable,
              QT_TRANSLATE_NOOP("errors",
                                "Correct the line, or enter the format in the row of that column, for example "
                                "%d.%m.%Y %H:%M:%S.")},
    std::pair{ErrorCode::time_epoch,
              QT_TRANSLATE_NOOP("errors", "If they are not, choose the unit in the row of that column.")},
    std::pair{ErrorCode::time_start_unknown,
              QT_TRANSLATE_NOOP("errors", "Enter the format in the row of that column to keep the date.")},
    std::pair{ErrorCode::column_proposed, QT_TRANSLATE_NOOP("errors", "Choose it in the row of that column if it is.")},
    std::pair{ErrorCode::column_converted,
              QT_TRANSLATE_NOOP("errors", "Choose another unit in the row of that column if that is wrong.")},
    std::pair{ErrorCode::sentinel_suspected,
              QT_TRANSLATE_NOOP("errors", "If so, enter it under Missing in the import dialog.")},
    std::pair{ErrorCode::channel_missing,
              QT_TRANSLATE_NOOP("errors", "Check the name, or import the file again with the channel's name.")},
};

}  // namespace

const char* window_remedy(ErrorCode code) {
  const auto at = std::find_if(remedies.begin(), remedies.end(), [&](const auto& one) { return one.first == code; });
  return at == remedies.end() ? nullptr : at->second;
}

}  // namespace zerodrift

#pragma once
// Moments as people here write them, in local time.

#include <QDateTime>
#include <QString>
#include <string>

namespace zerodrift::desktop {

/// "21 Nov 2026, 13:06"
QString momentText(const QDateTime& moment);
/// The same of a time in the job's records (ISO 8601, UTC); empty stays empty.
QString momentText(const std::string& utc);
/// "21 Nov 13:06", where there is little room.
QString shortMomentText(const std::string& utc);

}  // namespace zerodrift::desktop

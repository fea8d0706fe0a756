// What the C library says of files and connections; it comes as the detail of an error.

#include <QCoreApplication>
#include <array>

#include "app/text/core_phrases.h"

namespace zerodrift {
namespace {

constexpr std::array<const char*, 26> system_words = {{
    QT_TRANSLATE_NOOP("core", "Connection refused"),
    QT_TRANSLATE_NOOP("core", "Connection timed out"),
    QT_TRANSLATE_NOOP("core", "Connection reset by peer"),
    QT_TRANSLATE_NOOP("core", "No route to host"),
    QT_TRANSLATE_NOOP("core", "Network is unreachable"),
    QT_TRANSLATE_NOOP("core", "Host is down"),
    QT_TRANSLATE_NOOP("core", "Broken pipe"),
    QT_TRANSLATE_NOOP("core", "Address already in use"),
    QT_TRANSLATE_NOOP("core", "Temporary failure in name resolution"),
    QT_TRANSLATE_NOOP("core", "Name or service not known"),
    QT_TRANSLATE_NOOP("core", "No such file or directory"),
    QT_TRANSLATE_NOOP("core", "Permission denied"),
    QT_TRANSLATE_NOOP("core", "Operation not permitted"),
    QT_TRANSLATE_NOOP("core", "No space left on device"),
    QT_TRANSLATE_NOOP("core", "Read-only file system"),
    QT_TRANSLATE_NOOP("core", "Is a directory"),
    QT_TRANSLATE_NOOP("core", "Not a directory"),
    QT_TRANSLATE_NOOP("core", "Input/output error"),
    QT_TRANSLATE_NOOP("core", "No such device"),
    QT_TRANSLATE_NOOP("core", "No such device or address"),
    QT_TRANSLATE_NOOP("core", "Device or resource busy"),
    QT_TRANSLATE_NOOP("core", "Too many open files"),
    QT_TRANSLATE_NOOP("core", "Resource temporarily unavailable"),
    QT_TRANSLATE_NOOP("core", "Operation now in progress"),
    QT_TRANSLATE_NOOP("core", "Bad file descriptor"),
    QT_TRANSLATE_NOOP("core", "Invalid argument"),
}};

}  // namespace

std::span<const char* const> phrases_of_the_system() {
  return system_words;
}

}  // namespace zerodrift

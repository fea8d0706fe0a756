#include "core/controller/exports/formats.h"

namespace zerodrift::controller {

const std::vector<ExportFormat>& export_formats() {
  static const std::vector<ExportFormat> formats = {
      exports::linuxcnc(), exports::sinumerik_thermal(), exports::sinumerik_leadscrew(),
      exports::fanuc(),    exports::heidenhain(),
  };
  return formats;
}

Result<const ExportFormat*> export_format(const std::string& id) {
  std::string known;
  for (const ExportFormat& format : export_formats()) {
    if (format.id == id) return &format;
    known += (known.empty() ? "" : ", ") + std::string(format.id);
  }
  return fail(ErrorCode::bad_argument, {{"what", "the export format"}, {"found", id}, {"expected", "one of " + known}});
}

}  // namespace zerodrift::controller

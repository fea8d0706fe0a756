#pragma once
// The formats, one file each; formats.cpp lists them.

#include "core/controller/exports/export_format.h"

namespace zerodrift::controller::exports {

ExportFormat linuxcnc();
ExportFormat sinumerik_thermal();
ExportFormat sinumerik_leadscrew();
ExportFormat fanuc();
ExportFormat heidenhain();

}  // namespace zerodrift::controller::exports

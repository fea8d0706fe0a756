#pragma once
// The company that makes the reports, as it is kept on this computer.

#include "core/report/report.h"
#include "ui/widgets/company_dialog.h"

namespace zerodrift::desktop {

ui::Company keptCompany();
void keepCompany(const ui::Company& company);
/// Puts it at the head of the report.
void signWith(const ui::Company& company, report::Report& report);
/// Asks for it; false: given up.
bool askCompany(QWidget* parent);

}  // namespace zerodrift::desktop

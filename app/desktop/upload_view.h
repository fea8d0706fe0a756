#pragma once
// From tables, upload records and the history to what the upload page draws.

#include "core/compensation/table.h"
#include "core/controller/profile.h"
#include "core/controller/sign_check.h"
#include "core/controller/table_log.h"
#include "core/controller/upload.h"
#include "core/recording/recording.h"
#include "ui/pages/upload_page.h"

namespace zerodrift::desktop {

/// Compensations of both tables over the temperatures of a run; without temperature terms over the position.
QVector<ui::AxisTable> axes_of(const compensation::Table& old_table, const compensation::Table& new_table,
                               const controller::Profile& profile, const recording::Recording& run);
/// Steepest temperature coefficient of a table.
double steepest_um_per_K(const compensation::Table& table);
/// All stages of the transaction, filled up to the newest step; `failed` when it ended there.
QVector<ui::Stage> stages_of(const std::vector<controller::UploadStep>& steps, bool running, bool failed);
/// What was commanded and what was seen, axis by axis.
ui::SignCheckResult sign_of(const controller::SignCheckRecord& record);
/// The same from the artefact's JSON.
ui::SignCheckResult sign_of(const nlohmann::json& sign_check);
/// The log, newest first. `active` is what the machine holds; nothing while that is not known: then no entry is marked.
QVector<ui::TableVersion> history_of(const controller::TableLog& log,
                                     const std::optional<controller::ActiveTable>& active,
                                     const controller::Profile& profile);

}  // namespace zerodrift::desktop

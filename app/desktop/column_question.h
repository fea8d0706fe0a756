#pragma once
// Asks what the columns of a laser table are, beginning with what the last file of the same make was read as.

#include <QWidget>
#include <optional>

#include "core/compensation/laser.h"

namespace zerodrift::desktop {

/// What was settled for files of this make before.
std::optional<compensation::LaserMapping> remembered_mapping(const compensation::LaserPreview& preview);
void remember_mapping(const compensation::LaserPreview& preview, const compensation::LaserMapping& mapping);

/// Nothing when the user gave up. What was chosen is remembered.
std::optional<compensation::LaserMapping> ask_columns(QWidget* parent, const std::string& bytes,
                                                      const std::string& file,
                                                      const compensation::LaserPreview& preview);

}  // namespace zerodrift::desktop

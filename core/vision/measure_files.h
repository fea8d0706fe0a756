#pragma once
// Calibration and location from files, as the commands `calibrate` and `locate` do it: template, views.csv, a folder of
// frames in; calibration and positions out. A bad file among the frames is named and does not stop the good ones.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/task_context.h"
#include "core/vision/calibration.h"
#include "core/vision/target.h"

namespace zerodrift::vision {

struct TemplateChoice {
  std::filesystem::path file;
  std::optional<Region> region;     // none: found in the picture
  std::optional<PixelPoint> point;  // none: the region's centre
};

/// Warnings say which region was chosen and what was converted.
Result<Target> load_target(const TemplateChoice& choice, std::vector<std::string>* warnings);

/// What else the template shows, if anything: asked where no region was given, for a pattern that stands still beside
/// one that moves is hardly the target.
std::optional<Target> other_pattern(const Target& target);

struct ViewRow {
  std::filesystem::path image;  // beside views.csv unless absolute
  std::string name;             // as written
  double x_mm = 0.0;
  double y_mm = 0.0;
};
/// views.csv: image,x_mm,y_mm. A row whose position is no number is warned of and left out; an error where that leaves
/// fewer than two.
Result<std::vector<ViewRow>> read_views(const std::filesystem::path& file,
                                        std::vector<std::string>* warnings = nullptr);

struct FileCalibration {
  Calibration calibration;
  Target target;  // with the mask learned from the views
};
/// Views that cannot be read or in which the target is refused are warned of and left out.
Result<FileCalibration> calibrate_from_files(const Target& target, const std::vector<ViewRow>& views,
                                             std::vector<std::string>* warnings, const TaskContext& context);

struct FramePosition {
  std::string frame;  // file name
  Location location;
  std::optional<ErrorUm> error;
};
struct LocateRequest {
  std::vector<Target> references;
  std::optional<Calibration> calibration;
  std::optional<Target> other;  // see other_pattern
  bool learn = true;  // mask and lens from the frames themselves; not needed when the target has learned from views
};
/// Every picture in the folder by file name. Pictures that cannot be read have a row with their reason; other files and
/// what was converted are warned of. Errors: file_not_found, not_enough_data when there is no picture at all,
/// bad_argument when the other pattern moves and the target does not.
Result<std::vector<FramePosition>> locate_in_folder(const Target& target, const LocateRequest& request,
                                                    const std::filesystem::path& folder,
                                                    std::vector<std::string>* warnings, const TaskContext& context);
/// positions.csv by the contract; the columns in um when there is a calibration.
std::string positions_csv(const std::vector<FramePosition>& positions, bool with_um);

}  // namespace zerodrift::vision

#include "core/vision/measure_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/file.h"
#include "core/recording/csv.h"
#include "core/recording/import/text_table.h"
#include "core/vision/error_view.h"
#include "core/vision/file_order.h"
#include "core/vision/image_codec.h"
#include "core/vision/one_direction.h"
#include "core/vision/region_finder.h"

namespace zerodrift::vision {
namespace {

namespace fs = std::filesystem;

constexpr double unmoved_px = 0.3;
constexpr double farthest_mm = 1e5;  // that any machine moves
const char* const folder_of_pictures = "a folder of PNG, JPEG, BMP or TIFF pictures";

void warn(std::vector<std::string>* warnings, std::string text) {
  if (warnings != nullptr) warnings->push_back(std::move(text));
}

// In few words, for a row or a warning; the file's name stands beside it.
std::string short_reason(const Error& error) {
  if (error.code == ErrorCode::file_not_found) return "the file does not exist";
  const auto detail = error.context.find("detail");
  std::string reason = detail != error.context.end() ? detail->second : std::string(name_of(error.code));
  if (error.code == ErrorCode::file_too_large) {
    reason = fmt::format("larger than {} MB", std::stoull(error.context.at("limit")) / 1'000'000);
  }
  return "unreadable: " + reason;
}

bool looks_like_picture(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  static const std::vector<std::string> known{".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"};
  return std::find(known.begin(), known.end(), extension) != known.end();
}

Result<std::vector<fs::path>> pictures_in(const fs::path& folder, std::vector<std::string>* warnings) {
  std::error_code problem;
  if (!fs::exists(folder, problem)) return fail(ErrorCode::file_not_found, {{"file", folder.string()}});
  if (!fs::is_directory(folder, problem)) {
    return fail(ErrorCode::wrong_format,
                {{"file", folder.string()}, {"found", "a file"}, {"expected", folder_of_pictures}});
  }
  std::vector<fs::path> out;
  for (fs::directory_iterator it(folder, problem), end; !problem && it != end; it.increment(problem)) {
    std::error_code ignored;
    const std::string name = it->path().filename().string();
    if (name.empty() || name.front() == '.') continue;
    if (it->is_directory(ignored)) {
      if (looks_like_picture(it->path())) warn(warnings, name + " is a folder, no picture, and was left out");
      continue;
    }
    const fs::file_type type = it->status(ignored).type();
    const bool gives_bytes_later = type == fs::file_type::fifo || type == fs::file_type::socket ||
                                   type == fs::file_type::character || type == fs::file_type::block;
    if (gives_bytes_later) {
      warn(warnings, name + " is a pipe or a device, no picture, and was left out");
    } else if (looks_like_picture(it->path())) {
      out.push_back(it->path());
    } else {
      warn(warnings, name + " is no PNG, JPEG, BMP or TIFF picture and was left out");
    }
  }
  if (problem) {
    return fail(ErrorCode::file_unreadable, {{"file", folder.string()}, {"detail", problem.message()}});
  }
  std::sort(out.begin(), out.end(), [](const fs::path& a, const fs::path& b) {
    return is_before_by_number(a.filename().string(), b.filename().string());
  });
  if (out.empty()) {
    return fail(ErrorCode::wrong_format,
                {{"file", folder.string()}, {"found", "a folder without pictures"}, {"expected", folder_of_pictures}});
  }
  return out;
}

// Some of the frames, evenly over the folder, to learn from.
std::vector<GrayImage> sample_of(const std::vector<fs::path>& files) {
  constexpr std::size_t most = 15;
  std::vector<GrayImage> out;
  const std::size_t step = (files.size() + most - 1) / most;
  for (std::size_t k = 0; k < files.size(); k += step) {
    if (Result<DecodedImage> picture = read_image(files[k])) out.push_back(std::move(picture->image));
  }
  return out;
}

Location unreadable(const std::string& reason) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Location location;
  location.reason = reason;
  location.x_px = location.y_px = location.sigma_x_px = location.sigma_y_px = nan;
  return location;
}

// Once for all frames.
std::string beyond_calibration(const Calibration& calibration, const std::vector<FramePosition>& positions) {
  const auto beyond = [&](const FramePosition& one) { return one.location.ok && !calibration.covers(one.location); };
  const auto first = std::find_if(positions.begin(), positions.end(), beyond);
  if (first == positions.end()) return "";
  return fmt::format(
      "{} of {} frames lie beyond the range of the calibration, +-{:.1f} and +-{:.1f} px (the first is {} at {:.1f}, "
      "{:.1f} px): calibrate over all of the drift, or trust them less than their uncertainty says",
      std::count_if(first, positions.end(), beyond), positions.size(), calibration.range_px[0], calibration.range_px[1],
      first->frame, first->location.x_px, first->location.y_px);
}

double largest_move_px(const Target& target, const std::vector<GrayImage>& frames) {
  double largest = 0.0;
  for (const GrayImage& frame : frames) {
    if (const Location at = target.locate(frame); at.ok) largest = std::max(largest, std::hypot(at.x_px, at.y_px));
  }
  return largest;
}

// A pattern that nobody named, beside one that moves while it stands still, is hardly the target.
Status check_which_moves(const Target& target, const Target& other, const std::vector<GrayImage>& frames) {
  constexpr double still = 0.2;  // of the other's way
  constexpr double least_way_px = 0.3;
  const double way_px = largest_move_px(other, frames);
  if (way_px < least_way_px || largest_move_px(target, frames) > still * way_px) return {};
  const auto text_of = [](const Region& r) { return fmt::format("{},{},{},{}", r.x, r.y, r.width, r.height); };
  return fail(ErrorCode::bad_argument,
              {{"what", "the target (no region was given)"},
               {"found", fmt::format("{} stands still while {} moves by up to {:.1f} px", text_of(target.region()),
                                     text_of(other.region()), way_px)},
               {"expected", "the region of one of them"}});
}

struct LoadedView {
  ViewRow row;
  GrayImage image;
};

std::vector<LoadedView> load_views(const std::vector<ViewRow>& views, std::vector<std::string>* warnings) {
  std::vector<LoadedView> out;
  for (const ViewRow& row : views) {
    Result<DecodedImage> image = read_image(row.image);
    if (!image) {
      warn(warnings, row.name + " was left out: " + short_reason(image.error()));
      continue;
    }
    if (!image->note.empty()) warn(warnings, row.name + ": " + image->note);
    out.push_back({row, std::move(image->image)});
  }
  return out;
}

}  // namespace

Result<Target> load_target(const TemplateChoice& choice, std::vector<std::string>* warnings) {
  ZD_TRY(const DecodedImage picture, read_image(choice.file));
  const std::string name = choice.file.string();
  if (!picture.note.empty()) warn(warnings, name + ": " + picture.note);
  Region region;
  if (choice.region) {
    region = *choice.region;
  } else {
    ZD_TRY(region, find_textured_region(picture.image, name));
    const PixelPoint measured = choice.point.value_or(centre_of(region));
    warn(warnings, fmt::format("no region was given: {},{},{},{} shows the most pattern and is used, measured is the "
                               "point {:.1f}, {:.1f}",
                               region.x, region.y, region.width, region.height, measured.x_px, measured.y_px));
  }
  if (const auto& p = choice.point;
      p && !(p->x_px >= 0.0 && p->x_px < picture.image.width && p->y_px >= 0.0 && p->y_px < picture.image.height)) {
    return fail(
        ErrorCode::bad_argument,
        {{"what", "the point whose displacement is measured"},
         {"found", fmt::format("{:g},{:g}", p->x_px, p->y_px)},
         {"expected", fmt::format("a point of {}, {} x {} pixels", name, picture.image.width, picture.image.height)}});
  }
  ZD_TRY(Target target, Target::create(picture.image, region, choice.point, name));
  if (const Region& used = target.region(); used.width != region.width || used.height != region.height) {
    warn(warnings, fmt::format("the pattern goes on beyond the region and repeats itself: {},{},{},{} shows where it "
                               "ends and is used",
                               used.x, used.y, used.width, used.height));
  }
  if (std::string unseen = unseen_direction(picture.image, target.region()); !unseen.empty()) {
    warn(warnings, std::move(unseen));
  }
  return target;
}

std::optional<Target> other_pattern(const Target& target) {
  const Result<Region> at = find_textured_region(target.image(), "", &target.region());
  if (!at) return std::nullopt;
  Result<Target> other = Target::create(target.image(), *at, std::nullopt, "");
  return other ? std::optional(std::move(*other)) : std::nullopt;
}

namespace {

constexpr std::array<const char*, 3> view_columns{"image", "x_mm", "y_mm"};

/// views.csv as cells, and where its columns are.
struct ViewTable {
  recording::Cells cells;
  std::size_t header = 0;
  std::array<std::size_t, 3> columns{};
  recording::NumberFormat numbers;
};

/// Columns of image, x_mm and y_mm in a row; the first that is missing, else 3.
std::size_t find_view_columns(const recording::Cells& cells, std::size_t row, std::array<std::size_t, 3>& columns) {
  for (std::size_t k = 0; k < view_columns.size(); ++k) {
    columns[k] = 0;
    while (columns[k] < cells.columns(row) && cells.at(row, columns[k]) != view_columns[k]) ++columns[k];
    if (columns[k] == cells.columns(row)) return k;
  }
  return view_columns.size();
}

Result<ViewTable> read_view_table(const fs::path& file) {
  ZD_TRY(const std::string bytes, read_file(file));
  std::optional<Error> unnamed;
  for (const char* separator : {"", ";", "tab", ","}) {
    recording::TableOptions form;
    form.separator = separator;
    ZD_TRY(recording::SourceCells source, recording::parse_cells(bytes, file.string(), form));
    ViewTable table;
    while (table.header < source.cells.rows() &&
           (source.cells.is_blank(table.header) || source.cells.is_comment(table.header))) {
      ++table.header;
    }
    if (table.header == source.cells.rows()) return fail(ErrorCode::csv_empty, {{"file", file.string()}});
    const std::size_t missing = find_view_columns(source.cells, table.header, table.columns);
    if (missing == view_columns.size()) {
      table.cells = std::move(source.cells);
      return table;
    }
    if (unnamed) continue;
    unnamed = Error{ErrorCode::csv_bad_header,
                    {{"file", file.string()},
                     {"column", std::to_string(missing + 1)},
                     {"found", shortened(std::string(source.cells.at(table.header, missing)))},
                     {"expected", "image,x_mm,y_mm"}}};
  }
  return fail(*unnamed);
}

/// Decimal point or comma: as all positions of the file say together.
Result<recording::NumberFormat> numbers_of(const ViewTable& table, const fs::path& file) {
  recording::NumberEvidence evidence;
  for (std::size_t row = table.header + 1; row < table.cells.rows(); ++row) {
    for (std::size_t k = 1; k < view_columns.size(); ++k) {
      const std::string_view cell = table.cells.at(row, table.columns[k]);
      evidence.add(cell, [&] {
        return recording::NumberEvidence::Place{std::string(cell), table.cells.line(row), view_columns[k]};
      });
    }
  }
  return evidence.decide(file.string());
}

}  // namespace

Result<std::vector<ViewRow>> read_views(const fs::path& file, std::vector<std::string>* warnings) {
  ZD_TRY(ViewTable table, read_view_table(file));
  ZD_TRY(table.numbers, numbers_of(table, file));
  const std::size_t width = table.cells.columns(table.header);
  std::vector<ViewRow> out;
  std::optional<Error> first_fault;
  for (std::size_t row = table.header + 1; row < table.cells.rows(); ++row) {
    if (table.cells.is_blank(row) || table.cells.is_comment(row)) continue;
    const int line = table.cells.line(row);
    if (table.cells.columns(row) != width) {
      return fail(ErrorCode::csv_cell_count, {{"file", file.string()},
                                              {"line", std::to_string(line)},
                                              {"found", std::to_string(table.cells.columns(row))},
                                              {"expected", std::to_string(width)}});
    }
    ViewRow view;
    view.name = table.cells.at(row, table.columns[0]);
    bool good = true;
    for (std::size_t k = 1; k < 3 && good; ++k) {
      const std::string_view cell = table.cells.at(row, table.columns[k]);
      const std::optional<double> value = table.numbers.number(cell);
      good = value && std::abs(*value) <= farthest_mm;
      if (good) {
        (k == 1 ? view.x_mm : view.y_mm) = *value;
        continue;
      }
      const std::string found = cell.empty() ? "an empty cell" : shortened(std::string(cell));
      const std::string place = fmt::format("{}, line {}, {}", file.string(), line, view_columns[k]);
      warn(warnings, fmt::format("{}: \"{}\" is no position in mm; {} was left out", place, found, view.name));
      if (!first_fault) {
        first_fault = Error{ErrorCode::bad_argument,
                            {{"what", place}, {"found", found}, {"expected", "where the machine stood, in mm"}}};
      }
    }
    if (!good) continue;
    const fs::path beside = file.parent_path() / view.name;
    std::error_code ignored;
    view.image = fs::exists(beside, ignored) || !fs::exists(view.name, ignored) ? beside : fs::path(view.name);
    const auto before =
        std::find_if(out.begin(), out.end(), [&](const ViewRow& one) { return one.image == view.image; });
    if (before != out.end()) {
      const std::string place = fmt::format("{}, line {}", file.string(), line);
      if (before->x_mm != view.x_mm || before->y_mm != view.y_mm) {
        return fail(ErrorCode::bad_argument,
                    {{"what", place},
                     {"found", view.name + " once more, at another position"},
                     {"expected", "every picture once, with the position at which it was taken"}});
      }
      warn(warnings, fmt::format("{}: {} is there already; it counts once", place, view.name));
      continue;
    }
    out.push_back(std::move(view));
  }
  if (first_fault && out.size() < 2) return fail(*first_fault);
  return out;
}

Result<FileCalibration> calibrate_from_files(const Target& target, const std::vector<ViewRow>& views,
                                             std::vector<std::string>* warnings, const TaskContext& context) {
  const std::vector<LoadedView> loaded = load_views(views, warnings);
  std::vector<GrayImage> frames;
  for (const LoadedView& view : loaded) frames.push_back(view.image);
  const Target masked = target.learned_from(frames);
  std::vector<CalibrationView> used;
  std::string refused;  // the first, with its reason
  for (std::size_t k = 0; k < loaded.size(); ++k) {
    if (context.cancelled()) return fail(ErrorCode::cancelled);
    context.progress(static_cast<double>(k) / static_cast<double>(loaded.size()), "calibration");
    const Location at = masked.locate(loaded[k].image);
    if (!at.ok) {
      warn(warnings, loaded[k].row.name + " was left out: " + at.reason);
      if (refused.empty()) refused = loaded[k].row.name + ": " + at.reason;
      continue;
    }
    used.push_back({loaded[k].row.name, loaded[k].row.x_mm, loaded[k].row.y_mm, at.x_px, at.y_px,
                    std::hypot(at.sigma_x_px, at.sigma_y_px) / std::sqrt(2.0)});
  }
  // What most views do not show is not what the few others can be trusted to show, and they leave nothing to check
  // with.
  const bool most_refused = !refused.empty() && 2 * used.size() < loaded.size();
  if (most_refused || (used.size() < 2 && !refused.empty())) {
    std::string reason = fmt::format("the target was found in {} of {} views (the first without it is {})", used.size(),
                                     loaded.size(), refused);
    if (const std::string unseen = unseen_direction(target.image(), target.region()); !unseen.empty()) {
      reason += "; " + unseen;
    }
    return fail(ErrorCode::calibration_refused, {{"reason", reason}});
  }
  ZD_TRY(Calibration calibration, calibrate(std::move(used)));
  // A backdrop that is taken for part of the target hides it in some views and draws it in the others, the zero
  // included.
  if (!refused.empty() && scatters_beyond_pictures(calibration)) {
    return fail(
        ErrorCode::calibration_refused,
        {{"reason", fmt::format("the target was found in {} of {} views (the first without it is {}), and there the "
                                "residual of {:.1f} um rms is more than their pictures and the machine explain: what "
                                "stands behind shows through; give it an even backdrop, brighter or darker than the "
                                "target",
                                calibration.views.size(), loaded.size(), refused, calibration.rms_um)}});
  }
  return FileCalibration{std::move(calibration), masked};
}

namespace {

// Where nothing has moved, the frame shows what the template shows, the backdrop included. Of one that does not, and
// that was found there by what frames taught, only what stands still was found.
bool unlike_unmoved(const Target& target, const Location& at, const GrayImage& frame) {
  if (!at.ok || std::hypot(at.x_px, at.y_px) > unmoved_px) return false;
  return !target.locate(frame).ok;
}

}  // namespace

Result<std::vector<FramePosition>> locate_in_folder(const Target& target, const LocateRequest& request,
                                                    const fs::path& folder, std::vector<std::string>* warnings,
                                                    const TaskContext& context) {
  ZD_TRY(const std::vector<fs::path> files, pictures_in(folder, warnings));
  const std::vector<GrayImage> sample = request.learn || request.other ? sample_of(files) : std::vector<GrayImage>();
  if (request.other) ZD_CHECK(check_which_moves(target, *request.other, sample));
  const Target taught = request.learn ? target.learned_from(sample, Cover::possible) : target;
  std::vector<FramePosition> out;
  for (const fs::path& file : files) {
    if (context.cancelled()) return fail(ErrorCode::cancelled);
    context.progress(static_cast<double>(out.size()) / static_cast<double>(files.size()), "location");
    FramePosition position;
    position.frame = file.filename().string();
    const Result<DecodedImage> picture = read_image(file);
    if (!picture) {
      position.location = unreadable(short_reason(picture.error()));  // told with the frame's row
    } else {
      if (!picture->note.empty()) warn(warnings, position.frame + ": " + picture->note);
      std::vector<Location> marks;
      position.location = locate_against(taught, request.references, picture->image, &marks);
      if (request.learn && unlike_unmoved(target, position.location, picture->image)) {
        position.location = target.locate(picture->image);
      }
      const std::string lost = marks_not_seen(marks);
      if (position.location.ok && !lost.empty()) warn(warnings, position.frame + " was measured without " + lost);
      if (position.location.refusal == Refusal::other_size) {
        warn(warnings, fmt::format("{}: {}x{} pixels, the template has {}x{}", position.frame, picture->image.width,
                                   picture->image.height, target.image().width, target.image().height));
      }
    }
    if (request.calibration && position.location.ok) position.error = request.calibration->to_um(position.location);
    out.push_back(std::move(position));
  }
  if (request.calibration) {
    if (std::string beyond = beyond_calibration(*request.calibration, out); !beyond.empty()) {
      warn(warnings, std::move(beyond));
    }
  }
  return out;
}

std::string positions_csv(const std::vector<FramePosition>& positions, bool with_um) {
  using recording::cell_text;
  using recording::number_text;
  std::string text = "frame,x_px,y_px,sigma_x_px,sigma_y_px,ok,reason";
  if (with_um) text += ",ex_um,ey_um,sigma_ex_um,sigma_ey_um";
  text += '\n';
  for (const FramePosition& p : positions) {
    const Location& at = p.location;
    text += fmt::format("{},{},{},{},{},{},{}", cell_text(p.frame), number_text(at.x_px), number_text(at.y_px),
                        number_text(at.sigma_x_px), number_text(at.sigma_y_px), at.ok ? 1 : 0, cell_text(at.reason));
    if (with_um && p.error) {
      text += fmt::format(",{},{},{},{}", number_text(p.error->x_um), number_text(p.error->y_um),
                          number_text(p.error->sigma_x_um), number_text(p.error->sigma_y_um));
    } else if (with_um) {
      text += ",,,,";
    }
    text += '\n';
  }
  return text;
}

}  // namespace zerodrift::vision

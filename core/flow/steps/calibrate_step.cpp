#include "core/flow/steps/calibrate_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <nlohmann/json.hpp>

#include "core/base/redact.h"
#include "core/compensation/interlock.h"
#include "core/vision/camera_latency.h"
#include "core/vision/image_codec.h"
#include "core/vision/standing_pictures.h"

namespace zerodrift::flow {

using nlohmann::json;

namespace {

constexpr int template_frames = 8;  // averaged: the template's noise enters every measurement
constexpr std::chrono::milliseconds frame_timeout{6000};
constexpr std::chrono::milliseconds opening_timeout{8000};  // a camera on the network is looked for first
// A camera gives its exposure back in steps of its own clock; its gain in steps of a tenth of a decibel.
constexpr double same_exposure = 0.01;
constexpr double same_gain_db = 0.1;

vision::Region region_of(const std::array<int, 4>& box) {
  return vision::Region{box[0], box[1], box[2], box[3]};
}

std::array<int, 4> roi_of(const controller::CameraProfile& camera, const CalibrateOptions& options) {
  const auto drawn = options.regions.find(camera.id);
  return drawn != options.regions.end() ? drawn->second : camera.target_roi_px;
}

double span_of(const Devices& devices, const CalibrateOptions& options) {
  return options.span_mm > 0.0 ? options.span_mm : devices.profile.calibration_span_mm;
}

/// As measured with the calibration; a calibration of before it was measured has none, and the profile's is assumed.
acquisition::Latency latency_in(const json& camera, const controller::CameraProfile& profile) {
  acquisition::Latency assumed;
  assumed.mean_s = assumed.spread_s = 0.5 * profile.assumed_latency_s;
  const auto kept = camera.find("latency");
  if (kept == camera.end() || !kept->is_object()) return assumed;
  const auto number = [&](const char* key) {
    const auto at = kept->find(key);
    return at != kept->end() && at->is_number() ? at->get<double>() : -1.0;
  };
  const double mean_s = number("mean_s");
  const double spread_s = number("spread_s");
  const double observations = number("observations");
  if (!(mean_s >= 0.0) || !(spread_s >= 0.0) || !(observations >= 1.0)) return assumed;
  return {mean_s, spread_s, static_cast<int>(std::min(observations, 1e6))};
}

Result<int> axis_index(const std::string& axis) {
  for (int i = 0; i < 3; ++i) {
    if (axis == std::string(1, "XYZ"[i])) return i;
  }
  return fail(ErrorCode::bad_argument, {{"what", "axis of a camera"}, {"found", axis}, {"expected", "X, Y or Z"}});
}

/// Pictures are kept without loss; one that cannot be encoded would be lost silently.
Result<commissioning::Blob> picture(const std::string& name, const vision::GrayImage& image) {
  ZD_TRY(const auto png, vision::encode_png(image));
  return commissioning::Blob{name, std::string(png.begin(), png.end())};
}

Result<vision::GrayImage> picture_of(const commissioning::Job& job, commissioning::ArtefactId id,
                                     const std::string& name) {
  ZD_TRY(const std::string bytes, job.blob(id, name));
  const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data());
  ZD_TRY(auto decoded, vision::decode({first, bytes.size()}, name));
  return std::move(decoded.image);
}

Result<std::vector<vision::Target>> mark_targets(const vision::GrayImage& image,
                                                 const std::vector<std::array<int, 4>>& marks,
                                                 const std::string& name) {
  std::vector<vision::Target> targets;
  for (std::size_t k = 0; k < marks.size(); ++k) {
    const std::string which = marks.size() == 1 ? name : fmt::format("{} (reference {})", name, k + 1);
    ZD_TRY(auto target, vision::Target::create(image, region_of(marks[k]), std::nullopt, which));
    targets.push_back(std::move(target));
  }
  return targets;
}

struct CameraCalibration {
  json body;
  std::vector<commissioning::Blob> blobs;
};

/// The pictures of all cameras at one moment, with the machine's stand in them.
struct Templates {
  std::vector<vision::GrayImage> images;
  acquisition::Stand stand;
  std::vector<double> waited_s;  // of each camera, from the stand to the stamp of the first picture
};

/// Of all cameras at once, by moves within what a calibration drives anyhow.
Result<std::vector<acquisition::Latency>> measure_latencies(Devices& devices, const CalibrateOptions& options,
                                                            const acquisition::Stand& home,
                                                            const TaskContext& context) {
  vision::LatencyPlan plan;
  plan.home = home;
  plan.centre_mm = devices.profile.measure_position_mm;
  plan.way_mm = 0.5 * span_of(devices, options);
  std::vector<vision::LatencyCamera> cameras;
  for (const auto& device : devices.cameras) {
    cameras.push_back({device.profile.id, device.camera.get(), region_of(roi_of(device.profile, options))});
    plan.longest_s = std::max(plan.longest_s, device.profile.assumed_latency_s);
    for (const std::string& axis : device.profile.axes) {
      if (std::find(plan.axes.begin(), plan.axes.end(), axis) == plan.axes.end()) plan.axes.push_back(axis);
    }
  }
  ZD_TRY(auto latencies, vision::measure_latency(*devices.machine, cameras, plan, context));
  if (!devices.machine->by_hand()) return latencies;
  // A person begins a move some time after it was asked for: that is no age of the pictures.
  for (std::size_t k = 0; k < latencies.size(); ++k) {
    const double assumed_s = devices.cameras[k].profile.assumed_latency_s;
    if (latencies[k].settle().count() > assumed_s) latencies[k] = {0.5 * assumed_s, 0.5 * assumed_s, 1};
  }
  return latencies;
}

/// The templates of all cameras, at one moment and before anything else moves: they are the zero of the errors, and the
/// machine drifts while its cameras are calibrated. Every error counts from them: they are waited for as if no latency
/// were known.
Result<Templates> take_templates(Devices& devices, const CalibrateOptions& options,
                                 const std::vector<acquisition::Latency>& latencies, const TaskContext& context) {
  Templates out;
  ZD_TRY(out.stand, come_to_measuring_position(devices));
  acquisition::Stand seen = out.stand;
  seen.check = nullptr;  // the machine is asked from this thread alone
  std::vector<std::future<Result<vision::Pictures>>> pending;
  for (std::size_t k = 0; k < devices.cameras.size(); ++k) {
    vision::StandingLook look;
    look.region = region_of(roi_of(devices.cameras[k].profile, options));
    look.latency = latencies[k];
    look.latency.spread_s = std::max(latencies[k].spread_s, devices.cameras[k].profile.assumed_latency_s);
    look.pictures = template_frames;
    look.picture_timeout = frame_timeout;
    pending.push_back(std::async(std::launch::async, [&devices, &context, &seen, k, look] {
      return vision::standing_pictures(*devices.cameras[k].camera, seen, look, context);
    }));
  }
  std::vector<Result<vision::Pictures>> taken;  // all of them, so that no thread is left behind
  for (auto& one : pending) taken.push_back(one.get());
  ZD_CHECK(out.stand.still());
  for (std::size_t k = 0; k < taken.size(); ++k) {
    ZD_TRY(const vision::Pictures pictures, std::move(taken[k]));
    out.waited_s.push_back((pictures.front()->stamp - seen.since).count());
    ZD_TRY(out.images.emplace_back(), vision::mean_of(pictures, without_secrets(devices.cameras[k].profile.url)));
  }
  return out;
}

/// The latencies, and templates that were waited for longer than these: taken before a latency is known, they are taken
/// again where it turns out to be longer than was expected.
Result<std::vector<acquisition::Latency>> latencies_and_templates(Devices& devices, const CalibrateOptions& options,
                                                                  Templates& templates, const TaskContext& context) {
  const std::vector<acquisition::Latency> unknown(devices.cameras.size(), acquisition::Latency::none());
  ZD_TRY(templates, take_templates(devices, options, unknown, context));
  ZD_TRY(auto latencies, measure_latencies(devices, options, templates.stand, context));
  bool late = false;
  for (std::size_t k = 0; k < latencies.size(); ++k) {
    const bool live = !devices.cameras[k].camera->is_file();
    late = late || (live && templates.waited_s[k] <= latencies[k].settle().count());
  }
  if (late) {
    ZD_TRY(templates, take_templates(devices, options, latencies, context));
  }
  return latencies;
}

Result<CameraCalibration> calibrate_camera(Devices& devices, const CameraDevice& device, const vision::GrayImage& image,
                                           const acquisition::Latency& latency, const CalibrateOptions& options,
                                           const TaskContext& context) {
  const auto& profile = device.profile;
  const std::array<int, 4> roi = roi_of(profile, options);
  ZD_TRY(const auto target, vision::Target::create(image, region_of(roi), std::nullopt, without_secrets(profile.url)));
  const auto marked = options.marks.find(profile.id);
  const auto& marks = marked != options.marks.end() ? marked->second : profile.reference_rois_px;
  // Refused now, too, is what could not be measured later.
  ZD_TRY(const auto mark_patterns, mark_targets(image, marks, without_secrets(profile.url)));
  vision::CalibrationPlan plan;
  plan.axes = profile.axes;
  plan.centre_mm = devices.profile.measure_position_mm;
  plan.span_mm = span_of(devices, options);
  plan.latency = latency;
  plan.per_side = options.per_side;
  plan.drift.um_per_min = devices.profile.max_drift_um_per_min;
  plan.time_factor = devices.profile.time_factor;
  if (devices.profile.time_factor > 10.0) plan.frames = 2;
  ZD_TRY(auto outcome, vision::run_calibration(
                           *devices.machine, *device.camera, target, mark_patterns, plan, context,
                           [&](int done, int of, const vision::GrayImage& frame, const vision::Location& location) {
                             context.progress(double(done) / of, "calibrating");
                             if (options.watcher) {
                               options.watcher({profile.id, done, of, &frame, &location});
                             }
                           }));
  CameraCalibration made;
  made.body = {
      {"id", profile.id},
      {"axes", profile.axes},
      {"roi", roi},
      {"um_per_px", outcome.calibration.scale_um_per_px},
      {"rotation_deg", outcome.calibration.rotation_deg},
      {"rms_um", outcome.calibration.rms_um},
      {"positions", outcome.calibration.views.size()},
      {"latency", {{"mean_s", latency.mean_s}, {"spread_s", latency.spread_s}, {"observations", latency.observations}}},
      {"calibration", vision::to_json(outcome.calibration)}};
  if (const auto identity = device.camera->identity(); identity) {
    if (json kept = device_json(*identity); !kept.is_null()) made.body["device"] = std::move(kept);
  }
  if (marks.size() == 1) made.body["reference_roi"] = marks.front();
  if (marks.size() > 1) {
    made.body["reference_roi"] = marks;
    made.body["takes_off"] = taken_off_by(marks) == vision::TakenOff::shift_turn_scale ? "turn" : "shift";
  }
  ZD_TRY(made.blobs.emplace_back(), picture(profile.id + "-template.png", image));
  for (std::size_t i = 0; options.keep_views && i < outcome.frames.size(); ++i) {
    ZD_TRY(made.blobs.emplace_back(), picture(fmt::format("{}-view-{}.png", profile.id, i + 1), outcome.frames[i]));
  }
  return made;
}

/// A camera that does not open in time cannot be told from another one.
Status is_calibrated_device(const json& body, const CameraDevice& device) {
  const auto kept = body.find("device");
  if (kept == body.end() || !kept->is_object()) return {};
  const auto identity = device.camera->identity(opening_timeout);
  if (identity) return same_device(device.profile.id, *kept, *identity);
  const auto frame = device.camera->newest();
  return frame ? Status{} : fail(frame.error());
}

Result<vision::ErrorView> view_of(const commissioning::Job& job, const commissioning::Artefact& artefact,
                                  const json& body, const CameraDevice& device) {
  const std::string id = device.profile.id;
  ZD_CHECK(is_calibrated_device(body, device));
  ZD_TRY(const vision::GrayImage image, picture_of(job, artefact.id, id + "-template.png"));
  std::vector<vision::GrayImage> frames;
  for (const auto& name : artefact.blob_names) {
    if (!name.starts_with(id + "-view-")) continue;
    ZD_TRY(frames.emplace_back(), picture_of(job, artefact.id, name));
  }
  vision::ErrorView view;
  view.id = id;
  view.camera = device.camera;
  view.latency = latency_in(body, device.profile);
  ZD_TRY(const auto plain, vision::Target::create(image, region_of(body.at("roi").get<std::array<int, 4>>()),
                                                  std::nullopt, id + "-template.png"));
  view.target = std::make_shared<const vision::Target>(plain.learned_from(frames));
  ZD_TRY(view.references, mark_targets(image, marks_of(body), id + "-template.png"));
  ZD_TRY(view.calibration, vision::calibration_from_json(body.at("calibration"), "calibration of " + id));
  for (int i = 0; i < 2; ++i) {
    ZD_TRY(view.axes[static_cast<std::size_t>(i)], axis_index(device.profile.axes[static_cast<std::size_t>(i)]));
  }
  return view;
}

/// The person's word first, then the machine's: while one waited, the other may have switched the compensation on.
Status may_move(Devices& devices, const std::string& camera, const CalibrateOptions& options,
                const TaskContext& context) {
  if (options.may_move) ZD_CHECK(options.may_move(camera, context));
  ZD_TRY(const bool compensating, devices.machine->compensation_on());
  return compensation::allow_model_measurement(compensating);
}

}  // namespace

std::vector<std::array<int, 4>> marks_of(const json& camera) {
  const auto found = camera.find("reference_roi");
  if (found == camera.end() || !found->is_array() || found->empty()) return {};
  const json list = found->front().is_array() ? *found : json::array({*found});
  const auto number = [](const json& value) { return value.is_number(); };
  std::vector<std::array<int, 4>> marks;
  for (const json& mark : list) {  // a job may come from elsewhere
    if (!mark.is_array() || mark.size() != 4 || !std::all_of(mark.begin(), mark.end(), number)) return {};
    marks.push_back(mark.get<std::array<int, 4>>());
  }
  return marks;
}

vision::TakenOff taken_off_by(const std::vector<std::array<int, 4>>& marks) {
  std::vector<vision::Region> regions;
  for (const auto& mark : marks) regions.push_back(region_of(mark));
  return vision::taken_off_by(regions);
}

json device_json(const vision::CameraIdentity& identity) {
  if (identity.kind.empty()) return {};
  json device = {
      {"kind", identity.kind}, {"vendor", identity.vendor}, {"model", identity.model}, {"serial", identity.serial}};
  if (identity.exposure_us) device["exposure_us"] = *identity.exposure_us;
  if (identity.gain_db) device["gain_db"] = *identity.gain_db;
  return device;
}

Status same_device(const std::string& camera, const json& kept, const vision::CameraIdentity& now) {
  const auto other = [&](const char* what, const std::string& found, const std::string& expected) {
    return fail(ErrorCode::calibration_of_another_camera,
                {{"camera", camera}, {"what", what}, {"found", found}, {"expected", expected}});
  };
  const auto text = [&](const char* key) {
    const auto at = kept.find(key);
    return at != kept.end() && at->is_string() ? at->get<std::string>() : std::string();
  };
  const auto number = [&](const char* key) {
    const auto at = kept.find(key);
    return at != kept.end() && at->is_number() ? std::optional(at->get<double>()) : std::nullopt;
  };
  if (const std::string serial = text("serial"); !serial.empty() && serial != now.serial) {
    return other("the serial number", now.serial.empty() ? "none" : now.serial, serial);
  }
  if (const std::string model = text("model"); !model.empty() && !now.model.empty() && model != now.model) {
    return other("the model", now.model, model);
  }
  const auto exposure_us = number("exposure_us");
  if (exposure_us && now.exposure_us && std::abs(*now.exposure_us - *exposure_us) > same_exposure * *exposure_us) {
    return other("the exposure", fmt::format("{:g} us", *now.exposure_us), fmt::format("{:g} us", *exposure_us));
  }
  const auto gain_db = number("gain_db");
  if (gain_db && now.gain_db && std::abs(*now.gain_db - *gain_db) > same_gain_db) {
    return other("the gain", fmt::format("{:g} dB", *now.gain_db), fmt::format("{:g} dB", *gain_db));
  }
  return {};
}

Result<commissioning::NewArtefact> calibrate(const commissioning::Job& job, Devices& devices,
                                             const CalibrateOptions& options, const TaskContext& context) {
  ZD_TRY(const auto machine, job.latest("machine"));
  if (!machine) return fail(ErrorCode::step_blocked, {{"step", "calibrate"}, {"needs", "machine"}});
  ZD_TRY(const bool compensating, devices.machine->compensation_on());
  ZD_CHECK(compensation::allow_model_measurement(compensating));
  json body = {{"source", "camera"}, {"reference_target", !devices.cameras.empty()}, {"cameras", json::array()}};
  std::vector<commissioning::Blob> blobs;
  if (devices.profile.error_source == controller::ErrorSourceKind::probes) {
    body["source"] = "probes";
    return commissioning::NewArtefact::of("calibration", body, {machine->id});
  }
  if (!devices.cameras.empty()) ZD_CHECK(may_move(devices, devices.cameras.front().profile.id, options, context));
  ZD_CHECK(devices.machine->command(0.0, false, false));
  if (devices.profile.measure_position_mm.empty()) {
    return fail(ErrorCode::no_measuring_position, {{"axes", "X, Y, Z"}});
  }
  Templates templates;
  ZD_TRY(const auto latencies, latencies_and_templates(devices, options, templates, context));
  for (std::size_t i = 0; i < devices.cameras.size(); ++i) {
    const auto& device = devices.cameras[i];
    if (i > 0) ZD_CHECK(may_move(devices, device.profile.id, options, context));
    ZD_TRY(auto made, calibrate_camera(devices, device, templates.images[i], latencies[i], options, context));
    if (marks_of(made.body).empty()) body["reference_target"] = false;
    body["cameras"].push_back(std::move(made.body));
    for (auto& blob : made.blobs) blobs.push_back(std::move(blob));
  }
  return commissioning::NewArtefact::of("calibration", body, {machine->id}, std::move(blobs));
}

Result<std::vector<vision::ErrorView>> calibrated_views(const commissioning::Job& job, Devices& devices) {
  ZD_TRY(const auto artefact, job.latest("calibration"));
  if (!artefact) return fail(ErrorCode::step_blocked, {{"step", "warm-up"}, {"needs", "calibration"}});
  ZD_TRY(const json body, artefact->document());
  std::vector<vision::ErrorView> views;
  for (const auto& device : devices.cameras) {
    bool found = false;
    for (const auto& camera : body.at("cameras")) {
      if (camera.at("id") != device.profile.id) continue;
      ZD_TRY(views.emplace_back(), view_of(job, *artefact, camera, device));
      found = true;
    }
    if (!found) {
      return fail(ErrorCode::step_blocked,
                  {{"step", "warm-up"}, {"needs", "calibration of camera " + device.profile.id}});
    }
  }
  return views;
}

}  // namespace zerodrift::flow

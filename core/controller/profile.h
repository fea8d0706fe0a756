#pragma once
// The connection profile of a machine (docs/profile.md): how its controller, cameras and sensors are reached and what
// its limits are.

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/controller/device_profile.h"

namespace zerodrift::controller {

struct CameraProfile {
  std::string id;
  std::string url;
  std::array<std::string, 2> axes;  // machine axes along the image's right and up
  double um_per_px_nominal = 0.0;
  std::array<int, 4> target_roi_px{};                 // x, y, width, height
  std::vector<std::array<int, 4>> reference_rois_px;  // fixed marks, in the order of the file; may be none
  bool pixel_size_known = true;
  double assumed_latency_s = 3.0;     // age of its pictures that is waited for as long as none was measured
  std::optional<double> exposure_us;  // set while the camera is read; absent: as the camera is set
  std::optional<double> gain_db;
};

struct SensorProfile {
  std::string channel;
  std::string label;
  std::string place;
  std::optional<double> position_mm;
  double accuracy_C = 0.1;
  SignalSource source{};  // without a device the control's register of the sensor's place in the list
};

enum class ErrorSourceKind {
  camera,
  probes,
};

/// Quantities that are read from another device than the control.
struct SignalSources {
  std::optional<SignalSource> ambient;
  std::optional<SignalSource> speed;
  std::optional<SignalSource> load;
  std::optional<SignalSource> coolant;
  std::optional<SignalSource> compensation_state;
  std::map<std::string, SignalSource> positions;  // "X" -> mm
  std::vector<SignalSource> probes;               // X1 X2 Y1 Y2 Z, or none
};

struct Profile {
  std::string file;
  bool of_job = false;  // it came out of a job: files that it names are not read
  std::string name;
  double time_factor = 1.0;  // machine seconds a host second
  ControllerSettings controller;
  bool manual = false;                 // the control has no link: a person does what is asked (manual_control.h)
  std::uint32_t serial = 0;            // of the machine; 0: not known. A table made by this profile is for it
  std::vector<DeviceProfile> devices;  // read beside the control
  SignalSources sources;
  std::vector<CameraProfile> cameras;
  ErrorSourceKind error_source = ErrorSourceKind::camera;
  std::map<std::string, double> measure_position_mm;  // empty: the profile has none
  double calibration_span_mm = 1.6;
  std::vector<SensorProfile> sensors;  // their order gives the numbers in a controller's table
  double max_um = 200.0;
  double max_um_per_s = 2.0;
  double max_um_per_K = 50.0;                     // the steepest coefficient the controller takes
  double max_drift_um_per_min = 20.0;             // of an error: what heat can make of it, at most
  std::shared_ptr<const nlohmann::json> machine;  // machine description, null if the profile has none
  std::string machine_file;                       // where it came from, for messages
};

Result<Profile> profile_from_json(const nlohmann::json& document, const std::string& file,
                                  std::vector<std::string>* warnings = nullptr);
/// The profile as a job keeps it: the machine description and a register map that is a file of its own stand in it, and
/// no password does.
Result<nlohmann::json> document_for_job(const nlohmann::json& document, const Profile& profile);
/// A profile out of a job, which may come from elsewhere: no file that it names is read (job_reaches_out), beside the
/// maps that the program brings.
Result<Profile> profile_from_job(const nlohmann::json& document);
Result<Profile> read_profile(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);

/// Null when there is none of this name.
const DeviceProfile* find_device(const Profile& profile, const std::string& id);

/// Number of a sensor in a table's words: the position in the profile, from 1; ambient_C is 0.
Result<int> sensor_number(const Profile& profile, const std::string& channel);
/// The channel of a number; data_does_not_fit when the profile has no such sensor.
Result<std::string> sensor_channel(const Profile& profile, int number);

}  // namespace zerodrift::controller

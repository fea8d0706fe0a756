#pragma once
// A connection profile while it is set up: the document as it is in the file with every key kept, the changes a person
// makes to it, undo and redo, and what its reader says. Places are named as in the reader's errors: "devices[1]",
// "sensors[3]", "positions.X".

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/controller/profile.h"
#include "core/controller/register_map.h"

namespace zerodrift::controller {

class ProfileDraft {
 public:
  /// A new one: a control without a link and nothing else.
  ProfileDraft();
  ProfileDraft(nlohmann::json document, std::string file);
  static Result<ProfileDraft> open(const std::filesystem::path& path);

  const nlohmann::json& document() const { return m_document; }
  const std::string& file() const { return m_file; }
  /// Beside it are the files that it names.
  std::filesystem::path folder() const { return std::filesystem::path(m_file).parent_path(); }
  /// Since it was opened or saved.
  bool changed() const { return m_document != m_saved; }
  /// By the reader of the command line; beyond it, each device must have the signals that are read from it. An error
  /// names the place by its `key`.
  Result<Profile> profile() const;
  /// One device alone, or the control, whatever the rest of the document is like.
  Result<DeviceProfile> device(const std::string& place) const;

  /// A device entry as a profile has it; its id is made unique. Returns its place.
  std::string add_device(nlohmann::json entry);
  std::string add_camera(const std::string& url);
  /// A temperature sensor with the next free channel.
  std::string add_sensor(const std::string& device, const std::string& signal);
  /// A sensor for each temperature of a Modbus device that no sensor reads yet. Returns how many.
  int add_sensors_of(const std::string& device);
  /// With a device goes what is read from it.
  void remove(const std::string& place);
  /// As it was typed: text, or a number where the key has one; nothing takes the key out. A device's new id is followed
  /// by what names it.
  void enter(const std::string& place, const std::string& key, const std::string& text);
  void set(const std::string& place, const std::string& key, const nlohmann::json& value);
  /// Another kind of control or device; what the two kinds share is kept.
  void set_kind(const std::string& place, const std::string& kind);
  /// Where a quantity or a sensor is read; without a device it is the control's.
  void assign(const std::string& place, const std::string& device, const std::string& signal);
  /// A field of a register ("address", "scale", ...) of a Modbus device or the control; its map is then a part of the
  /// profile. A negative scale turns the sign. Refused as a map's reader refuses it.
  Status set_register(const std::string& place, const std::string& name, const std::string& field,
                      const std::string& text);
  /// The map of a Modbus device or the control.
  Result<RegisterMap> map_at(const std::string& place) const;

  bool can_undo() const { return !m_before.empty(); }
  bool can_redo() const { return !m_after.empty(); }
  void undo();
  void redo();
  /// Refused as long as profile() is. Paths in it that were beside the old file lead to the same files from the new
  /// one.
  Status save(const std::filesystem::path& path);

 private:
  template <class Edit>
  void change(const Edit& edit);

  nlohmann::json m_document;
  nlohmann::json m_saved;
  std::string m_file;
  std::vector<nlohmann::json> m_before;
  std::vector<nlohmann::json> m_after;
};

/// "devices[2]" of a device's id, "controller" or the control among the devices for an empty one; empty: none.
std::string place_of_device(const nlohmann::json& document, const std::string& id);

}  // namespace zerodrift::controller

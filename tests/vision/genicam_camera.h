#pragma once
// Aravis' fake GigE Vision camera as a child process on 127.0.0.1. It has the protocol's one port: at any time only one
// runs on a machine, whichever test has it.

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace zerodrift::testing {

class GenicamCamera {
 public:
  // Registers of the fake camera (arvfakecamera.h).
  static constexpr std::uint32_t width = 0x100, height = 0x104, pixel_format = 0x128;

  /// Waits for its turn on the port. A picture of a few packets comes through on a busy computer, too.
  explicit GenicamCamera(std::vector<std::string> options = {});
  ~GenicamCamera();
  GenicamCamera(const GenicamCamera&) = delete;
  GenicamCamera& operator=(const GenicamCamera&) = delete;

  static bool installed();
  /// Answers when this returns. Pictures of 160 x 120 unless the registers are set otherwise afterwards.
  void start(const std::string& serial);
  void stop();
  /// While nobody controls the camera.
  void write_register(std::uint32_t address, std::uint32_t value) const;

 private:
  std::vector<std::string> m_options;
  int m_lock = -1;
  pid_t m_pid = -1;
};

/// Of this process, so that tests side by side do not meet each other's cameras.
std::string own_serial(const std::string& name);

}  // namespace zerodrift::testing

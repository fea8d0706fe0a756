#pragma once
// Who a camera is, how it is set and how well its pictures come through, as far as it tells. A stream over the network
// tells nothing of itself: its kind, serial number and model are empty.

#include <cstdint>
#include <optional>
#include <string>

namespace zerodrift::vision {

struct CameraIdentity {
  std::string kind;    // "gige-vision", "usb3-vision", "v4l2"; "" for a stream or a file
  std::string vendor;  // as the camera writes it
  std::string model;
  std::string serial;
  std::string address;                // IP address, or place on the USB
  std::optional<double> exposure_us;  // absent while the camera sets it by itself
  std::optional<double> gain_db;
};

struct CameraHealth {
  std::uint64_t pictures = 0;      // whole ones, since the start
  std::uint64_t incomplete = 0;    // pictures with parts missing; they are never measured with
  std::uint64_t lost = 0;          // pictures of which nothing came, by the gaps in their numbers
  std::uint64_t lost_packets = 0;  // of the network, in the incomplete pictures
  std::uint64_t resent_packets = 0;
  std::uint64_t reconnections = 0;

  bool operator==(const CameraHealth&) const = default;
};

}  // namespace zerodrift::vision

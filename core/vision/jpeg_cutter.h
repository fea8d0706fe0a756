#pragma once
// Cuts the pictures out of a stream of JPEG pictures with anything between them. It follows the markers of each picture
// from its start to its end (ITU-T T.81, annex B), and neither boundaries nor lengths that a camera writes between
// them: some leave the first boundary out, and some lengths are wrong. A picture that breaks off is no picture.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace zerodrift::vision {

class JpegCutter {
 public:
  void add(std::string_view bytes);
  /// The next whole picture, from its start marker to its end marker.
  std::optional<std::string> next();

 private:
  bool find_start();
  void drop(std::size_t count);

  std::string m_bytes;   // from the start of the picture that is followed, or what may be the beginning of one
  std::size_t m_at = 0;  // up to where it was followed; 0: no picture begun
  bool m_coded = false;  // within the coded data, where markers are looked for
};

}  // namespace zerodrift::vision

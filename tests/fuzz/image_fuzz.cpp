// Any bytes as an image file: an error or a picture whose pixels are all there.

#include <cstdint>
#include <cstdlib>
#include <span>

#include "core/vision/image_codec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const auto decoded = zerodrift::vision::decode({bytes, size}, "fuzz");
  if (!decoded) return 0;
  const auto& image = decoded->image;
  if (image.empty() || image.pixels.size() != static_cast<std::size_t>(image.width) * image.height) std::abort();
  return 0;
}

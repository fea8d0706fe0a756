#include "core/vision/image_codec.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/file.h"
#include "core/vision/image_header.h"
#include "core/vision/opencv_image.h"
#include "core/vision/png_check.h"

namespace zerodrift::vision {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t largest_file_bytes = std::size_t{256} << 20;
constexpr std::int64_t largest_image_px = 100'000'000;

bool starts_with(Bytes bytes, std::initializer_list<int> signature) {
  return bytes.size() >= signature.size() &&
         std::equal(signature.begin(), signature.end(), bytes.begin(), [](int a, std::uint8_t b) { return a == b; });
}

bool contains_near_end(Bytes bytes, std::string_view mark) {
  const Bytes tail = bytes.last(std::min<std::size_t>(bytes.size(), 4096));
  return std::search(tail.begin(), tail.end(), mark.begin(), mark.end(),
                     [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); }) != tail.end();
}

bool is_png(Bytes bytes) {
  return starts_with(bytes, {0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a});
}

// What makes these bytes unfit before a decoder is trusted with them; "" if nothing does.
std::string fault_of(Bytes bytes) {
  if (bytes.empty()) return "the file is empty";
  // Each side by itself first: sizes of 32 bits can have a product beyond 64.
  if (const auto size = claimed_size(bytes); size && (std::max(size->width, size->height) > largest_image_px ||
                                                      size->width * size->height > largest_image_px)) {
    return "the picture is larger than 100 megapixels";
  }
  if (is_png(bytes)) return "";  // looked through by itself
  if (starts_with(bytes, {0xff, 0xd8, 0xff})) {
    // A truncated JPEG decodes to half a picture and grey below: the end mark must be there.
    return contains_near_end(bytes, "\xff\xd9") ? "" : "the JPEG file ends early";
  }
  // Its decoder tells standard error of it.
  if (static_cast<std::int64_t>(bytes.size()) < claimed_bytes_of_bmp(bytes).value_or(0))
    return "the BMP file ends early";
  if (starts_with(bytes, {'B', 'M'}) || starts_with(bytes, {'I', 'I', 42, 0}) ||
      starts_with(bytes, {'M', 'M', 0, 42})) {
    return "";
  }
  return "not a PNG, JPEG, BMP or TIFF picture";
}

// Cameras of 10 and 12 bits store their values in the low bits of 16: the largest value tells.
double full_scale_of(const cv::Mat& image) {
  double largest = 0.0;
  cv::minMaxLoc(image.reshape(1), nullptr, &largest);
  for (const double scale : {1023.0, 4095.0, 16383.0}) {
    if (largest <= scale) return scale;
  }
  return 65535.0;
}

Result<DecodedImage> to_gray(cv::Mat image, const std::string& name) {
  std::string note;
  if (image.depth() == CV_16U) {
    image.convertTo(image, CV_8U, 255.0 / full_scale_of(image));
    note = "16 bits reduced to 8";
  } else if (image.depth() != CV_8U) {
    return fail(ErrorCode::image_unreadable, {{"file", name}, {"detail", "pixels are neither 8 nor 16 bits"}});
  }
  if (image.channels() == 3 || image.channels() == 4) {
    cv::cvtColor(image, image, image.channels() == 3 ? cv::COLOR_BGR2GRAY : cv::COLOR_BGRA2GRAY);
    note += note.empty() ? "colour reduced to luminance" : ", colour to luminance";
  } else if (image.channels() != 1) {
    return fail(ErrorCode::image_unreadable, {{"file", name}, {"detail", "neither grey nor colour"}});
  }
  return DecodedImage{gray_from_mat(image), note};
}

Result<std::vector<std::uint8_t>> encode(const GrayImage& image, const char* extension,
                                         const std::vector<int>& parameters) {
  if (image.empty()) return fail(ErrorCode::internal, {{"detail", "an empty image was to be encoded"}});
  try {
    std::vector<std::uint8_t> bytes;
    if (cv::imencode(extension, mat_view(image), bytes, parameters)) return bytes;
  } catch (const cv::Exception& problem) {
    return fail(ErrorCode::internal, {{"detail", problem.err}});
  }
  return fail(ErrorCode::internal, {{"detail", std::string("the encoder for ") + extension + " failed"}});
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_jpeg(const GrayImage& image, int quality) {
  return encode(image, ".jpg", {cv::IMWRITE_JPEG_QUALITY, std::clamp(quality, 1, 100)});
}

Result<std::vector<std::uint8_t>> encode_png(const GrayImage& image) {
  return encode(image, ".png", {cv::IMWRITE_PNG_COMPRESSION, 1});
}

Result<DecodedImage> decode(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (const std::string fault = fault_of(bytes); !fault.empty()) {
    return fail(ErrorCode::image_unreadable, {{"file", name}, {"detail", fault}});
  }
  PlainPng png;
  if (is_png(bytes)) {
    png = plain_png(bytes);
    if (!png.fault.empty()) return fail(ErrorCode::image_unreadable, {{"file", name}, {"detail", png.fault}});
    bytes = png.bytes;
  }
  try {
    const cv::Mat wrapped(1, static_cast<int>(bytes.size()), CV_8U, const_cast<std::uint8_t*>(bytes.data()));
    cv::Mat image = cv::imdecode(wrapped, cv::IMREAD_UNCHANGED);
    if (!image.empty()) return to_gray(std::move(image), name);
  } catch (const cv::Exception& problem) {
    return fail(ErrorCode::image_unreadable, {{"file", name}, {"detail", problem.err}});
  }
  return fail(ErrorCode::image_unreadable, {{"file", name}, {"detail", "the picture is damaged"}});
}

Result<DecodedImage> read_image(const std::filesystem::path& path) {
  ZD_TRY(const std::string bytes, read_file(path, largest_file_bytes));
  return decode({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, path.string());
}

Status write_png(const std::filesystem::path& path, const GrayImage& image) {
  ZD_TRY(const std::vector<std::uint8_t> bytes, encode_png(image));
  return write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace zerodrift::vision

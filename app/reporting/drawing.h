#pragma once
// A report drawn bit by bit. Its plots are widgets, which live on the window's thread alone: between two bits the
// window does what it has to do.

#include <QImage>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/report/report.h"

class QPagedPaintDevice;

namespace zerodrift::reporting {

class Drawing {
 public:
  virtual ~Drawing() = default;
  /// The next bit, a block of the report; false when that was the last, an error when it failed. Not to be called again
  /// after either.
  virtual Result<bool> step() = 0;
};

std::unique_ptr<Drawing> pdf_drawing(report::Report report, const std::filesystem::path& path);
std::unique_ptr<Drawing> html_drawing(report::Report report, const std::filesystem::path& path);
/// On the paper of a printer, or of another device with pages of A4 without margins.
std::unique_ptr<Drawing> print_drawing(report::Report report, std::unique_ptr<QPagedPaintDevice> device);
/// By the file's extension: .pdf, .html or .csv; another is wrong_format. The file is there, whole, with the last bit.
Result<std::unique_ptr<Drawing>> drawing_of(report::Report report, const std::filesystem::path& path);

/// The pages of the PDF as pictures, for looking at before saving.
class PagePictures : public Drawing {
 public:
  PagePictures(report::Report report, int width_px);
  ~PagePictures() override;
  Result<bool> step() override;
  std::vector<QImage> pages() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> m_inside;
};

/// All bits at once.
Status draw(Drawing& drawing);

}  // namespace zerodrift::reporting

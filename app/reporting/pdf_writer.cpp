#include <QBuffer>
#include <QHashSeed>
#include <QPageLayout>
#include <QPdfWriter>
#include <deque>

#include "app/reporting/paper.h"
#include "app/reporting/pdf_finish.h"
#include "app/reporting/writers.h"
#include "core/base/file.h"
#include "ui/plots/report_plot.h"

namespace zerodrift::reporting {
namespace {

QSizeF a4() {
  return QPageSize(QPageSize::A4).size(QPageSize::Inch) * 96.0;
}

/// Fonts of a PDF stand in the order of a hash table, whose order is drawn anew in each process: not in here.
class FixedOrder {
 public:
  FixedOrder() { QHashSeed::setDeterministicGlobalSeed(); }
  ~FixedOrder() { QHashSeed::resetRandomGlobalSeed(); }
  FixedOrder(const FixedOrder&) = delete;
  FixedOrder& operator=(const FixedOrder&) = delete;
};

/// Where everything stands, found without drawing.
Paper measured(const report::Report& report) {
  Paper paper(
      a4(), nullptr, [] {}, report);
  paper.write();
  return paper;
}

}  // namespace

Status write_pdf(const report::Report& report, const std::filesystem::path& path) {
  const FixedOrder fixed_order;
  const Paper places = measured(report);
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  PdfMarks marks;
  {
    QPdfWriter device(&buffer);
    device.setPageSize(QPageSize(QPageSize::A4));
    device.setPageMargins(QMarginsF(0, 0, 0, 0));
    device.setResolution(1200);
    device.setTitle(QString::fromStdString(report.title));
    device.setCreator(QStringLiteral("Zerodrift " ZERODRIFT_VERSION));
    const auto painter = ui::makeVectorPainter(&device);
    const double scale = device.resolution() / 96.0;
    painter->scale(scale, scale);
    Paper paper(
        {device.width() / scale, device.height() / scale}, painter.get(), [&device] { device.newPage(); }, report);
    paper.write(places.outline(), places.pages());
    marks.outline = paper.outline();
    marks.links = paper.links();
  }
  marks.language = report.language;
  marks.made_utc = report.made_utc;
  ZD_TRY(const std::string finished,
         finished_pdf({bytes.constData(), static_cast<std::size_t>(bytes.size())}, marks, path));
  return write_file(path, finished);
}

std::vector<QImage> preview_pages(const report::Report& report, int width_px) {
  const QSizeF size = a4();
  const double scale = width_px / size.width();
  std::deque<QImage> pages;  // stay where they are while painted on
  const auto blank = [&]() -> QImage& {
    QImage& page = pages.emplace_back((size * scale).toSize(), QImage::Format_RGB32);
    page.fill(Qt::white);
    return page;
  };
  const auto painter = ui::makeVectorPainter(&blank());
  const auto prepare = [&] {
    painter->setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing | QPainter::SmoothPixmapTransform);
    painter->scale(scale, scale);
  };
  prepare();
  const auto next = [&] {
    painter->end();
    painter->begin(&blank());
    prepare();
  };
  const Paper places = measured(report);
  Paper(size, painter.get(), next, report).write(places.outline(), places.pages());
  painter->end();
  return {pages.begin(), pages.end()};
}

}  // namespace zerodrift::reporting

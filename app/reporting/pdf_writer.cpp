#include <QBuffer>
#include <QHashSeed>
#include <QPageLayout>
#include <QPdfWriter>
#include <deque>
#include <memory>

#include "app/reporting/drawing.h"
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

/// The whole report twice: once to find where everything stands, once to draw it.
class Pages {
 public:
  explicit Pages(const report::Report& report) : m_report(report) {
    m_places = std::make_unique<Paper>(
        a4(), nullptr, [] {}, report);
    m_places->begin();
  }
  /// False when the next thing to do is to draw.
  bool find_places() { return m_places->step(); }
  Paper& begin(const QSizeF& size, QPainter* painter, std::function<void()> next) {
    m_drawn = std::make_unique<Paper>(size, painter, std::move(next), m_report);
    m_drawn->begin(m_places->outline(), m_places->pages());
    return *m_drawn;
  }

 private:
  const report::Report& m_report;
  std::unique_ptr<Paper> m_places;
  std::unique_ptr<Paper> m_drawn;
};

class PdfDrawing : public Drawing {
 public:
  PdfDrawing(report::Report report, std::filesystem::path path)
      : m_report(std::move(report)), m_path(std::move(path)), m_pages(m_report) {}

  Result<bool> step() override {
    const FixedOrder fixed_order;
    if (m_paper == nullptr) {
      if (m_pages.find_places()) return true;
      open();
      return true;
    }
    if (m_painter != nullptr) {
      if (!m_paper->step()) close();
      return true;
    }
    if (m_finished.empty()) {
      ZD_TRY(m_finished,
             finished_pdf({m_bytes.constData(), static_cast<std::size_t>(m_bytes.size())}, m_marks, m_path));
      return true;
    }
    ZD_CHECK(write_file(m_path, m_finished));
    return false;
  }

 private:
  void open() {
    m_buffer.open(QIODevice::WriteOnly);
    m_device = std::make_unique<QPdfWriter>(&m_buffer);
    m_device->setPageSize(QPageSize(QPageSize::A4));
    m_device->setPageMargins(QMarginsF(0, 0, 0, 0));
    m_device->setResolution(1200);
    m_device->setTitle(QString::fromStdString(m_report.title));
    m_device->setCreator(QStringLiteral("Zerodrift " ZERODRIFT_VERSION));
    m_painter = ui::makeVectorPainter(m_device.get());
    const double scale = m_device->resolution() / 96.0;
    m_painter->scale(scale, scale);
    m_paper = &m_pages.begin({m_device->width() / scale, m_device->height() / scale}, m_painter.get(),
                             [this] { m_device->newPage(); });
  }
  void close() {
    m_painter.reset();
    m_device.reset();
    m_marks.outline = m_paper->outline();
    m_marks.links = m_paper->links();
    m_marks.language = m_report.language;
    m_marks.made_utc = m_report.made_utc;
  }

  report::Report m_report;
  std::filesystem::path m_path;
  Pages m_pages;
  Paper* m_paper = nullptr;  // from when it is drawn
  QByteArray m_bytes;
  QBuffer m_buffer{&m_bytes};
  std::unique_ptr<QPdfWriter> m_device;
  ui::VectorPainter m_painter;  // ends before its device
  PdfMarks m_marks;
  std::string m_finished;
};

}  // namespace

Status write_pdf(const report::Report& report, const std::filesystem::path& path) {
  return draw(*pdf_drawing(report, path));
}

std::unique_ptr<Drawing> pdf_drawing(report::Report report, const std::filesystem::path& path) {
  return std::make_unique<PdfDrawing>(std::move(report), path);
}

namespace {

class PrintDrawing : public Drawing {
 public:
  PrintDrawing(report::Report report, std::unique_ptr<QPagedPaintDevice> device)
      : m_report(std::move(report)), m_pages(m_report), m_device(std::move(device)) {}

  Result<bool> step() override {
    if (m_paper == nullptr) {
      if (!m_pages.find_places()) open();
      return true;
    }
    if (m_paper->step()) return true;
    m_painter.reset();
    m_device.reset();
    return false;
  }

 private:
  void open() {
    m_painter = ui::makeVectorPainter(m_device.get());
    const double scale = m_device->logicalDpiX() / 96.0;
    m_painter->scale(scale, scale);
    m_paper = &m_pages.begin(a4(), m_painter.get(), [this] { m_device->newPage(); });
  }

  report::Report m_report;
  Pages m_pages;
  Paper* m_paper = nullptr;
  std::unique_ptr<QPagedPaintDevice> m_device;
  ui::VectorPainter m_painter;  // ends before its device
};

}  // namespace

std::unique_ptr<Drawing> print_drawing(report::Report report, std::unique_ptr<QPagedPaintDevice> device) {
  return std::make_unique<PrintDrawing>(std::move(report), std::move(device));
}

struct PagePictures::Inside {
  report::Report report;
  double scale;
  Pages places{report};
  Paper* paper = nullptr;
  std::deque<QImage> pages = {};  // stay where they are while painted on
  ui::VectorPainter painter = {};

  QImage& blank() {
    QImage& page = pages.emplace_back((a4() * scale).toSize(), QImage::Format_RGB32);
    page.fill(Qt::white);
    return page;
  }
  void prepare() {
    painter->setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing | QPainter::SmoothPixmapTransform);
    painter->scale(scale, scale);
  }
};

PagePictures::PagePictures(report::Report report, int width_px)
    : m_inside(new Inside{std::move(report), width_px / a4().width()}) {}

PagePictures::~PagePictures() = default;

Result<bool> PagePictures::step() {
  Inside& in = *m_inside;
  if (in.paper != nullptr) {
    if (in.paper->step()) return true;
    in.painter->end();
    return false;
  }
  if (in.places.find_places()) return true;
  in.painter = ui::makeVectorPainter(&in.blank());
  in.prepare();
  in.paper = &in.places.begin(a4(), in.painter.get(), [&in] {
    in.painter->end();
    in.painter->begin(&in.blank());
    in.prepare();
  });
  return true;
}

std::vector<QImage> PagePictures::pages() const {
  return {m_inside->pages.begin(), m_inside->pages.end()};
}

}  // namespace zerodrift::reporting

#include <QBuffer>
#include <QFontMetricsF>
#include <QPageLayout>
#include <QPdfWriter>
#include <QTextLayout>
#include <cmath>
#include <deque>
#include <functional>

#include "app/reporting/plot_data.h"
#include "app/reporting/writers.h"
#include "core/base/file.h"

namespace zerodrift::reporting {
namespace {

// Logical units are 1/96 inch. A4 with margins of 18 mm.
constexpr double margin = 68.0;
constexpr double foot_height = 28.0;
constexpr double gap = 12.0;
constexpr double card_padding = 14.0;  // left and right of a figure's text

QString text_of(const std::string& text) {
  return QString::fromStdString(text);
}

QFont font_of(int pixels, QFont::Weight weight = QFont::Normal) {
  QFont font;
  font.setFamilies({QStringLiteral("Inter"), QStringLiteral("Noto Sans CJK SC"), QStringLiteral("DejaVu Sans")});
  font.setPixelSize(pixels);
  font.setWeight(weight);
  font.setHintingPreference(QFont::PreferNoHinting);
  // Glyphs that only a font's features can choose (a hyphen between figures, say) have no character: they would be lost
  // when text is copied.
  font.setStyleStrategy(QFont::PreferNoShaping);
  return font;
}

QColor colour_of(report::Verdict verdict) {
  switch (verdict) {
    case report::Verdict::good:
      return QColor(0x2E8B57);
    case report::Verdict::doubtful:
      return QColor(0xC77700);
    case report::Verdict::bad:
      return QColor(0xC4314B);
    case report::Verdict::none:
      break;
  }
  return QColor(0xD9DFE5);
}

/// Lays blocks one under the other and breaks pages; a block that fits on a page is never cut.
class PaperWriter {
 public:
  /// `size` of a page in logical units; the painter is scaled to them, also after new_page.
  PaperWriter(const QSizeF& size, std::function<void()> new_page, QPainter& painter, const report::Report& report)
      : m_next(std::move(new_page)), m_painter(painter), m_report(report) {
    m_width = size.width() - 2 * margin;
    m_bottom = size.height() - margin - foot_height;
    m_height = size.height();
  }

  void write() {
    title();
    for (const auto& section : m_report.sections) {
      heading(text_of(section.title));
      for (const auto& block : section.blocks) std::visit(*this, block);
    }
    signature();
    footer();
  }

  void operator()(const report::Text& text) {
    const double indent = text.warning ? 12 : 0;
    const double height = paragraph_height(text_of(text.text), font_of(12), m_width - indent);
    room_for(height + gap);
    if (text.warning) m_painter.fillRect(QRectF(margin, m_y, 3, height), colour_of(text.verdict));
    draw_text(QRectF(margin + indent, m_y, m_width - indent, height), text_of(text.text), font_of(12));
    m_y += height + gap;
  }

  void operator()(const report::Figures& figures) {
    const auto count = figures.figures.size();
    const std::size_t per_row = count % 4 != 0 && count % 3 == 0 ? 3 : 4;
    const double width = (m_width - static_cast<double>(per_row - 1) * gap) / static_cast<double>(per_row);
    for (std::size_t first = 0; first < count; first += per_row) {
      const std::size_t end = std::min(count, first + per_row);
      // As high as the longest of its labels needs.
      double label = 0;
      for (std::size_t i = first; i < end; ++i) {
        label = std::max(label, paragraph_height(text_of(figures.figures[i].label), font_of(10), width - card_padding));
      }
      const double height = label + 48;
      room_for(height + gap);
      for (std::size_t i = first; i < end; ++i) {
        const double left = margin + static_cast<double>(i - first) * (width + gap);
        figure_card(QRectF(left, m_y, width, height), label, figures.figures[i]);
      }
      m_y += height + gap;
    }
  }

  void operator()(const report::Table& table) {
    room_for(60);
    label(text_of(table.title));
    const auto widths = column_widths(table);
    table_row(table.header, widths, true);
    for (const auto& row : table.rows) {
      if (m_y + row_height(row, widths) > m_bottom) {
        new_page();
        table_row(table.header, widths, true);
      }
      table_row(row, widths, false);
    }
    m_y += gap;
  }

  void operator()(const report::Plot& plot) {
    constexpr double height = 240;
    room_for(height + 30 + gap);
    label(text_of(plot.title));
    ui::drawReportPlot(m_painter, QRectF(margin, m_y, m_width, height), plot_data(plot));
    m_y += height + gap;
  }

 private:
  void signature() {
    QImage drawn;
    if (m_report.signature_png.empty() ||
        !drawn.loadFromData(reinterpret_cast<const uchar*>(m_report.signature_png.data()),
                            static_cast<int>(m_report.signature_png.size()))) {
      return;
    }
    constexpr double height = 64;
    room_for(height + 30);
    m_painter.drawImage(QRectF(margin, m_y, height * drawn.width() / std::max(1, drawn.height()), height), drawn);
    m_y += height;
    m_painter.fillRect(QRectF(margin, m_y, 260, 0.8), QColor(0x5F6E7C));
    m_y += gap;
  }

  void title() {
    draw_text(QRectF(margin, m_y, m_width, 34), text_of(m_report.title), font_of(24, QFont::DemiBold));
    m_y += 40;
    for (const auto& [name, value] : m_report.header) {
      draw_text(QRectF(margin, m_y, 140, 18), text_of(name), font_of(12), QColor(0x5F6E7C));
      draw_text(QRectF(margin + 140, m_y, m_width - 140, 18), text_of(value), font_of(12));
      m_y += 18;
    }
    m_y += gap;
  }

  void heading(const QString& text) {
    room_for(150);  // never a heading alone at the foot of a page
    m_y += 8;
    draw_text(QRectF(margin, m_y, m_width, 24), text, font_of(17, QFont::DemiBold));
    m_y += 26;
    m_painter.fillRect(QRectF(margin, m_y, m_width, 0.8), QColor(0xD9DFE5));
    m_y += 8;
  }

  void label(const QString& text) {
    if (text.isEmpty()) return;
    draw_text(QRectF(margin, m_y, m_width, 18), text, font_of(12, QFont::DemiBold));
    m_y += 20;
  }

  void figure_card(const QRectF& place, double label_height, const report::Figure& figure) {
    m_painter.setPen(QPen(QColor(0xD9DFE5), 0.8));
    m_painter.setBrush(Qt::NoBrush);
    m_painter.drawRoundedRect(place, 4, 4);
    if (figure.verdict != report::Verdict::none) {
      m_painter.fillRect(QRectF(place.left(), place.top() + 4, 3, place.height() - 8), colour_of(figure.verdict));
    }
    const QRectF inner = place.adjusted(10, 5, 10 - card_padding, -4);
    draw_text(QRectF(inner.left(), inner.top(), inner.width(), label_height), text_of(figure.label), font_of(10),
              QColor(0x5F6E7C));
    const double below = inner.top() + label_height;
    const QString value = text_of(figure.value);
    draw_text(QRectF(inner.left(), below, inner.width(), 24), value, font_of(18, QFont::DemiBold));
    const double used = QFontMetricsF(font_of(18, QFont::DemiBold)).horizontalAdvance(value);
    draw_text(QRectF(inner.left() + used + 5, below + 7, inner.width() - used, 14), text_of(figure.unit), font_of(11),
              QColor(0x5F6E7C));
    draw_text(QRectF(inner.left(), below + 24, inner.width(), 14), text_of(figure.limit), font_of(10),
              QColor(0x5F6E7C));
  }

  std::vector<double> column_widths(const report::Table& table) const {
    const QFontMetricsF metrics(font_of(10));
    std::vector<double> widths;
    for (const auto& cell : table.header) widths.push_back(metrics.horizontalAdvance(text_of(cell)) + 14);
    for (const auto& row : table.rows) {
      for (std::size_t c = 0; c < std::min(row.size(), widths.size()); ++c) {
        widths[c] = std::max(widths[c], std::min(metrics.horizontalAdvance(text_of(row[c])) + 14, m_width * 0.6));
      }
    }
    double sum = 0;
    for (const double w : widths) sum += w;
    for (double& w : widths) w *= m_width / sum;
    return widths;
  }

  double row_height(const std::vector<std::string>& cells, const std::vector<double>& widths) const {
    double height = 14;
    for (std::size_t c = 0; c < std::min(cells.size(), widths.size()); ++c) {
      height = std::max(height, paragraph_height(text_of(cells[c]), font_of(10), widths[c] - 8));
    }
    return height + 4;
  }

  void table_row(const std::vector<std::string>& cells, const std::vector<double>& widths, bool is_header) {
    const double height = row_height(cells, widths);
    double x = margin;
    for (std::size_t c = 0; c < std::min(cells.size(), widths.size()); ++c) {
      draw_text(QRectF(x, m_y + 2, widths[c] - 8, height), text_of(cells[c]),
                font_of(10, is_header ? QFont::DemiBold : QFont::Normal),
                is_header ? QColor(0x5F6E7C) : QColor(0x1C2530));
      x += widths[c];
    }
    m_y += height;
    m_painter.fillRect(QRectF(margin, m_y, m_width, is_header ? 0.8 : 0.4), QColor(0xD9DFE5));
  }

  double paragraph_height(const QString& text, const QFont& font, double width) const {
    const QRectF bounds =
        QFontMetricsF(font).boundingRect(QRectF(0, 0, width, 1e5), Qt::TextWordWrap | Qt::AlignLeft, text);
    return std::ceil(bounds.height());
  }

  void draw_text(const QRectF& place, const QString& text, const QFont& font, const QColor& colour = QColor(0x1C2530)) {
    m_painter.setFont(font);
    m_painter.setPen(colour);
    m_painter.drawText(place, Qt::TextWordWrap | Qt::AlignLeft | Qt::AlignTop, text);
  }

  void room_for(double height) {
    if (m_y + height > m_bottom && m_y > margin + 1) new_page();
  }

  void new_page() {
    footer();
    m_next();
    ++m_page;
    m_y = margin;
  }

  void footer() {
    const double y = m_height - margin;
    m_painter.fillRect(QRectF(margin, y - 4, m_width, 0.5), QColor(0xD9DFE5));
    draw_text(QRectF(margin, y, m_width - 60, 14), text_of(m_report.provenance), font_of(9), QColor(0x5F6E7C));
    m_painter.setFont(font_of(9));
    m_painter.drawText(QRectF(margin, y, m_width, 14), Qt::AlignRight, QString::number(m_page));
  }

  std::function<void()> m_next;
  QPainter& m_painter;
  const report::Report& m_report;
  double m_width = 0;
  double m_bottom = 0;
  double m_height = 0;
  double m_y = margin;
  int m_page = 1;
};

}  // namespace

Status write_pdf(const report::Report& report, const std::filesystem::path& path) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  {
    QPdfWriter device(&buffer);
    device.setPageSize(QPageSize(QPageSize::A4));
    device.setPageMargins(QMarginsF(0, 0, 0, 0));
    device.setResolution(1200);
    device.setTitle(text_of(report.title));
    device.setCreator(QStringLiteral("Zerodrift " ZERODRIFT_VERSION));
    const auto painter = ui::makeVectorPainter(&device);
    const double scale = device.resolution() / 96.0;
    painter->scale(scale, scale);
    PaperWriter(
        {device.width() / scale, device.height() / scale}, [&device] { device.newPage(); }, *painter, report)
        .write();
  }
  return write_file(path, std::string_view(bytes.constData(), static_cast<std::size_t>(bytes.size())));
}

std::vector<QImage> preview_pages(const report::Report& report, int width_px) {
  const QSizeF size = QPageSize(QPageSize::A4).size(QPageSize::Inch) * 96.0;
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
  PaperWriter(size, next, *painter, report).write();
  painter->end();
  return {pages.begin(), pages.end()};
}

}  // namespace zerodrift::reporting

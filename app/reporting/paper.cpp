#include "app/reporting/paper.h"

#include <QFontMetricsF>
#include <QImage>
#include <cmath>

#include "app/reporting/plot_data.h"

namespace zerodrift::reporting {
namespace {

// Logical units are 1/96 inch. A4 with margins of 18 mm.
constexpr double margin = 68.0;
constexpr double foot_height = 28.0;
constexpr double gap = 12.0;
constexpr double company_width = 200.0;
constexpr double card_padding = 14.0;  // left and right of a figure's text
constexpr double cell_gap = 14.0;      // between the columns of a table
constexpr double plot_height = 232.0;
constexpr double half_height = 176.0;
const QColor muted_ink(0x5F6E7C);
const QColor line_ink(0xD9DFE5);

QString paper_text(const std::string& text) {
  return QString::fromStdString(text);
}

QFont paper_font(int pixels, QFont::Weight weight = QFont::Normal) {
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

QColor verdict_ink(report::Verdict verdict) {
  switch (verdict) {
    case report::Verdict::good:
      return {0x2E, 0x8B, 0x57};
    case report::Verdict::doubtful:
      return {0xC7, 0x77, 0x00};
    case report::Verdict::bad:
      return {0xC4, 0x31, 0x4B};
    case report::Verdict::none:
      break;
  }
  return line_ink;
}

double text_height(const QString& text, const QFont& font, double width) {
  const QRectF bounds =
      QFontMetricsF(font).boundingRect(QRectF(0, 0, width, 1e5), Qt::TextWordWrap | Qt::AlignLeft, text);
  return std::ceil(bounds.height());
}

/// Columns of numbers: they stand under one another at the right, their heading with them.
std::vector<bool> number_columns(const report::Table& table) {
  std::vector<bool> out(table.header.size(), !table.rows.empty());
  if (!out.empty()) out.front() = false;  // names the row
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < std::min(row.size(), out.size()); ++c) {
      if (row[c].text.find_first_not_of("+-.0123456789") != std::string::npos) out[c] = false;
    }
  }
  return out;
}

}  // namespace

Paper::Paper(const QSizeF& size, QPainter* painter, std::function<void()> next_page, const report::Report& report)
    : m_painter(painter), m_next(std::move(next_page)), m_report(report), m_y(margin) {
  m_width = size.width() - 2 * margin;
  m_bottom = size.height() - margin - foot_height;
  m_height = size.height();
}

void Paper::begin(std::vector<PaperOutline> outline, int pages) {
  m_pages = pages;
  const auto part = [this](std::function<void()> write) { m_parts.push_back(std::move(write)); };
  part([this] { title(); });
  for (std::size_t i = 0; i < m_report.sections.size(); ++i) {
    const auto& section = m_report.sections[i];
    part([this, &section] { heading(paper_text(section.title)); });
    plan_blocks(section);
    // The first page is the customer's alone.
    if (i == 0 && !m_report.contents.empty() && m_report.sections.size() > 1) {
      part([this, outline = std::move(outline)] {
        if (!m_report.signature_png.empty()) signature();
        new_page();
        contents(outline);
      });
    }
  }
  part([this] {
    if (m_report.contents.empty() || m_report.sections.size() < 2) signature();
    footer();
  });
}

bool Paper::step() {
  if (!m_plots.empty()) {
    if (!m_plots.front()->step(*m_painter)) m_plots.pop_front();
    return true;
  }
  if (m_next_part >= m_parts.size()) return false;
  m_parts[m_next_part++]();
  return true;
}

void Paper::plan_blocks(const report::Section& section) {
  const report::Plot* waiting = nullptr;
  const auto halves = [this](const report::Plot* left, const report::Plot* right) {
    m_parts.emplace_back([this, left, right] { half_plots(*left, right); });
  };
  for (const auto& block : section.blocks) {
    const auto* plot = std::get_if<report::Plot>(&block);
    const bool half = plot != nullptr && plot->width == report::Width::half;
    if (half && waiting != nullptr) {
      halves(waiting, plot);
      waiting = nullptr;
      continue;
    }
    if (waiting != nullptr) halves(waiting, nullptr);
    waiting = half ? plot : nullptr;
    if (!half) m_parts.emplace_back([this, &block] { std::visit(*this, block); });
  }
  if (waiting != nullptr) halves(waiting, nullptr);
}

void Paper::operator()(const report::Text& text) {
  const double indent = text.warning ? 12 : 0;
  const double height = text_height(paper_text(text.text), paper_font(12), m_width - indent);
  room_for(height + gap);
  if (text.warning) fill(QRectF(margin, m_y, 3, height), verdict_ink(text.verdict));
  draw_text(QRectF(margin + indent, m_y, m_width - indent, height), paper_text(text.text), paper_font(12));
  m_y += height + gap;
}

void Paper::operator()(const report::Figures& figures) {
  const auto count = figures.figures.size();
  const std::size_t per_row = count % 4 != 0 && count % 3 == 0 ? 3 : 4;
  const double width = (m_width - static_cast<double>(per_row - 1) * gap) / static_cast<double>(per_row);
  for (std::size_t first = 0; first < count; first += per_row) {
    const std::size_t end = std::min(count, first + per_row);
    // As high as the longest of its texts needs.
    double names = 0;
    double limits = 0;
    for (std::size_t i = first; i < end; ++i) {
      const auto& one = figures.figures[i];
      names = std::max(names, text_height(paper_text(one.label), paper_font(10), width - card_padding));
      if (one.limit.empty()) continue;
      limits = std::max(limits, text_height(paper_text(one.limit), paper_font(10), width - card_padding));
    }
    const double height = names + limits + 36;
    room_for(height + gap);
    for (std::size_t i = first; i < end; ++i) {
      const double left = margin + static_cast<double>(i - first) * (width + gap);
      figure_card(QRectF(left, m_y, width, height), names, limits, figures.figures[i]);
    }
    m_y += height + gap;
  }
}

void Paper::operator()(const report::Table& table) {
  const auto widths = column_widths(table);
  const auto numbers = number_columns(table);
  const std::vector<report::Cell> header(table.header.begin(), table.header.end());
  double first = text_height(paper_text(table.title), paper_font(12, QFont::DemiBold), m_width) + 4;
  first += row_height(header, widths);
  if (!table.rows.empty()) first += row_height(table.rows.front(), widths);
  if (table.rows.size() > 1) first += row_height(table.rows[1], widths);
  room_for(first);
  label(paper_text(table.title), margin, m_width);
  table_row(header, widths, numbers, true);
  for (const auto& row : table.rows) {
    if (m_y + row_height(row, widths) > m_bottom) {
      new_page();
      table_row(header, widths, numbers, true);
    }
    table_row(row, widths, numbers, false);
  }
  m_y += gap;
}

void Paper::operator()(const report::Plot& plot) {
  room_for(plot_height + 20 + gap);
  label(paper_text(plot.title), margin, m_width);
  draw_plot(QRectF(margin, m_y, m_width, plot_height), plot);
  m_y += plot_height + gap;
}

void Paper::operator()(const report::HeatMap& map) {
  room_for(plot_height + 20 + gap);
  label(paper_text(map.title), margin, m_width);
  if (m_painter != nullptr) {
    ui::drawReportMap(*m_painter, QRectF(margin, m_y, m_width, plot_height), map_data(map));
  }
  m_y += plot_height + gap;
}

void Paper::draw_plot(const QRectF& place, const report::Plot& plot) {
  if (m_painter != nullptr) m_plots.push_back(std::make_unique<ui::ReportPlotDrawing>(place, plot_data(plot)));
}

void Paper::half_plots(const report::Plot& left, const report::Plot* right) {
  const double width = 0.5 * (m_width - gap);
  double title_height = 20;
  for (const auto* plot : {&left, right}) {
    if (plot == nullptr) continue;
    title_height =
        std::max(title_height, text_height(paper_text(plot->title), paper_font(12, QFont::DemiBold), width) + 4);
  }
  room_for(half_height + title_height + gap);
  const double top = m_y;
  double x = margin;
  for (const auto* plot : {&left, right}) {
    if (plot == nullptr) continue;
    m_y = top;
    label(paper_text(plot->title), x, width);
    draw_plot(QRectF(x, top + title_height, width, half_height), *plot);
    x += width + gap;
  }
  m_y = top + title_height + half_height + gap;
}

void Paper::signature() {
  QImage drawn;
  if (m_report.signature_png.empty() ||
      !drawn.loadFromData(reinterpret_cast<const uchar*>(m_report.signature_png.data()),
                          static_cast<int>(m_report.signature_png.size()))) {
    return;
  }
  constexpr double height = 64;
  room_for(height + 30);
  if (m_painter != nullptr) {
    m_painter->drawImage(QRectF(margin, m_y, height * drawn.width() / std::max(1, drawn.height()), height), drawn);
  }
  m_y += height;
  fill(QRectF(margin, m_y, 260, 0.8), muted_ink);
  m_y += gap;
}

void Paper::title() {
  const double company_end = company();
  const double width = company_end > m_y ? m_width - company_width - gap : m_width;
  const double height = std::max(34.0, text_height(paper_text(m_report.title), paper_font(24, QFont::DemiBold), width));
  draw_text(QRectF(margin, m_y, width, height), paper_text(m_report.title), paper_font(24, QFont::DemiBold));
  m_y += height + 6;
  for (const auto& [name, value] : m_report.header) {
    const double line = std::max(18.0, text_height(paper_text(value), paper_font(12), width - 140));
    draw_text(QRectF(margin, m_y, 136, 18), paper_text(name), paper_font(12), muted_ink);
    draw_text(QRectF(margin + 140, m_y, width - 140, line), paper_text(value), paper_font(12));
    m_y += line;
  }
  m_y = std::max(m_y, company_end) + gap;
}

/// Logo and address of who made the report, at the right of the title; where they end.
double Paper::company() {
  constexpr double logo_height = 48;
  const double left = margin + m_width - company_width;
  double y = m_y;
  QImage logo;
  if (!m_report.logo_png.empty() && logo.loadFromData(reinterpret_cast<const uchar*>(m_report.logo_png.data()),
                                                      static_cast<int>(m_report.logo_png.size()), "PNG")) {
    const QSizeF size = QSizeF(logo.size()).scaled(company_width, logo_height, Qt::KeepAspectRatio);
    if (m_painter != nullptr) {
      m_painter->drawImage(QRectF(margin + m_width - size.width(), y, size.width(), size.height()), logo);
    }
    y += size.height() + 6;
  }
  for (const auto& line : m_report.company) {
    const double height = text_height(paper_text(line), paper_font(11), company_width);
    draw_text(QRectF(left, y, company_width, height), paper_text(line), paper_font(11), muted_ink, Qt::AlignRight);
    y += height;
  }
  return y;
}

void Paper::contents(const std::vector<PaperOutline>& outline) {
  draw_text(QRectF(margin, m_y, m_width, 24), paper_text(m_report.contents), paper_font(17, QFont::DemiBold));
  m_y += 30;
  for (std::size_t i = 0; i < m_report.sections.size(); ++i) {
    const QRectF line(margin, m_y, m_width, 18);
    draw_text(line, paper_text(m_report.sections[i].title), paper_font(12), QColor(0x0F6CBD));
    if (i < outline.size()) {
      draw_text(line, QString::number(outline[i].at.page + 1), paper_font(12), muted_ink, Qt::AlignRight);
      m_links.push_back({m_page, line, outline[i].at});
    }
    m_y += 18;
  }
  m_y += gap;
}

void Paper::heading(const QString& text) {
  room_for(150);  // never a heading alone at the foot of a page
  m_y += 8;
  m_outline.push_back({text, {m_page, m_y}});
  draw_text(QRectF(margin, m_y, m_width, 24), text, paper_font(17, QFont::DemiBold));
  m_y += 26;
  fill(QRectF(margin, m_y, m_width, 0.8), line_ink);
  m_y += 8;
}

void Paper::label(const QString& text, double left, double width) {
  if (text.isEmpty()) return;
  const double height = text_height(text, paper_font(12, QFont::DemiBold), width);
  draw_text(QRectF(left, m_y, width, height), text, paper_font(12, QFont::DemiBold));
  m_y += height + 4;
}

void Paper::figure_card(const QRectF& place, double label_height, double limit_height, const report::Figure& figure) {
  if (m_painter == nullptr) return;
  m_painter->setPen(QPen(line_ink, 0.8));
  m_painter->setBrush(Qt::NoBrush);
  m_painter->drawRoundedRect(place, 4, 4);
  if (figure.verdict != report::Verdict::none) {
    fill(QRectF(place.left(), place.top() + 4, 3, place.height() - 8), verdict_ink(figure.verdict));
  }
  const QRectF inner = place.adjusted(10, 5, 10 - card_padding, -4);
  draw_text(QRectF(inner.left(), inner.top(), inner.width(), label_height), paper_text(figure.label), paper_font(10),
            muted_ink);
  const double below = inner.top() + label_height;
  const QString value = paper_text(figure.value);
  draw_text(QRectF(inner.left(), below, inner.width(), 24), value, paper_font(18, QFont::DemiBold));
  const double used = QFontMetricsF(paper_font(18, QFont::DemiBold)).horizontalAdvance(value);
  draw_text(QRectF(inner.left() + used + 5, below + 7, inner.width() - used, 14), paper_text(figure.unit),
            paper_font(11), muted_ink);
  draw_text(QRectF(inner.left(), below + 24, inner.width(), limit_height), paper_text(figure.limit), paper_font(10),
            muted_ink);
}

std::vector<double> Paper::column_widths(const report::Table& table) const {
  const QFontMetricsF metrics(paper_font(10));
  const QFontMetricsF bold(paper_font(10, QFont::DemiBold));
  constexpr double padding = 20.0;
  std::vector<double> wanted;
  std::vector<double> least;  // the longest word: narrower would cut it
  for (const auto& cell : table.header) {
    double word = 0.0;
    for (const auto& part : paper_text(cell).split(QLatin1Char(' ')))
      word = std::max(word, bold.horizontalAdvance(part));
    least.push_back(word + padding);
    wanted.push_back(std::min(bold.horizontalAdvance(paper_text(cell)), 90.0) + padding);
    wanted.back() = std::max(wanted.back(), least.back());
  }
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < std::min(row.size(), wanted.size()); ++c) {
      const double width = metrics.horizontalAdvance(paper_text(row[c].text)) + padding;
      wanted[c] = std::max(wanted[c], width);
      least[c] = std::max(least[c], std::min(width, 64.0 + padding));
    }
  }
  double sum = 0;
  double floor = 0;
  for (const double w : wanted) sum += w;
  for (const double w : least) floor += w;
  std::vector<double> widths = wanted;
  if (sum > m_width && floor < m_width) {
    // Long texts give way; numbers and words keep their width.
    const double share = (m_width - floor) / (sum - floor);
    for (std::size_t c = 0; c < widths.size(); ++c) widths[c] = least[c] + share * (wanted[c] - least[c]);
  } else {
    for (double& w : widths) w *= m_width / sum;
  }
  return widths;
}

double Paper::row_height(const std::vector<report::Cell>& cells, const std::vector<double>& widths) const {
  double height = 14;
  for (std::size_t c = 0; c < std::min(cells.size(), widths.size()); ++c) {
    height = std::max(height, text_height(paper_text(cells[c].text), paper_font(10), widths[c] - cell_gap));
  }
  return height + 4;
}

void Paper::table_row(const std::vector<report::Cell>& cells, const std::vector<double>& widths,
                      const std::vector<bool>& numbers, bool is_header) {
  const double height = row_height(cells, widths);
  double x = margin;
  for (std::size_t c = 0; c < std::min(cells.size(), widths.size()); ++c) {
    const auto& cell = cells[c];
    const QColor ink = is_header                               ? muted_ink
                       : cell.verdict == report::Verdict::none ? QColor(0x1C2530)
                                                               : verdict_ink(cell.verdict);
    const bool right = c < numbers.size() && numbers[c];
    draw_text(QRectF(x, m_y + 2, widths[c] - cell_gap, height), paper_text(cell.text),
              paper_font(10, is_header ? QFont::DemiBold : QFont::Normal), ink, right ? Qt::AlignRight : Qt::AlignLeft);
    x += widths[c];
  }
  m_y += height;
  fill(QRectF(margin, m_y, m_width, is_header ? 0.8 : 0.4), line_ink);
}

void Paper::draw_text(const QRectF& place, const QString& text, const QFont& font, const QColor& colour,
                      Qt::Alignment alignment) {
  if (m_painter == nullptr || text.isEmpty()) return;
  m_painter->setFont(font);
  m_painter->setPen(colour);
  m_painter->drawText(place, static_cast<int>(Qt::TextWordWrap) | static_cast<int>(alignment | Qt::AlignTop), text);
}

void Paper::fill(const QRectF& place, const QColor& colour) {
  if (m_painter != nullptr) m_painter->fillRect(place, colour);
}

void Paper::room_for(double height) {
  if (m_y + height > m_bottom && m_y > margin + 1) new_page();
}

void Paper::new_page() {
  footer();
  if (m_painter != nullptr) m_next();
  ++m_page;
  m_y = margin;
}

void Paper::footer() {
  const double y = m_height - margin;
  fill(QRectF(margin, y - 4, m_width, 0.5), line_ink);
  draw_text(QRectF(margin, y, m_width - 80, 14), paper_text(m_report.provenance), paper_font(9), muted_ink);
  const QString number = m_pages > 0 ? QStringLiteral("%1 / %2").arg(m_page + 1).arg(m_pages) : QString();
  draw_text(QRectF(margin, y, m_width, 14), number, paper_font(9), muted_ink, Qt::AlignRight);
}

}  // namespace zerodrift::reporting

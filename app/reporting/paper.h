#pragma once
// Lays a report out on pages: blocks one under the other, half plots side by side, the contents after the first
// section. A block that fits on a page is never cut, a heading never stands alone at the foot of a page.

#include <QFont>
#include <QPainter>
#include <QRectF>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "core/report/report.h"
#include "ui/plots/report_plot.h"

namespace zerodrift::reporting {

/// Where a section begins; in logical units of 1/96 inch from the top.
struct PaperPlace {
  int page = 0;  // from 0
  double y = 0.0;
};

struct PaperLink {
  int page = 0;
  QRectF from;
  PaperPlace to;
};

struct PaperOutline {
  QString title;
  PaperPlace at;
};

class Paper {
 public:
  /// `size` of a page in logical units; the painter is scaled to them, also after next_page. Without a painter nothing
  /// is drawn: the places of the sections are found, which the contents need before they are drawn.
  Paper(const QSizeF& size, QPainter* painter, std::function<void()> next_page, const report::Report& report);

  Paper(const Paper&) = delete;
  Paper& operator=(const Paper&) = delete;

  /// `outline` and `pages`: of a pass without painter.
  void begin(std::vector<PaperOutline> outline = {}, int pages = 0);
  /// The next block; false when there is none left.
  bool step();

  const std::vector<PaperOutline>& outline() const { return m_outline; }
  const std::vector<PaperLink>& links() const { return m_links; }
  int pages() const { return m_page + 1; }

  void operator()(const report::Text& text);
  void operator()(const report::Figures& figures);
  void operator()(const report::Table& table);
  void operator()(const report::Plot& plot);
  void operator()(const report::HeatMap& map);

 private:
  void title();
  double company();
  void contents(const std::vector<PaperOutline>& outline);
  void plan_blocks(const report::Section& section);
  void draw_plot(const QRectF& place, const report::Plot& plot);
  void half_plots(const report::Plot& left, const report::Plot* right);
  void heading(const QString& text);
  void label(const QString& text, double left, double width);
  void signature();
  void figure_card(const QRectF& place, double label_height, double limit_height, const report::Figure& figure);
  std::vector<double> column_widths(const report::Table& table) const;
  double row_height(const std::vector<report::Cell>& cells, const std::vector<double>& widths) const;
  void table_row(const std::vector<report::Cell>& cells, const std::vector<double>& widths,
                 const std::vector<bool>& numbers, bool is_header);
  void draw_text(const QRectF& place, const QString& text, const QFont& font, const QColor& colour = {0x1C, 0x25, 0x30},
                 Qt::Alignment alignment = Qt::AlignLeft);
  void fill(const QRectF& place, const QColor& colour);
  void room_for(double height);
  void new_page();
  void footer();

  QPainter* m_painter;
  std::function<void()> m_next;
  const report::Report& m_report;
  std::vector<std::function<void()>> m_parts;  // in the order they are written
  std::size_t m_next_part = 0;
  std::deque<std::unique_ptr<ui::ReportPlotDrawing>> m_plots;  // of the part before, not finished yet
  std::vector<PaperOutline> m_outline;
  std::vector<PaperLink> m_links;
  double m_width = 0.0;
  double m_bottom = 0.0;
  double m_height = 0.0;
  double m_y = 0.0;
  int m_page = 0;
  int m_pages = 0;  // of the finished report; 0: not known yet
};

}  // namespace zerodrift::reporting

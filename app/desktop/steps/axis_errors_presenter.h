#pragma once
// The axis errors page: a laser report, its figures, the cut into segments, exports, and its use in the next upload.

#include "app/desktop/presenter.h"
#include "core/compensation/laser.h"
#include "core/compensation/segmentation.h"

namespace zerodrift::ui {
class AxisPage;
struct AxisState;
}  // namespace zerodrift::ui

namespace zerodrift::desktop {

class AxisErrorsPresenter : public Presenter {
  Q_OBJECT

 public:
  AxisErrorsPresenter(Workbench& bench, ui::AxisPage* page);
  void refresh() override;
  void forget() override;
  Standing standing() const override;
  void tour(std::function<void(bool good)> done) override;
  bool load(const QString& path);
  /// In the tour nobody is there to be asked for columns.
  void setAsking(bool asking) { m_asking = asking; }

 private:
  void open();
  void cut();
  void use();
  void exportTable(bool one_point);
  bool read();
  void askAgain();
  void fillMeasurement(ui::AxisState& state) const;
  void fillFigures(ui::AxisState& state) const;
  void fillSegments(ui::AxisState& state) const;
  void fillFormat(ui::AxisState& state) const;
  const compensation::Segmentation& chosen() const { return m_useOptimal ? m_optimal : m_published; }
  std::string axisName() const;
  /// Errors counted from the measuring position: there the camera has its zero.
  compensation::Table table() const;

  ui::AxisPage* m_page;
  QString m_file;
  std::string m_bytes;  // of the file: its columns may be told anew
  compensation::LaserOptions m_how;
  std::string m_named;  // the axis, by a person, over what the file says; empty: as the file says
  std::optional<compensation::LaserPreview> m_preview;
  bool m_asking = true;
  compensation::LaserReport m_report;
  std::vector<double> m_position_mm;
  std::vector<double> m_error_um;
  compensation::SegmentationOptions m_options;
  compensation::Segmentation m_published;
  compensation::Segmentation m_optimal;
  bool m_useOptimal = true;
  int m_format = 0;
};

}  // namespace zerodrift::desktop

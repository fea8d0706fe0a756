#pragma once
// The calibrate page: live pictures of the cameras, the moves, the result.

#include <QImage>
#include <QTimer>
#include <array>
#include <map>
#include <memory>
#include <mutex>

#include "app/desktop/presenter.h"
#include "core/flow/steps/calibrate_step.h"

namespace zerodrift::ui {
class CalibratePage;
struct CalibrateState;
}  // namespace zerodrift::ui

namespace zerodrift::desktop {

class CalibratePresenter : public Presenter {
  Q_OBJECT

 public:
  CalibratePresenter(Workbench& bench, ui::CalibratePage* page);
  void refresh() override;
  void enter() override;
  void leave() override;
  void tour(std::function<void(bool good)> done) override;

 private:
  /// What the worker thread tells while it moves; drained by the picture timer.
  struct Live {
    std::mutex mutex;
    std::string camera;
    int done = 0;
    int of = 0;
    std::vector<vision::Location> seen;
  };

  void start(std::function<void(bool good)> done);
  void showPicture();
  void fillPlan(ui::CalibrateState& state);
  void fillPoints(ui::CalibrateState& state) const;
  void fillResult(ui::CalibrateState& state, const nlohmann::json& camera) const;

  ui::CalibratePage* m_page;
  QTimer m_pictures;
  void useRegion(const QRectF& region_px);
  void showQuality(const vision::GrayImage& image, const QRectF& region);
  QRectF regionOf(const std::string& camera);

  std::map<std::string, std::array<int, 4>> m_regions;  // drawn since the last calibration, by camera
  int m_camera = 0;
  bool m_running = false;
  std::shared_ptr<Live> m_live = std::make_shared<Live>();
};

/// A grey image as Qt shows it.
QImage image_of(const vision::GrayImage& image);

}  // namespace zerodrift::desktop

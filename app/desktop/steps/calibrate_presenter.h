#pragma once
// The calibrate page: live pictures of the cameras, the moves, the result.

#include <QImage>
#include <QTimer>
#include <array>
#include <condition_variable>
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
  void forget() override;
  void enter() override;
  void leave() override;
  void tour(std::function<void(bool good)> done) override;
  void undo() override;

 private:
  /// What the worker thread tells while it moves; drained by the picture timer.
  struct Live {
    std::mutex mutex;
    std::string camera;
    int done = 0;
    int of = 0;
    std::vector<vision::Location> seen;
    // Consent is for one sequence of moves: the worker waits for the camera's name and takes it away.
    std::condition_variable_any agreement;
    std::string waiting;  // camera whose moves need a person's word
    std::string agreed;
  };

  /// Blocks the worker until a person has agreed to the moves of this camera.
  static Status waitForConsent(Live& live, const std::string& camera, const TaskContext& context);
  /// Starts the measurement, or lets it go on with the next camera; nothing without consent.
  void confirmed();
  void start(std::function<void(bool good)> done);
  std::string waitingFor() const;
  std::string cameraAtWork() const;
  void fillMoves(ui::CalibrateState& state);
  void showPicture();
  void fillPlan(ui::CalibrateState& state);
  void fillPoints(ui::CalibrateState& state) const;
  void fillResult(ui::CalibrateState& state, const nlohmann::json& camera) const;

  ui::CalibratePage* m_page;
  QTimer m_pictures;
  using Box = std::array<int, 4>;  // x, y, width, height in px
  /// What was drawn since the last calibration, by camera.
  struct Drawn {
    std::map<std::string, Box> regions;
    std::map<std::string, std::vector<Box>> marks;
  };
  /// The camera that is shown; "" when there is none.
  std::string cameraShown() const;
  bool largeEnough(const QRect& box, const char* what);
  void useRegion(const QRectF& region_px);
  void addMark(const QRectF& region_px);
  void removeMark(int index);
  void keepForUndo();
  void showQuality(const vision::GrayImage& image, const QRectF& region);
  void fillMarks(ui::CalibrateState& state, const std::vector<Box>& marks, const Box& region, double umPerPx) const;
  /// The camera in the calibration; null when there is none, or when it is not of the machine as it was tested last.
  const nlohmann::json* calibrationOf(const std::string& camera) const;
  Box regionOf(const std::string& camera) const;
  std::vector<Box> marksOf(const std::string& camera) const;

  std::string m_moveCamera;  // id of the camera that the page asks for
  Drawn m_drawn;
  std::vector<Drawn> m_undo;
  int m_camera = 0;
  bool m_running = false;
  bool m_current = false;  // the job's calibration
  bool m_asking = true;    // in the tour nobody is there to be asked
  std::string m_shownFor;  // camera whose moves were put before the person
  std::shared_ptr<Live> m_live = std::make_shared<Live>();
};

/// A grey image as Qt shows it.
QImage image_of(const vision::GrayImage& image);

}  // namespace zerodrift::desktop

// What is seen while a rig is set up: the value of each signal, once a second, and the picture of a camera.

#include <cmath>

#include "app/desktop/rig_editor.h"
#include "app/text/error_text.h"
#include "core/base/json.h"
#include "core/base/json_path.h"
#include "core/flow/devices.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {

using nlohmann::json;

namespace {

constexpr int live_ms = 1000;
constexpr int picture_ms = 200;
constexpr double few_percent = 0.1;  // of saturated pixels that a bright spot may have
constexpr int dark_grey = 60;        // of 255: the brightest hundredth of a picture that is too dark

/// The camera of the entry, as far as a picture needs it.
controller::CameraProfile camera_of(const json& entry) {
  controller::CameraProfile camera;
  const auto text = entry.find("url");
  if (text != entry.end() && text->is_string()) camera.url = text->get<std::string>();
  const auto number = [&](const char* key) -> std::optional<double> {
    const auto at = entry.find(key);
    return at != entry.end() && at->is_number() ? std::optional<double>(at->get<double>()) : std::nullopt;
  };
  camera.exposure_us = number("exposure_us");
  camera.gain_db = number("gain_db");
  return camera;
}

QImage picture_of(const vision::GrayImage& image) {
  return QImage(image.pixels.data(), image.width, image.height, image.width, QImage::Format_Grayscale8).copy();
}

QString brightness_words(const vision::GrayImage& image, const QVector<int>& counts) {
  const double all = static_cast<double>(image.pixels.size());
  int high = 0;
  double below = 0.0;
  for (int i = 0; i < counts.size() && below < 0.99 * all; ++i) {
    below += counts[i];
    high = i;
  }
  const double saturated = 100.0 * counts.last() / all;
  const QString words = saturated > few_percent ? RigWords::tr("Too bright: %1 % of the pixels are saturated.")
                        : high < dark_grey      ? RigWords::tr("Too dark: 99 % of the pixels are below %2 of 255.")
                                                : RigWords::tr("Exposure is right: up to %2 of 255.");
  return words.contains(QStringLiteral("%1")) ? words.arg(ui::fixedText(saturated, 1))
                                              : QString(words).replace(QStringLiteral("%2"), QString::number(high));
}

}  // namespace

void RigEditor::setLive(bool on) {
  m_liveOn = on && m_valid;
  m_watches.clear();
  m_rounds.clear();
  if (!m_liveOn) m_liveTimer.stop();
  readAgain();
  if (m_liveOn) m_liveTimer.start(live_ms);
  refresh();
}

/// The devices as they are set up now; one whose thread waits for an answer ends beside the window.
void RigEditor::readAgain() {
  if (m_live) m_ending.drop(std::exchange(m_live, nullptr));
  if (!m_liveOn) return;
  const auto profile = m_draft.profile();
  if (!profile) return;  // until it is mended
  auto live = controller::LiveSignals::open(*profile, controller::signal_rows(m_draft.document()));
  if (live) {
    m_live = std::move(*live);
  } else {
    Q_EMIT refused(live.error());
  }
}

bool RigEditor::isModbus(const std::string& device) const {
  const auto read = m_draft.device(controller::place_of_device(m_draft.document(), device));
  return read && read->kind == controller::DeviceKind::modbus;
}

void RigEditor::showValues() {
  if (!m_live) return;
  const auto values = m_live->values();
  for (const auto& row : controller::signal_rows(m_draft.document())) {
    const auto value = values.find(row.place);
    if (value == values.end()) continue;
    auto range = controller::range_of(row.use);
    // A broker's sensor and an agent say the same value until there is another.
    range.varies = range.varies && isModbus(row.source.device);
    auto& watch = m_watches.try_emplace(row.place, range).first->second;
    long& rounds = m_rounds[row.place];
    const bool same = std::exchange(rounds, value->second.rounds) == value->second.rounds;
    if (!same || std::isnan(value->second.value)) watch.add(value->second.value);
  }
  const auto& before = m_view->state().lines;
  auto lines = rigLines(m_draft, m_watches, m_said);
  for (qsizetype i = 0; i < std::min(before.size(), lines.size()); ++i) {
    lines[i].problem = before[i].problem;
    lines[i].problemColumn = before[i].problemColumn;
  }
  m_view->setLines(lines);
}

void RigEditor::setPreview(bool on) {
  m_pictureTimer.stop();
  if (m_camera) m_ending.drop(std::exchange(m_camera, nullptr));
  m_cameraOf.clear();
  if (on) {
    m_view->setPicture({}, {}, {}, {});
    showPicture();
    m_pictureTimer.start(picture_ms);
  }
  refresh();
}

void RigEditor::showPicture() {
  const json* entry = selected();
  if (entry == nullptr || selectedKind() != "camera") return setPreview(false);
  const controller::CameraProfile profile = camera_of(*entry);
  const std::string of = json_text({profile.url, profile.exposure_us.value_or(0.0), profile.gain_db.value_or(-1e3)});
  if (of != m_cameraOf) {  // its address or its exposure was changed
    if (m_camera) m_ending.drop(std::exchange(m_camera, nullptr));
    m_cameraOf = of;
    if (!profile.url.empty()) m_camera = flow::open_camera(profile);
  }
  if (!m_camera) {
    m_pictureTimer.stop();
    say(tr("Enter the camera's address first."), ui::Judgement::bad);
    return refresh();
  }
  const auto frame = m_camera->newest();
  if (!frame) {
    const bool waiting = frame.error().code == ErrorCode::camera_silent;
    return m_view->setPicture({}, {}, {},
                              waiting ? tr("Waiting for a picture") : lineOf(frame.error(), Reader::window));
  }
  const vision::GrayImage& image = (*frame)->image;
  QVector<int> counts(256, 0);
  for (const std::uint8_t grey : image.pixels) ++counts[grey];
  QRectF target;
  if (const json* roi = node_at(*entry, "target_roi_px"); roi != nullptr && roi->is_array() && roi->size() == 4) {
    double side[4] = {};
    for (std::size_t i = 0; i < 4; ++i) side[i] = (*roi)[i].is_number() ? (*roi)[i].get<double>() : 0.0;
    target = QRectF(side[0], side[1], side[2], side[3]);
  }
  QStringList note = {brightness_words(image, counts), tr("%1 × %2 px, %3 pictures a second")
                                                           .arg(image.width)
                                                           .arg(image.height)
                                                           .arg(ui::fixedText(m_camera->frames_per_s(), 1))};
  if (const auto identity = m_camera->identity(); identity && !identity->model.empty()) {
    note << QString::fromStdString(identity->vendor + " " + identity->model + " " + identity->serial).trimmed();
  }
  note << tr("Draw the target's region into the picture.");
  m_view->setPicture(picture_of(image), target, counts, note.join(QLatin1Char('\n')));
}

}  // namespace zerodrift::desktop

// What is looked for when a person asks: ports, units, addresses, cameras; and the test of one device.

#include <cmath>

#include "app/desktop/rig_editor.h"
#include "app/text/core_text.h"
#include "app/text/error_text.h"
#include "core/base/json_path.h"
#include "core/controller/find_devices.h"
#include "core/vision/camera_list.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {

using ui::Judgement;

namespace {

constexpr int unit_timeout_ms = 100;  // at 9600 baud a reply of one register takes 8 ms, a slow module 50 ms more

QString milliseconds(double seconds) {
  return RigWords::tr("%1 ms").arg(ui::fixedText(1000.0 * seconds, 1));
}

}  // namespace

void RigEditor::say(const QString& words, Judgement judgement) {
  m_result = words;
  m_resultJudgement = judgement;
}

void RigEditor::setSelected(const QString& key, const QString& value) {
  m_draft.enter(m_current.toStdString(), key.toStdString(), value.toStdString());
}

void RigEditor::search(const QString& words, std::function<Status(const TaskContext&, const Tell&)> work) {
  if (m_tasks.running()) return;
  m_found.clear();
  m_result.clear();
  m_busy = words;
  m_fraction = -1.0;
  const Tell tell = [this](const Found& found) {
    QMetaObject::invokeMethod(
        this,
        [this, found] {
          m_found.push_back(found);
          refresh();
        },
        Qt::QueuedConnection);
  };
  m_tasks.start<bool>(
      words,
      [work = std::move(work), tell](const TaskContext& context) -> Result<bool> {
        ZD_CHECK(work(context, tell));
        return true;
      },
      [this](const Result<bool>& done) {
        m_busy.clear();
        const bool ended = !done && done.error().code == ErrorCode::cancelled;
        if (!done && !ended) {
          say(lineOf(done.error(), Reader::window), Judgement::bad);
        } else if (m_found.empty()) {
          say(ended ? tr("Ended; nothing was found so far.") : tr("Nothing was found."), Judgement::none);
        } else {
          say(tr("Choose what to enter."), Judgement::none);
        }
        refresh();
      });
  refresh();
}

void RigEditor::find(const QString& what) {
  if (what == QStringLiteral("ports")) findPorts();
  if (what == QStringLiteral("units")) findUnits();
  if (what == QStringLiteral("network")) findNetwork();
  if (what == QStringLiteral("cameras")) findCameras();
}

void RigEditor::findPorts() {
  search(tr("Looking for serial ports"), [this](const TaskContext&, const Tell& tell) -> Status {
    for (const controller::SerialPort& port : controller::serial_ports()) {
      const QString path = QString::fromStdString(port.path);
      tell({{path.section(QLatin1Char('/'), -1), QString::fromStdString(port.device)}, [this, path] {
              setSelected(QStringLiteral("device"), path);
              changed();
            }});
    }
    return {};
  });
}

void RigEditor::findUnits() {
  const auto device = m_draft.device(m_current.toStdString());
  if (!device) {
    say(lineOf(device.error(), Reader::window), Judgement::bad);
    return refresh();
  }
  controller::ControllerSettings line = device->modbus;
  line.timeout_ms = std::min(line.timeout_ms, unit_timeout_ms);
  search(tr("Asking the units 1 to 247"), [this, line](const TaskContext& context, const Tell& tell) {
    return controller::find_units(
        line, controller::first_unit, controller::last_unit, context, [&](const controller::FoundUnit& found) {
          const QString number = QString::number(found.unit);
          tell({{tr("Unit %1").arg(number), milliseconds(found.round_trip_s)}, [this, number] {
                  setSelected(QStringLiteral("unit"), number);
                  changed();
                }});
        });
  });
}

void RigEditor::findNetwork() {
  const bool agent = selectedKind() == "mtconnect";
  search(tr("Looking into the local network"), [this, agent](const TaskContext& context, const Tell& tell) {
    std::vector<controller::HostPort> addresses;
    for (const auto& address : controller::own_network()) {
      if ((address.port == controller::agent_port) == agent) addresses.push_back(address);
    }
    return controller::find_listeners(addresses, context, [&](const controller::HostPort& found) {
      const QString host = QString::fromStdString(found.host);
      tell({{host, tr("port %1").arg(found.port)}, [this, agent, host, port = found.port] {
              if (agent) {
                setSelected(QStringLiteral("url"), QStringLiteral("http://%1:%2/").arg(host).arg(port));
              } else {
                setSelected(QStringLiteral("host"), host);
                setSelected(QStringLiteral("port"), QString::number(port));
              }
              changed();
            }});
    });
  });
}

void RigEditor::findCameras() {
  search(tr("Looking for cameras"), [this](const TaskContext&, const Tell& tell) -> Status {
    for (const vision::FoundCamera& camera : vision::find_cameras()) {
      const auto text = [](const std::string& words) { return QString::fromStdString(words); };
      const QString url = text(camera.url);
      const QString name = text(camera.identity.vendor + " " + camera.identity.model).trimmed();
      const QString serial = text(camera.identity.serial);
      const QString detail = serial.isEmpty() ? text(camera.identity.address)
                                              : tr("serial number %1, %2").arg(serial, text(camera.identity.address));
      tell({{url + QStringLiteral("  ") + name, detail}, [this, url] {
              setSelected(QStringLiteral("url"), url);
              changed();
            }});
    }
    return {};
  });
}

void RigEditor::test() {
  const auto device = m_draft.device(m_current.toStdString());
  if (!device || m_tasks.running()) {
    if (!device) say(lineOf(device.error(), Reader::window), Judgement::bad);
    return refresh();
  }
  std::vector<std::string> read;
  for (const auto& row : controller::signal_rows(m_draft.document())) {
    if (row.source.device == device->id && !row.source.signal.empty()) read.push_back(row.source.signal);
  }
  m_found.clear();
  m_result.clear();
  m_busy = tr("Testing %1").arg(QString::fromStdString(device->id));
  m_fraction = -1.0;
  m_tasks.start<controller::DeviceTest>(
      m_busy,
      [device = *device, read](const TaskContext& context) {
        return controller::test_device(device, read, context.stop);
      },
      [this, device = *device](const Result<controller::DeviceTest>& done) {
        m_busy.clear();
        tellTest(device, done);
        refresh();
      });
  refresh();
}

void RigEditor::tellTest(const controller::DeviceProfile& device, const Result<controller::DeviceTest>& test) {
  if (!test) return say(lineOf(test.error(), Reader::window), Judgement::bad);
  QStringList words = {tr("Answers in %1.").arg(milliseconds(test->round_trip_s))};
  for (const std::string& remark : test->remarks) words << coreText(remark);
  say(words.join(QLatin1Char(' ')), Judgement::ok);
  QStringList said;
  for (const auto& [name, value] : test->values) {
    said << QString::fromStdString(name);
    m_found.push_back({{QString::fromStdString(name),
                        std::isfinite(value) ? QString::number(value, 'g', 7) : RigWords::tr("no value")},
                       {}});
  }
  // Of a Modbus device its map says it.
  if (device.kind != controller::DeviceKind::modbus) m_said[device.id] = said;
}

}  // namespace zerodrift::desktop

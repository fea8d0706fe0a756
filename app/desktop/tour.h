#pragma once
// Drives the whole wizard unattended against the virtual machine, takes a picture of every page and writes the report.

#include <QObject>
#include <QTimer>
#include <functional>

#include "app/desktop/application.h"

namespace zerodrift::desktop {

class Tour : public QObject {
  Q_OBJECT

 public:
  Tour(Application& application, QString folder, const QString& size, DemoOptions demo);
  void start();

 private:
  void begin();
  void nextStep();
  void openStep();
  void whenIdle(const std::function<void()>& then);
  void stepDone(bool good);
  void takePicture(const QString& name);
  void tellStalls() const;
  void end(int code, const QString& words);

  Application& m_application;
  QString m_folder;
  DemoOptions m_demo;
  std::size_t m_step = 0;
  QTimer m_halfway;  // a picture of the run while it is live
};

}  // namespace zerodrift::desktop

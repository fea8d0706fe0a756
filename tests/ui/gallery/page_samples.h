#pragma once
// One function for each page: fills it for the scene named.

#include <QString>

namespace zerodrift::ui {

class MainWindow;
class Page;

namespace samples {

void addPages(MainWindow& window);
void fillMachine(Page* page, const QString& scene);
void fillCalibrate(Page* page, const QString& scene);
void fillWarmup(Page* page, const QString& scene);
void fillSensors(Page* page, const QString& scene);
void fillFit(Page* page, const QString& scene);
void fillPhysics(Page* page, const QString& scene);
void fillUpload(Page* page, const QString& scene);
void fillVerify(Page* page, const QString& scene);
void fillReport(Page* page, const QString& scene);
void fillAxis(Page* page, const QString& scene);
void fillCompensator(Page* page, const QString& scene);

}  // namespace samples
}  // namespace zerodrift::ui

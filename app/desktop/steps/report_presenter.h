#pragma once
// The report page: preview, head, sections, doubtful figures; saves PDF, HTML, CSV and the technical bundle.

#include <QImage>
#include <QSet>
#include <QTimer>

#include "app/desktop/presenter.h"
#include "app/reporting/bundle.h"
#include "core/report/text/language.h"

namespace zerodrift::ui {
class ReportPage;
struct ReportHead;
struct ReportState;
}  // namespace zerodrift::ui

namespace zerodrift::desktop {

class ReportPresenter : public Presenter {
  Q_OBJECT

 public:
  ReportPresenter(Workbench& bench, ui::ReportPage* page);
  void refresh() override;
  void enter() override;
  void leave() override;
  void languageChanged() override;
  void tour(std::function<void(bool good)> done) override;

 private:
  void saveAs(const QString& ending);
  void saveBundle();
  void setLanguage(int index);
  /// Every page of the window as it is now, for support.
  std::vector<reporting::BundleExtra> screenshots() const;
  /// Writes the report into these files and keeps that it was done.
  bool save(const QStringList& paths);
  void setHead(const ui::ReportHead& head);
  /// The whole report of the job; then what is left out is taken from it.
  Result<report::Report> build() const;
  void drawPreview();
  void fillSections(ui::ReportState& state) const;
  QString defaultPath(const QString& ending) const;

  ui::ReportPage* m_page;
  QTimer m_redraw;  // the preview follows changes when they rest
  QSet<QString> m_left;
  QImage m_signature;
  report::Report m_report;
  QVector<QImage> m_pages;
  QString m_savedTo;
  QString m_of;   // what the preview was drawn of
  QString m_log;  // of the window since it was opened, for the bundle
  report::Language m_language = report::Language::english;
  bool m_languageChosen = false;  // by a person; until then the window's
};

}  // namespace zerodrift::desktop

#pragma once
// The report page: preview, head, sections, doubtful figures; saves PDF, HTML, CSV and the technical bundle.

#include <QImage>
#include <QSet>
#include <QTimer>

#include "app/desktop/drawing_loop.h"
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
  void forget() override;
  void enter() override;
  void leave() override;
  void languageChanged() override;
  void tour(std::function<void(bool good)> done) override;

 private:
  void saveAs();
  void print();
  /// By the desktop's own program.
  void openOutside(const QString& path);
  void saveBundle();
  void setLanguage(int index);
  /// Every page of the window as it is now, for support.
  std::vector<reporting::BundleExtra> screenshots() const;
  /// Writes the report into these files and keeps that it was done.
  void save(const QStringList& paths, std::function<void(bool good)> done = {});
  struct Saving;
  void writeNext(const std::shared_ptr<Saving>& saving);
  void saved(const Saving& saving);
  void failed(const Saving& saving, const Error& error);
  void setHead(const ui::ReportHead& head);
  /// As chosen here: without what is left out, with the signature.
  report::Report chosen(report::Report whole) const;
  void drawPreview();
  void built(const std::filesystem::path& job, Result<report::Report> made);
  void previewDone();
  void fillSections(ui::ReportState& state) const;
  QString defaultPath(const QString& ending) const;

  ui::ReportPage* m_page;
  QTimer m_redraw;  // the preview follows changes when they rest
  TaskRunner m_building;
  DrawingLoop m_drawing;  // of the preview
  DrawingLoop m_writing;  // of the files
  bool m_again = false;   // something was changed while the preview was made
  std::function<void()> m_whenDrawn;
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

#include "app/desktop/steps/report_presenter.h"

#include <fmt/format.h>

#include <QBuffer>
#include <QDesktopServices>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLocale>
#include <QPrintDialog>
#include <QPrinter>
#include <QUrl>
#include <algorithm>
#include <array>

#include "app/desktop/company.h"
#include "app/reporting/writers.h"
#include "app/text/error_text.h"
#include "core/flow/steps/inputs.h"
#include "core/report/build.h"
#include "ui/pages/report_page.h"

namespace zerodrift::desktop {

using commissioning::NewArtefact;
using nlohmann::json;

namespace {

constexpr int preview_width_px = 1100;
constexpr int rest_ms = 60;
const std::string standards_mark = "Standards: ";
const std::string doubts_section = "doubts";  // always part of the report

/// The page on which a figure from this kind of artefact can be looked into.
QString page_of(const std::string& kind) {
  if (kind == "calibration") return QStringLiteral("calibrate");
  if (kind == "model") return QStringLiteral("fit");
  if (kind == "verification") return QStringLiteral("verify");
  if (kind == "head") return QStringLiteral("report");
  if (kind == "axis_table") return QStringLiteral("axis_errors");
  return QString::fromStdString(kind);
}

QString group_of(const std::string& kind) {
  if (kind == "head") return ReportPresenter::tr("Head of the report");
  QString name = stepName(kind);
  if (!name.isEmpty()) name.front() = name.front().toUpper();
  return name;
}

/// The report's own list: what the page shows first is what the paper says.
QVector<ui::DoubtfulFigure> doubts_of(const report::Report& report) {
  QVector<ui::DoubtfulFigure> doubts;
  for (const auto& section : report.sections) {
    if (section.id != doubts_section) continue;
    for (const auto& block : section.blocks) {
      const auto* text = std::get_if<report::Text>(&block);
      if (text == nullptr || !text->warning) continue;
      const bool bad = text->verdict == report::Verdict::bad;
      doubts.append({QString::fromStdString(text->text), bad ? ui::Judgement::bad : ui::Judgement::warn,
                     page_of(text->trace.artefact), group_of(text->trace.artefact)});
    }
  }
  return doubts;
}

ui::ReportHead head_of(const commissioning::JobHeader& header) {
  ui::ReportHead head;
  head.customer = QString::fromStdString(header.customer);
  head.machine = QString::fromStdString(header.machine);
  head.serial = QString::fromStdString(header.serial);
  head.engineer = QString::fromStdString(header.engineer);
  head.standards = header.notes.rfind(standards_mark, 0) == 0
                       ? QString::fromStdString(header.notes.substr(standards_mark.size()))
                       : QString::fromStdString(header.notes);
  return head;
}

constexpr std::array offered = {report::Language::english, report::Language::chinese};

}  // namespace

ReportPresenter::ReportPresenter(Workbench& bench, ui::ReportPage* page) : Presenter(bench, page), m_page(page) {
  connect(&bench, &Workbench::jobChanged, this, [this] {
    m_savedTo.clear();
    m_drawing.drop();
    if (m_writing.running()) m_page->clearProgress();
    m_writing.drop();
  });
  m_redraw.setSingleShot(true);
  m_redraw.setInterval(rest_ms);
  connect(&m_redraw, &QTimer::timeout, this, &ReportPresenter::drawPreview);
  connect(page, &ui::ReportPage::headEdited, this, &ReportPresenter::setHead);
  connect(page, &ui::ReportPage::sectionToggled, this, [this](const QString& section, bool included) {
    if (included || section.toStdString() == doubts_section) {
      m_left.remove(section);
    } else {
      m_left.insert(section);
    }
    m_redraw.start();
  });
  connect(page, &ui::ReportPage::languageChosen, this, &ReportPresenter::setLanguage);
  connect(&bench, &Workbench::logged, this, [this](const QDateTime& time, LogKind, const QString& text) {
    m_log += time.toUTC().toString(Qt::ISODateWithMs) + QLatin1Char(' ') + text + QLatin1Char('\n');
  });
  connect(page, &ui::ReportPage::doubtClicked, this, &Presenter::pageRequested);
  connect(page, &ui::ReportPage::signatureDrawn, this, [this](const QImage& signature) {
    m_signature = signature;
    m_redraw.start();
  });
  connect(page, &ui::ReportPage::companyRequested, this, [this] {
    if (askCompany(m_page)) m_redraw.start();
  });
  connect(page, &ui::Page::primaryTriggered, this, &ReportPresenter::saveAs);
  connect(page, &ui::Page::secondaryTriggered, this, [this](const QString& action) {
    const QFileInfo saved(QDir::fromNativeSeparators(m_savedTo));
    if (action == QStringLiteral("open")) openOutside(saved.absoluteFilePath());
    if (action == QStringLiteral("folder")) openOutside(saved.absolutePath());
    if (action == QStringLiteral("print")) print();
    if (action == QStringLiteral("bundle")) saveBundle();
  });
}

void ReportPresenter::forget() {
  m_redraw.stop();
  m_building.cancel();
  m_again = m_building.running();  // what it builds is not shown any more
  m_drawing.drop();
  m_whenDrawn = nullptr;
  m_left.clear();
  m_signature = {};
  m_report = {};
  m_pages.clear();
  m_savedTo.clear();
  m_of.clear();
  m_page->clearSignature();
}

void ReportPresenter::enter() {
  refresh();
  m_redraw.start();
}

void ReportPresenter::leave() {
  m_redraw.stop();
}

report::Report ReportPresenter::chosen(report::Report whole) const {
  std::erase_if(whole.sections,
                [this](const auto& section) { return m_left.contains(QString::fromStdString(section.id)); });
  if (!m_signature.isNull()) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    m_signature.save(&buffer, "PNG");
    whole.signature_png = bytes.toStdString();
  }
  signWith(keptCompany(), whole);
  return whole;
}

void ReportPresenter::drawPreview() {
  m_again = m_building.running();
  if (m_again) return;
  m_drawing.drop();
  if (bench().job() == nullptr || !bench().has("warmup")) return previewDone();
  const auto path = bench().job()->path();
  m_building.start<report::Report>(
      tr("Preview of the report"),
      [path, language = m_language](const TaskContext&) -> Result<report::Report> {
        // A way of its own into the file: the window may close its job meanwhile.
        ZD_TRY(const auto job, commissioning::Job::open_read_only(path));
        return report::build_report(job, language);
      },
      [this, path](Result<report::Report> made) { built(path, std::move(made)); });
}

void ReportPresenter::built(const std::filesystem::path& job, Result<report::Report> made) {
  if (m_again || bench().job() == nullptr || bench().job()->path() != job) return drawPreview();
  if (!made) {
    show(made.error());
    return previewDone();
  }
  m_report = std::move(*made);
  const report::Report shown = chosen(m_report);
  QStringList parts{QString::fromStdString(shown.language), QString::fromStdString(shown.provenance),
                    QString::number(m_signature.cacheKey()), QString::number(qHash(shown.logo_png))};
  for (const auto& line : shown.company) parts << QString::fromStdString(line);
  for (const auto& [name, value] : shown.header) parts << QString::fromStdString(value);
  for (const auto& section : shown.sections) parts << QString::fromStdString(section.id);
  const QString of = parts.join(QLatin1Char('|'));
  refresh();
  if (!m_pages.isEmpty() && of == m_of) return previewDone();
  auto pictures = std::make_unique<reporting::PagePictures>(shown, preview_width_px);
  const auto* drawn = pictures.get();
  m_drawing.begin(std::move(pictures), [this, drawn, of](const Status& ended) {
    if (ended) {
      const auto pages = drawn->pages();
      m_pages = QVector<QImage>(pages.begin(), pages.end());
      m_of = of;
      refresh();
    } else {
      show(ended.error());
    }
    previewDone();
  });
}

void ReportPresenter::previewDone() {
  if (const auto then = std::exchange(m_whenDrawn, nullptr)) then();
}

void ReportPresenter::setLanguage(int index) {
  if (index < 0 || index >= static_cast<int>(offered.size())) return;
  m_language = offered.at(static_cast<std::size_t>(index));
  m_languageChosen = true;
  m_redraw.start();
}

void ReportPresenter::languageChanged() {
  if (!m_languageChosen) {
    m_language = QLocale().language() == QLocale::Chinese ? report::Language::chinese : report::Language::english;
    if (!m_pages.isEmpty()) m_redraw.start();
  }
  Presenter::languageChanged();
}

void ReportPresenter::setHead(const ui::ReportHead& head) {
  if (bench().job() == nullptr) return;
  auto header = bench().job()->header().value_or(commissioning::JobHeader{});
  header.customer = head.customer.toStdString();
  header.machine = head.machine.toStdString();
  header.serial = head.serial.toStdString();
  header.engineer = head.engineer.toStdString();
  header.notes = head.standards.isEmpty() ? std::string() : standards_mark + head.standards.toStdString();
  if (const Status kept = bench().setHeader(header); !kept) show(kept.error());
  m_redraw.start();
}

QString ReportPresenter::defaultPath(const QString& ending) const {
  const auto job = bench().job();
  const QFileInfo file(QString::fromStdString(job->path().string()));
  return file.absoluteDir().filePath(file.completeBaseName() + QLatin1Char('.') + ending);
}

void ReportPresenter::saveAs() {
  if (bench().job() == nullptr) return;
  const QStringList kinds = {tr("Report to print and sign (*.pdf)"), tr("Web page with links to the data (*.html)"),
                             tr("Figures for a spreadsheet (*.csv)")};
  const QStringList endings = {QStringLiteral("pdf"), QStringLiteral("html"), QStringLiteral("csv")};
  QString kind;
  QString path = QFileDialog::getSaveFileName(m_page, tr("Save report"), defaultPath(endings.front()),
                                              kinds.join(QStringLiteral(";;")), &kind);
  if (path.isEmpty()) return;
  const QString ending = endings.value(std::max<qsizetype>(0, kinds.indexOf(kind)));
  const QFileInfo file(path);
  // The kind that was chosen counts, also over the ending of the name that was proposed.
  if (file.suffix().isEmpty()) path += QLatin1Char('.') + ending;
  if (endings.contains(file.suffix()) && file.suffix() != ending && !kind.isEmpty()) {
    path = file.absoluteDir().filePath(file.completeBaseName() + QLatin1Char('.') + ending);
  }
  save({path});
}

void ReportPresenter::openOutside(const QString& path) {
  if (QDesktopServices::openUrl(QUrl::fromLocalFile(path))) return;
  tell([path] {
    return ui::Problem{
        ui::ProblemKind::warning, tr("No program opens %1.").arg(path), tr("Open it with a program of your own."), {}};
  });
}

void ReportPresenter::print() {
  if (bench().job() == nullptr || m_writing.running()) return;
  auto printer = std::make_unique<QPrinter>(QPrinter::HighResolution);
  printer->setPageSize(QPageSize(QPageSize::A4));
  printer->setFullPage(true);
  printer->setDocName(QFileInfo(defaultPath(QStringLiteral("pdf"))).completeBaseName());
  QPrintDialog dialog(printer.get(), m_page);
  if (dialog.exec() != QDialog::Accepted) return;
  runTask<report::Report>(
      tr("Printing the report"),
      [job = bench().job(), language = m_language](const TaskContext&) { return report::build_report(*job, language); },
      [this, paper = std::make_shared<std::unique_ptr<QPrinter>>(std::move(printer))](Result<report::Report> made) {
        if (!made) return;
        m_page->setProgress(tr("Printing the report"), -1.0, std::nullopt, false);
        m_writing.begin(reporting::print_drawing(chosen(std::move(*made)), std::move(*paper)),
                        [this](const Status& ended) {
                          m_page->clearProgress();
                          if (!ended) return show(ended.error());
                          bench().log(LogKind::good, tr("Report printed"));
                        });
      });
}

struct ReportPresenter::Saving {
  std::shared_ptr<const QString> work;  // the job stays open until it is done
  report::Report report;
  QStringList paths;
  qsizetype written = 0;
  std::function<void(bool good)> done;
};

void ReportPresenter::save(const QStringList& paths, std::function<void(bool good)> done) {
  if (m_writing.running()) return;
  runTask<report::Report>(
      tr("Saving the report"),
      [job = bench().job(), language = m_language](const TaskContext&) { return report::build_report(*job, language); },
      [this, paths, done = std::move(done)](Result<report::Report> made) {
        if (!made) {
          if (done) done(false);
          return;
        }
        writeNext(std::make_shared<Saving>(
            Saving{bench().beginWork(tr("Saving the report")), chosen(std::move(*made)), paths, 0, done}));
      });
}

void ReportPresenter::writeNext(const std::shared_ptr<Saving>& saving) {
  if (saving->written == saving->paths.size()) return saved(*saving);
  const QString path = saving->paths[saving->written];
  auto drawing = reporting::drawing_of(saving->report, path.toStdString());
  if (!drawing) return failed(*saving, drawing.error());
  m_page->setProgress(tr("Saving the report"), -1.0, std::nullopt, false);
  m_writing.begin(std::move(*drawing), [this, saving, path](const Status& ended) {
    if (!ended) return failed(*saving, ended.error());
    bench().log(LogKind::good, tr("Report saved: %1").arg(path));
    ++saving->written;
    writeNext(saving);
  });
}

void ReportPresenter::failed(const Saving& saving, const Error& error) {
  m_page->clearProgress();
  show(error);
  if (saving.done) saving.done(false);
}

void ReportPresenter::saved(const Saving& saving) {
  m_page->clearProgress();
  json files = json::array();
  for (const QString& path : saving.paths) files.push_back(path.toStdString());
  const auto kept =
      bench().takeIn("report", [&files](commissioning::Job& job, const TaskContext&) -> Result<NewArtefact> {
        std::vector<commissioning::ArtefactId> inputs;  // of whatever there is
        for (const char* kind : {"verification", "warmup", "model", "physics", "axis_table"}) {
          ZD_TRY(const auto latest, job.latest(kind));
          if (latest) inputs.push_back(latest->id);
        }
        return NewArtefact::of("report", {{"files", files}}, inputs);
      });
  if (!kept) return failed(saving, kept.error());
  m_savedTo = QDir::toNativeSeparators(saving.paths.front());
  refresh();
  if (saving.done) saving.done(true);
}

std::vector<reporting::BundleExtra> ReportPresenter::screenshots() const {
  std::vector<reporting::BundleExtra> pictures;
  const auto add = [&](const QString& name, QWidget* widget) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    if (!widget->grab().save(&buffer, "PNG")) return;
    pictures.push_back({"screenshots/" + name.toStdString() + ".png", bytes.toStdString()});
  };
  add(QStringLiteral("00-window"), m_page->window());
  int number = 0;
  for (auto* page : m_page->window()->findChildren<ui::Page*>()) {
    add(QStringLiteral("%1-%2")
            .arg(++number, 2, 10, QLatin1Char('0'))
            .arg(page->objectName().isEmpty() ? QStringLiteral("page") : page->objectName()),
        page);
  }
  return pictures;
}

void ReportPresenter::saveBundle() {
  if (bench().job() == nullptr) return;
  m_page->clearProblem();
  // One click: beside the job, under a name of its own, so that nothing is written over.
  const QFileInfo proposed(defaultPath(QStringLiteral("zip")));
  const QString stem = proposed.completeBaseName() + QStringLiteral("-bundle");
  QString name = stem + QStringLiteral(".zip");
  for (int number = 2; proposed.absoluteDir().exists(name); ++number) {
    name = QStringLiteral("%1-%2.zip").arg(stem).arg(number);
  }
  const QString path = proposed.absoluteDir().filePath(name);
  if (const Status written =
          reporting::write_bundle(*bench().job(), path.toStdString(), {m_language, m_log.toStdString(), screenshots()});
      !written) {
    show(written.error());
    return;
  }
  bench().log(LogKind::good, tr("Technical bundle: %1").arg(path));
  m_savedTo = QDir::toNativeSeparators(path);
  refresh();
}

void ReportPresenter::fillSections(ui::ReportState& state) const {
  for (const auto& section : m_report.sections) {
    const QString id = QString::fromStdString(section.id);
    const bool always = section.id == doubts_section;
    state.sections.append({id, QString::fromStdString(section.title), !m_left.contains(id),
                           always ? tr("always part of the report") : QString(), always});
  }
  state.doubtful = doubts_of(m_report);
}

void ReportPresenter::refresh() {
  ui::ReportState state;
  const auto job = bench().job();
  if (job == nullptr || !bench().has("warmup")) {
    m_pages.clear();
    m_report = {};
    state.blocked = tr("The report is written from what was measured. Record a warm-up run first.");
    m_page->setState(state);
    return;
  }
  state.head = head_of(job->header().value_or(commissioning::JobHeader{}));
  state.languages = {QStringLiteral("English"), QStringLiteral("简体中文")};
  state.language = m_language == report::Language::chinese ? 1 : 0;
  fillSections(state);
  state.pages = m_pages;
  state.savedTo = m_savedTo;
  m_page->setState(state);
}

void ReportPresenter::tour(std::function<void(bool good)> done) {
  const QDir folder = QFileInfo(defaultPath(QStringLiteral("pdf"))).absoluteDir();
  save({folder.filePath(QStringLiteral("report.pdf")), folder.filePath(QStringLiteral("report.html"))},
       [this, done = std::move(done)](bool good) {
         m_whenDrawn = [done, good] { done(good); };
         drawPreview();
       });
}

}  // namespace zerodrift::desktop

// The report on paper, on screen, for spreadsheets, and the bundle for support.

#include <zip.h>

#include <QBuffer>
#include <QElapsedTimer>
#include <QImage>
#include <QPdfWriter>
#include <QProcess>
#include <QRegularExpression>
#include <QSet>
#include <QTest>
#include <map>

#include "app/reporting/bundle.h"
#include "app/reporting/drawing.h"
#include "app/reporting/writers.h"
#include "core/base/file.h"
#include "core/report/build.h"
#include "tests/report/rich_job.h"
#include "tests/support/amount.h"

namespace zerodrift {
namespace {

const char* const evil = "<script>alert('x')</script>&\"";

std::map<std::string, std::string> entries_of(const std::filesystem::path& path) {
  std::map<std::string, std::string> entries;
  int code = 0;
  zip_t* archive = zip_open(path.c_str(), ZIP_RDONLY, &code);
  if (archive == nullptr) return entries;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive, 0); ++i) {
    zip_stat_t stat;
    zip_stat_index(archive, static_cast<zip_uint64_t>(i), 0, &stat);
    std::string bytes(stat.size, '\0');
    zip_file_t* file = zip_fopen_index(archive, static_cast<zip_uint64_t>(i), 0);
    zip_fread(file, bytes.data(), bytes.size());
    zip_fclose(file);
    entries[stat.name] = std::move(bytes);
  }
  zip_discard(archive);
  return entries;
}

/// By poppler; 0: it is not installed.
int pages_of(const std::filesystem::path& path) {
  QProcess info;
  info.start(QStringLiteral("pdfinfo"), {QString::fromStdString(path.string())});
  if (!info.waitForFinished(10000)) return 0;
  static const QRegularExpression pages(QStringLiteral("Pages:\\s+(\\d+)"));
  return pages.match(QString::fromUtf8(info.readAllStandardOutput())).captured(1).toInt();
}

std::string written_by_cli(const std::filesystem::path& job, const std::filesystem::path& out, const char* language) {
  QProcess cli;
  cli.start(
      QStringLiteral(ZERODRIFT_BIN_DIR "/zerodrift-cli"),
      {QStringLiteral("report"), QStringLiteral("--job"), QString::fromStdString(job.string()), QStringLiteral("--out"),
       QString::fromStdString(out.string()), QStringLiteral("--language"), QString::fromLatin1(language)});
  if (!cli.waitForFinished(60000) || cli.exitCode() != 0) return {};
  return read_file(out).value_or(std::string());
}

}  // namespace

class ReportingTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  /// Two processes, so that nothing drawn anew in each (the order of hash tables) can pass unseen.
  void theSameJobGivesTheSameBytes() {
    report::RichJob rich({"VMC", "17", "", "A. Keller", ""});
    const auto file = rich.job().path();
    for (const char* language : {"en", "zh"}) {
      const auto all = [&](const std::string& stem) {
        std::vector<std::string> files;
        for (const char* ending : {".pdf", ".html", ".csv"}) {
          files.push_back(written_by_cli(file, rich.folder() / (stem + ending), language));
        }
        return files;
      };
      const auto first = all("a");
      QTest::qWait(1100);  // a date of writing would differ
      const auto second = all("b");
      for (std::size_t i = 0; i < first.size(); ++i) {
        QVERIFY(!first[i].empty());
        QVERIFY2(first[i] == second[i], qPrintable(QString::number(i)));
      }
    }
  }

  void thePdfHasFontsLinksAndPagesInTime() {
    report::RichJob rich({"VMC", "17", "", "A. Keller", ""});
    for (const auto language : {report::Language::english, report::Language::chinese}) {
      QElapsedTimer timer;
      timer.start();
      const auto report = report::build_report(rich.job(), language);
      QVERIFY(report.has_value());
      const auto path = rich.folder() / "r.pdf";
      QVERIFY(reporting::write_pdf(*report, path).has_value());
      QVERIFY2(!judges_durations() || timer.elapsed() < 3000, qPrintable(QString::number(timer.elapsed())));
      QProcess fonts;
      fonts.start(QStringLiteral("pdffonts"), {QString::fromStdString(path.string())});
      if (!fonts.waitForFinished(10000)) QSKIP("poppler-utils are not installed");
      const auto lines = QString::fromUtf8(fonts.readAllStandardOutput()).split(QLatin1Char('\n'), Qt::SkipEmptyParts);
      QVERIFY(lines.size() > 3);
      for (int i = 2; i < lines.size(); ++i) QVERIFY2(lines[i].contains(QStringLiteral(" yes ")), qPrintable(lines[i]));
      QProcess text;
      text.start(QStringLiteral("pdftotext"),
                 {QStringLiteral("-layout"), QString::fromStdString(path.string()), QStringLiteral("-")});
      QVERIFY(text.waitForFinished(10000));
      const auto words = QString::fromUtf8(text.readAllStandardOutput());
      const bool chinese = language == report::Language::chinese;
      QVERIFY(
          words.contains(chinese ? QStringLiteral("热误差补偿报告") : QStringLiteral("Thermal compensation report")));
      QVERIFY(words.contains(chinese ? QStringLiteral("目录") : QStringLiteral("Contents")));
      QVERIFY(words.contains(QStringLiteral("1 / ")));
      const auto bytes = read_file(path).value();
      QVERIFY(bytes.starts_with("%PDF"));
    }
  }

  /// Who made the report stands at its head, on paper, on a printer and on screen.
  void theCompanyStandsAtTheHead() {
    report::RichJob rich({"VMC", "17", "", "A. Keller", ""});
    auto report = report::build_report(rich.job()).value();
    const std::string bare = reporting::html_of(report);
    report.company = {"Keller & Sons", "1 Mill Lane"};
    QImage logo(400, 100, QImage::Format_RGB32);
    logo.fill(Qt::darkGreen);
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    QVERIFY(logo.save(&buffer, "PNG"));
    report.logo_png = bytes.toStdString();
    const std::string html = reporting::html_of(report);
    QVERIFY(html.find("Keller &amp; Sons<br>1 Mill Lane") < html.find("<h1>"));
    QVERIFY(html.find("alt=\"logo\"") != std::string::npos);
    QVERIFY(bare.find("class=\"company\"") == std::string::npos);
    const auto path = rich.folder() / "company.pdf";
    QVERIFY(reporting::write_pdf(report, path).has_value());
    // What a printer gets has as many pages as the file.
    const auto printed = rich.folder() / "printed.pdf";
    auto device = std::make_unique<QPdfWriter>(QString::fromStdString(printed.string()));
    device->setPageSize(QPageSize(QPageSize::A4));
    device->setPageMargins(QMarginsF(0, 0, 0, 0));
    QVERIFY(reporting::draw(*reporting::print_drawing(report, std::move(device))).has_value());
    QCOMPARE(pages_of(printed), pages_of(path));
    QProcess text;
    text.start(QStringLiteral("pdftotext"),
               {QStringLiteral("-l"), QStringLiteral("1"), QString::fromStdString(path.string()), QStringLiteral("-")});
    if (!text.waitForFinished(10000)) QSKIP("poppler-utils are not installed");
    QVERIFY(text.readAllStandardOutput().contains("1 Mill Lane"));
  }

  void whatPeopleEnterIsTextAndNoMarkup() {
    report::RichJob rich({evil, "17", "=cmd|' /C calc'!A0", "+A. Keller", "@notes"});
    const auto report = report::build_report(rich.job());
    QVERIFY(report.has_value());
    const std::string html = reporting::html_of(*report);
    QVERIFY(html.find("<script") == std::string::npos);
    QVERIFY(html.find("&lt;script&gt;") != std::string::npos);
    QVERIFY(html.find("<b>briefly") == std::string::npos);
    const std::string csv = reporting::csv_of(*report);
    QVERIFY(csv.find(",=cmd") == std::string::npos);
    QVERIFY(csv.find("'=cmd") != std::string::npos);
    QVERIFY(csv.find("'+A. Keller") != std::string::npos);
    QVERIFY(csv.find("'@notes") != std::string::npos);
  }

  void eachFigureOfTheHtmlIsALink() {
    report::RichJob rich({"VMC", "17", "", "A. Keller", ""});
    const auto report = report::build_report(rich.job()).value();
    const std::string html = reporting::html_of(report);
    for (const char* id : {"peak_after_Z_um", "range_60min_Z_um", "coefficient_Z_T1", "iso230_2_X_A_um"}) {
      QVERIFY2(html.find(std::string("href=\"#trace-") + id + "\"") != std::string::npos, id);
      QVERIFY2(html.find(std::string("id=\"trace-") + id + "\"") != std::string::npos, id);
    }
  }

  void whatALinkLeadsToIsThereOnce() {
    report::RichJob rich({"VMC", "17", "", "A. Keller", ""});
    const QString html = QString::fromStdString(reporting::html_of(report::build_report(rich.job()).value()));
    const auto all = [&](const char* pattern) {
      QStringList found;
      auto match = QRegularExpression(QString::fromLatin1(pattern)).globalMatch(html);
      while (match.hasNext()) found.append(match.next().captured(1));
      return found;
    };
    const QStringList ids = all(" id=\"([^\"]*)\"");
    for (const QString& target : all("href=\"#([^\"]*)\"")) QVERIFY2(ids.count(target) == 1, qPrintable(target));
    QCOMPARE(QSet<QString>(ids.begin(), ids.end()).size(), ids.size());
    QVERIFY(!html.contains(QStringLiteral("<h3></h3>")));
  }

  void theBundleHoldsEverythingButSecrets() {
    report::RichJob rich({"VMC", "17", "", "A. Keller", ""});
    const auto path = rich.folder() / "b.zip";
    const auto written = reporting::write_bundle(
        rich.job(), path,
        {report::Language::english, "09:00 camera http://u:hunter2@h/", {{"screenshots/a.png", "png"}}});
    QVERIFY(written.has_value());
    const auto entries = entries_of(path);
    for (const char* name : {"README.txt", "job.zdj", "report.pdf", "report.html", "figures.csv", "log.txt",
                             "window.txt", "versions.txt", "profile.json", "table.json", "diagnosis.json",
                             "axis-table.json", "runs/01-warm-up.csv", "screenshots/a.png"}) {
      QVERIFY2(entries.contains(name), name);
    }
    for (const auto& [name, bytes] : entries) {
      QVERIFY2(bytes.find("hunter2") == std::string::npos, name.c_str());
      QVERIFY2(bytes.find("abcdef") == std::string::npos, name.c_str());
    }
    // The job in it opens and holds the run.
    QVERIFY(write_file(rich.folder() / "copy.zdj", entries.at("job.zdj")).has_value());
    const auto copy = commissioning::Job::open_read_only(rich.folder() / "copy.zdj");
    QVERIFY(copy.has_value());
    QCOMPARE(copy->series()->size(), rich.job().series()->size());
    QVERIFY(copy->latest("machine").value()->body.find("***") != std::string::npos);
    // And the job itself is as it was.
    QVERIFY(rich.job().latest("machine").value()->body.find("hunter2") != std::string::npos);
    QVERIFY(rich.job().check()->ok());
  }

  void aRunMayBeCalledAnything() {
    report::RichJob rich({"VMC", "17", "", "A. Keller", ""});
    for (const char* name : {"../../../evil", "..\\..\\evil", "/etc/passwd", "C:evil", ".", "a\nb"}) {
      QVERIFY(rich.job().start_series(name, {"T1_C"}, "{}").has_value());
    }
    QVERIFY(rich.job().start_series(std::string(500, 'x'), {"=cmd|' /C calc'!A0"}, "{}").has_value());
    const auto hostile_path = rich.folder() / "hostile.zip";
    QVERIFY(reporting::write_bundle(rich.job(), hostile_path, {report::Language::english, "", {}}).has_value());
    int runs = 0;
    for (const auto& [name, bytes] : entries_of(hostile_path)) {
      if (!name.starts_with("runs/")) continue;
      ++runs;
      QVERIFY2(name.find_first_of("/\\:\n", 5) == std::string::npos && name.size() < 100, name.c_str());
      QVERIFY2(bytes.find(",=cmd") == std::string::npos, name.c_str());
    }
    QVERIFY(runs >= 8);
  }
};

}  // namespace zerodrift

QTEST_MAIN(zerodrift::ReportingTest)
#include "reporting_test.moc"

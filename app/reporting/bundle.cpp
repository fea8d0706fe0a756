#include "app/reporting/bundle.h"

#include <fmt/format.h>
#include <zip.h>

#include <QSysInfo>
#include <QTemporaryDir>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/reporting/writers.h"
#include "core/base/file.h"
#include "core/base/json.h"
#include "core/base/redact.h"
#include "core/base/time_text.h"
#include "core/commissioning/copy.h"
#include "core/recording/csv.h"
#include "core/report/build.h"

namespace zerodrift::reporting {
namespace {

using nlohmann::json;

/// A zip being made. Contents are kept here until it is closed: the library reads them then.
class Zip {
 public:
  static Result<Zip> create(const std::filesystem::path& path, std::time_t time) {
    int code = 0;
    zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
    if (archive == nullptr) {
      zip_error_t error;
      zip_error_init_with_code(&error, code);
      const std::string detail = zip_error_strerror(&error);
      zip_error_fini(&error);
      return fail(ErrorCode::file_not_writable, {{"file", path.string()}, {"detail", detail}});
    }
    return Zip(archive, path, time);
  }
  Zip(Zip&& other) noexcept
      : m_archive(std::exchange(other.m_archive, nullptr)),
        m_path(std::move(other.m_path)),
        m_time(other.m_time),
        m_kept(std::move(other.m_kept)) {}
  Zip& operator=(Zip&&) = delete;
  ~Zip() {
    if (m_archive != nullptr) zip_discard(m_archive);
  }

  Status add(const std::string& name, std::string bytes) {
    const std::string& kept = *m_kept.emplace_back(std::make_unique<std::string>(std::move(bytes)));
    zip_source_t* source = zip_source_buffer(m_archive, kept.data(), kept.size(), 0);
    const zip_int64_t index = source == nullptr ? -1 : zip_file_add(m_archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      if (source != nullptr) zip_source_free(source);
      return refused();
    }
    // The time of the work and not of the archive: the same job gives the same bytes.
    zip_file_set_mtime(m_archive, static_cast<zip_uint64_t>(index), m_time, 0);
    return {};
  }

  Status add_file(const std::string& name, const std::filesystem::path& file) {
    ZD_TRY(std::string bytes, read_file(file));
    return add(name, std::move(bytes));
  }

  Status close() {
    if (zip_close(m_archive) != 0) return refused();
    m_archive = nullptr;
    return {};
  }

 private:
  Zip(zip_t* archive, std::filesystem::path path, std::time_t time)
      : m_archive(archive), m_path(std::move(path)), m_time(time) {}

  Status refused() {
    return fail(ErrorCode::file_not_writable, {{"file", m_path.string()}, {"detail", zip_strerror(m_archive)}});
  }

  zip_t* m_archive;
  std::filesystem::path m_path;
  std::time_t m_time;
  std::vector<std::unique_ptr<std::string>> m_kept;
};

std::string pretty(const json& value) {
  return without_secrets(json_text(value, 2)) + "\n";
}

/// The latest results as files that other tools read.
Status add_results(const commissioning::Job& job, Zip& zip) {
  struct Part {
    const char* kind;
    const char* part;  // of the body; empty: all of it
    const char* file;
  };
  constexpr Part parts[] = {{"machine", "profile", "profile.json"},     {"calibration", "", "calibration.json"},
                            {"sensors", "", "clusters.json"},           {"model", "model", "model.json"},
                            {"physics", "diagnosis", "diagnosis.json"}, {"upload", "table", "table.json"},
                            {"upload", "record", "upload.json"},        {"axis_table", "table", "axis-table.json"}};
  for (const Part& part : parts) {
    ZD_TRY(const auto latest, job.latest(part.kind));
    if (!latest) continue;
    ZD_TRY(const json body, latest->document());
    const std::string key = part.part;
    if (!key.empty() && (!body.contains(key) || body.at(key).is_null())) continue;
    ZD_CHECK(zip.add(part.file, pretty(key.empty() ? body : body.at(key))));
  }
  return {};
}

/// A name that was given by a person, as part of a file's: no separators, nothing that leads elsewhere or hides it.
std::string as_file_name(std::string name) {
  constexpr std::size_t longest = 60;
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F || std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos) c = '_';
  }
  std::replace(name.begin(),
               name.begin() + static_cast<std::ptrdiff_t>(std::min(name.find_first_not_of('.'), name.size())), '.',
               '_');
  if (name.size() <= longest) return name;
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;  // not within a character
  return name.substr(0, end);
}

Status add_runs(const commissioning::Job& job, Zip& zip) {
  ZD_TRY(const auto all, job.series());
  for (const auto& info : all) {
    ZD_TRY(const auto run, job.read_series(info.id));
    ZD_CHECK(zip.add(fmt::format("runs/{:02d}-{}.csv", info.id, as_file_name(info.name)), recording::to_csv(run)));
  }
  return {};
}

/// Everything that happened, as the job remembers it.
Result<std::string> log_of(const commissioning::Job& job) {
  std::string log;
  ZD_TRY(const auto all, job.series());
  for (const auto& info : all) {
    log += fmt::format("run {} \"{}\", {} rows, begun {}\n", info.id, info.name, info.rows, info.started_utc);
    ZD_TRY(const auto events, job.events(info.id));
    for (const auto& event : events) {
      log += fmt::format("  {} {:.1f} s {} {} {}\n", event.utc, event.time_s, event.kind, event.text, event.details);
    }
  }
  ZD_TRY(const auto audit, job.audit_trail());
  log += "writes to the machine\n";
  for (const auto& entry : audit) {
    log += fmt::format("  {} {} {}: {} -> {} ({})\n", entry.utc, entry.action, entry.subject, entry.old_value,
                       entry.new_value, entry.result);
  }
  return without_secrets(log);
}

std::string versions() {
  return fmt::format("Zerodrift {}\nQt {}\n{}\n{} {}\nlibzip {}\n", ZERODRIFT_VERSION, qVersion(),
                     QSysInfo::prettyProductName().toStdString(), QSysInfo::kernelType().toStdString(),
                     QSysInfo::kernelVersion().toStdString(), zip_libzip_version());
}

std::string read_me(int secrets) {
  std::string text =
      "Technical bundle of a Zerodrift job.\n\n"
      "job.zdj       the job; open it with Zerodrift\n"
      "report.pdf, report.html, figures.csv\n"
      "runs/         every recorded run, a row a sample\n"
      "*.json        profile, calibration, sensors, model, diagnosis and tables, the latest of each\n"
      "log.txt       what happened during the runs, and every write to the machine\n"
      "window.txt    the log of the window, if the bundle was made there\n"
      "screenshots/  its pages as they were\n"
      "versions.txt\n\n";
  text += secrets == 0 ? "No passwords were found in the job.\n"
                       : fmt::format(
                             "Passwords were removed from {} entries of job.zdj; the check sums of those "
                             "entries do not fit any more.\n",
                             secrets);
  return text;
}

}  // namespace

Status write_bundle(const commissioning::Job& job, const std::filesystem::path& path, const BundleOptions& options) {
  QTemporaryDir folder;
  if (!folder.isValid()) {
    return fail(ErrorCode::file_not_writable,
                {{"file", path.string()}, {"detail", folder.errorString().toStdString()}});
  }
  const std::filesystem::path place = folder.path().toStdString();
  ZD_TRY(const auto report, report::build_report(job, options.language));
  ZD_TRY(const int secrets, commissioning::copy_without_secrets(job.path(), place / "job.zdj"));
  const auto made = utc_from_text(report.made_utc);
  const std::time_t time = made ? std::chrono::system_clock::to_time_t(*made) : std::time_t{};
  // Beside the others first: a bundle that could not be finished is not left lying about.
  ZD_TRY(Zip zip, Zip::create(place / "bundle.zip", time));
  ZD_CHECK(zip.add("README.txt", read_me(secrets)));
  ZD_CHECK(zip.add_file("job.zdj", place / "job.zdj"));
  ZD_CHECK(write_pdf(report, place / "report.pdf"));
  ZD_CHECK(zip.add_file("report.pdf", place / "report.pdf"));
  ZD_CHECK(zip.add("report.html", html_of(report)));
  ZD_CHECK(zip.add("figures.csv", csv_of(report)));
  ZD_CHECK(add_runs(job, zip));
  ZD_CHECK(add_results(job, zip));
  ZD_TRY(std::string log, log_of(job));
  ZD_CHECK(zip.add("log.txt", std::move(log)));
  if (!options.log.empty()) ZD_CHECK(zip.add("window.txt", without_secrets(options.log)));
  for (const auto& extra : options.extras) ZD_CHECK(zip.add(extra.name, extra.bytes));
  ZD_CHECK(zip.add("versions.txt", versions()));
  ZD_CHECK(zip.close());
  ZD_TRY(const std::string bytes, read_file(place / "bundle.zip"));
  return write_file(path, bytes);
}

}  // namespace zerodrift::reporting

#include "app/proof/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "app/proof/concealed_case.h"
#include "app/proof/diagnose_files.h"
#include "app/proof/oracle.h"
#include "core/base/file.h"
#include "core/base/hash.h"
#include "core/base/json.h"
#include "core/recording/csv.h"

namespace zerodrift::proof {
namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::json;
namespace fs = std::filesystem;

constexpr double drawing_share = 0.2;  // of the whole time, for the progress

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Sealed {
  std::string name;
  machine::Commitment seal;
};

/// Progress of one phase with the time that is left, told from the time used so far.
class Phase {
 public:
  Phase(const TaskContext& context, std::string name, double from, double to, int total)
      : m_context(context), m_name(std::move(name)), m_from(from), m_to(to), m_total(total) {}
  void done(int count) const {
    const double share = static_cast<double>(count) / m_total;
    const double whole_s = seconds_since(m_start) / share;
    m_context.progress(m_from + share * (m_to - m_from), m_name, whole_s * (1.0 - share));
  }

 private:
  const TaskContext& m_context;
  std::string m_name;
  double m_from, m_to;
  int m_total;
  Clock::time_point m_start = Clock::now();
};

Result<std::vector<Sealed>> conceal(const TrialOptions& options, const TaskContext& context) {
  std::vector<Sealed> sealed;
  const Phase phase(context, "drawing cases", 0.0, drawing_share, options.cases);
  for (int i = 0; i < options.cases; ++i) {
    if (context.cancelled()) return fail(ErrorCode::cancelled, {});
    ConcealedCase one = options.kind.empty() ? draw_case(options.seed, i, options.strength)
                                             : draw_case(options.seed, i, options.kind, false, options.strength);
    ZD_CHECK(write_case_files(one, options.folder / "cases" / one.name));
    sealed.push_back({one.name, std::move(one.seal)});
    phase.done(i + 1);
  }
  return sealed;
}

Result<std::string> promise(const TrialOptions& options, const std::vector<Sealed>& sealed) {
  json promises = {{"format", "zerodrift-commitments/1"},
                   {"rule", "sha256 = SHA-256 of salt followed by sealed_text, both in cases/<case>/answer.json"},
                   {"cases", json::array()}};
  for (const auto& one : sealed) {
    const fs::path folder = options.folder / "cases" / one.name;
    json files;
    for (const char* file : {"machine.json", "recording.csv", "second.csv"}) {
      ZD_TRY(const std::string bytes, read_file(folder / file));
      files[file] = sha256_hex(bytes);
    }
    promises["cases"].push_back({{"case", one.name}, {"sha256", one.seal.sha256}, {"files", files}});
  }
  const fs::path path = options.folder / "commitments.json";
  ZD_CHECK(write_json_file(path, promises));
  ZD_TRY(const std::string bytes, read_file(path));
  return sha256_hex(bytes);
}

/// Opens one seal against the promise on disk.
Result<bool> open_seal(const Sealed& one, const fs::path& folder, const json& promises) {
  std::string promised;
  for (const auto& entry : promises.at("cases")) {
    if (entry.at("case") == one.name) promised = entry.at("sha256").get<std::string>();
  }
  const bool kept = sha256_hex(one.seal.salt + one.seal.answer) == promised;
  ZD_CHECK(write_json_file(folder / "answer.json", {{"sha256", promised},
                                                    {"salt", one.seal.salt},
                                                    {"sealed_text", one.seal.answer},
                                                    {"kept", kept},
                                                    {"answer", json::parse(one.seal.answer)}}));
  return kept;
}

/// The files of the case again, this time with the answer known.
Result<OracleAnswer> told(const fs::path& folder, const OpenedAnswer& truth) {
  ZD_TRY(const physics::Machine machine, physics::read_machine(folder / "machine.json"));
  std::vector<recording::Recording> runs;
  for (const char* file : {"recording.csv", "second.csv"}) {
    ZD_TRY(auto run, recording::read_recording(folder / file));
    runs.push_back(std::move(run));
  }
  return told_the_truth(machine, runs, truth.effects);
}

}  // namespace

json Trial::to_json() const {
  json out = score.to_json();
  out["seed"] = options.seed;
  out["strength"] = name_of(options.strength);
  out["commitments_sha256"] = digest;
  out["seals_kept"] = seals_kept;
  out["seconds"] = seconds;
  return out;
}

Result<Trial> run_trial(const TrialOptions& options, const TaskContext& context) {
  const auto start = Clock::now();
  Trial trial;
  trial.options = options;
  ZD_TRY(const std::vector<Sealed> sealed, conceal(options, context));
  ZD_TRY(trial.digest, promise(options, sealed));
  std::vector<Result<json>> answers;
  const Phase phase(context, "diagnosing", drawing_share, 0.98, options.cases);
  for (const auto& one : sealed) {
    if (context.cancelled()) break;
    answers.push_back(diagnose_files(options.folder / "cases" / one.name, {"recording.csv", "second.csv"},
                                     "diagnosis.json", context));
    phase.done(static_cast<int>(answers.size()));
  }
  // The seals are opened even when the trial was broken off: nothing stays hidden.
  ZD_TRY(const json promises, read_json_file(options.folder / "commitments.json"));
  for (std::size_t i = 0; i < sealed.size(); ++i) {
    const fs::path folder = options.folder / "cases" / sealed[i].name;
    ZD_TRY(const bool kept, open_seal(sealed[i], folder, promises));
    trial.seals_kept += kept ? 1 : 0;
    if (i >= answers.size() || context.cancelled()) continue;
    ZD_TRY(OpenedAnswer truth, truth_from(sealed[i].seal.answer, (folder / "answer.json").string()));
    if (answers[i] && !truth.unlisted) {
      ZD_TRY(const OracleAnswer oracle, told(folder, truth));
      truth.reached = oracle.reached;
      truth.told_place_sigma_mm = oracle.place_sigma_mm;
      for (const auto& [id, evidence] : oracle.beside) truth.told = std::min(truth.told.value_or(evidence), evidence);
    }
    if (answers[i]) {
      trial.score.add(truth, *answers[i]);
    } else {
      trial.score.add_failure(truth, "refused: " + describe(answers[i].error()));
    }
  }
  if (context.cancelled()) return fail(ErrorCode::cancelled, {});
  trial.seconds = seconds_since(start);
  ZD_CHECK(write_json_file(options.folder / "result.json", trial.to_json()));
  return trial;
}

}  // namespace zerodrift::proof

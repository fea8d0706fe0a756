#include "app/proof/diagnose_files.h"

#include <ctime>

#include "core/base/json.h"
#include "core/diagnosis/diagnosis.h"
#include "core/recording/csv.h"

namespace zerodrift::proof {

Result<nlohmann::json> diagnose_files(const std::filesystem::path& folder, const std::vector<std::string>& recordings,
                                      const std::string& out, const TaskContext& context) {
  ZD_TRY(const physics::Machine machine, physics::read_machine(folder / "machine.json"));
  std::vector<recording::Recording> runs;
  for (const auto& file : recordings) {
    ZD_TRY(auto run, recording::read_recording(folder / file));
    runs.push_back(std::move(run));
  }
  TaskContext silent;  // one of many: its own progress would jump
  silent.stop = context.stop;
  const std::clock_t start = std::clock();
  ZD_TRY(const diagnosis::Diagnosis result, diagnosis::diagnose(machine, runs, {}, silent));
  nlohmann::json answer = diagnosis::to_json(result);
  answer["processor_seconds"] = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  ZD_CHECK(write_json_file(folder / out, answer));
  return answer;
}

}  // namespace zerodrift::proof

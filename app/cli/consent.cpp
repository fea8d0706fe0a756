#include "app/cli/consent.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "app/cli/typed.h"
#include "core/flow/steps/upload_step.h"

namespace zerodrift::cli {
namespace {

bool answered_yes(const flow::WriteQuestion& question) {
  if (question.table != nullptr) std::fprintf(stderr, "\n%s\n", text_of(question.table->record).c_str());
  const auto answer = typed_line(fmt::format("\n{}, {}? Type yes: ", question.operation, question.machine));
  return answer && *answer == "yes";
}

}  // namespace

flow::Consent consent_of(bool yes) {
  if (yes) return flow::Consent::given();
  const bool terminal = ::isatty(STDIN_FILENO) != 0 && ::isatty(STDERR_FILENO) != 0;
  return terminal ? flow::Consent::by_asking(answered_yes) : flow::Consent();
}

std::string text_of(const controller::UploadRecord& record) {
  std::string text;
  for (const auto& axis : record.difference) {
    text +=
        fmt::format("axis {}: largest change {:.2f} um at {:g} mm\n", axis.axis, axis.largest_um, axis.largest_at_mm);
    for (const auto& row : axis.curve) {
      text += fmt::format("  {:>10.3f} mm   old {:>8.2f} {:>8.2f}   new {:>8.2f} {:>8.2f} um\n", row.position_mm,
                          row.old_up_um, row.old_down_um, row.new_up_um, row.new_down_um);
    }
  }
  text += fmt::format("{} registers, CRC {:08x}, version {} -> {}\n", record.new_words.size(), record.crc,
                      record.old_sequence, record.sequence);
  text += fmt::format("state: {}", name_of(record.reached));
  if (record.dry_run) text += " (dry run: nothing was written)";
  return text;
}

}  // namespace zerodrift::cli

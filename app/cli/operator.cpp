#include "app/cli/operator.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "core/base/json.h"

namespace zerodrift::cli {
namespace {

using controller::OperatorAct;
using controller::OperatorAnswer;
using controller::OperatorRequest;
using nlohmann::json;

std::string motion_text(const OperatorRequest& request) {
  return fmt::format("spindle {:.0f} rpm, coolant {}", request.spindle_rpm, request.coolant_on ? "on" : "off");
}

/// What the person is to do.
std::string text_of(const OperatorRequest& request) {
  switch (request.act) {
    case OperatorAct::state:
      return "Is the compensation switched on at the control?";
    case OperatorAct::command:
      return fmt::format("Set {}, {}", motion_text(request),
                         request.path_cycle ? "and start the warm-up path" : "no warm-up path");
    case OperatorAct::move: {
      std::string target;
      for (const auto& [axis, position_mm] : request.target_mm) target += fmt::format(" {} {:.3f}", axis, position_mm);
      return fmt::format("Stop the path and move to{} mm ({})", target, motion_text(request));
    }
    case OperatorAct::switch_compensation:
      return request.compensation_on ? "Switch the compensation on" : "Switch the compensation off";
    case OperatorAct::offset:
      return fmt::format("Enter a test offset of X {:g}, Y {:g}, Z {:g} um", request.offset_um[0], request.offset_um[1],
                         request.offset_um[2]);
    case OperatorAct::load_table:
      return fmt::format("Load the table {} into the control", request.file);
    case OperatorAct::check_table:
      return "Read off the check value of the table that is active";
  }
  return "";
}

json to_json(const OperatorRequest& request, int number) {
  json line = {{"request", number}, {"act", controller::name_of(request.act)}, {"text", text_of(request)}};
  switch (request.act) {
    case OperatorAct::command:
    case OperatorAct::move:
      line["spindle_rpm"] = request.spindle_rpm;
      line["coolant_on"] = request.coolant_on;
      line["path"] = request.path_cycle ? "cycle" : "still";
      if (request.act == OperatorAct::move) line["target_mm"] = request.target_mm;
      break;
    case OperatorAct::switch_compensation:
      line["on"] = request.compensation_on;
      break;
    case OperatorAct::offset:
      line["offset_um"] = {{"X", request.offset_um[0]}, {"Y", request.offset_um[1]}, {"Z", request.offset_um[2]}};
      break;
    case OperatorAct::load_table:
      line["file"] = request.file;
      break;
    case OperatorAct::state:
    case OperatorAct::check_table:
      break;
  }
  return line;
}

Error declined(const OperatorRequest& request, const std::string& reason) {
  return {ErrorCode::operator_declined, {{"request", text_of(request)}, {"reason", reason}}};
}

bool asks_for_check(const OperatorRequest& request) {
  return request.act == OperatorAct::load_table || request.act == OperatorAct::check_table;
}

/// For a program that operates the machine.
class JsonOperator : public controller::Operator {
 public:
  Result<OperatorAnswer> ask(const OperatorRequest& request) override {
    const std::lock_guard lock(m_mutex);
    std::printf("%s\n", json_text(to_json(request, ++m_number)).c_str());
    std::fflush(stdout);
    std::string line;
    if (!std::getline(std::cin, line)) return fail(ErrorCode::operator_gone);
    ZD_TRY(const json answer, parse_json(line, "the operator's answer"));
    return from_json<OperatorAnswer>(answer, "the operator's answer", nullptr,
                                     [&](JsonObject& o) { return answer_of(o, request); });
  }

 private:
  OperatorAnswer answer_of(JsonObject& o, const OperatorRequest& request) const {
    if (o.integer("request", 1, 1'000'000'000) != m_number) {
      o.reject("request", std::to_string(o.integer("request", 1, 1'000'000'000)), std::to_string(m_number));
    }
    if (!o.flag_or("done", false)) throw JsonFault{declined(request, o.text_or("reason", "no reason given"))};
    OperatorAnswer answer;
    if (request.act == OperatorAct::state) {
      if (!o.has("compensation_on")) o.missing("compensation_on", "true or false");
      answer.compensation_on = o.flag_or("compensation_on", false);
    }
    if (asks_for_check(request)) answer.check = o.text("check");
    return answer;
  }

  std::mutex m_mutex;
  int m_number = 0;
};

/// A dialogue on the terminal: Enter when it is done, anything else is the reason why it cannot be.
class TerminalOperator : public controller::Operator {
 public:
  Result<OperatorAnswer> ask(const OperatorRequest& request) override {
    const std::lock_guard lock(m_mutex);
    OperatorAnswer answer;
    const std::string text = text_of(request);
    if (request.act == OperatorAct::state) {
      ZD_TRY(const std::string word, line_for(text + " Type on or off: "));
      if (word != "on" && word != "off") return fail(declined(request, "neither on nor off: " + word));
      answer.compensation_on = word == "on";
    } else if (asks_for_check(request)) {
      ZD_TRY(answer.check, line_for(text + ", then type the check value that the control shows: "));
    } else {
      ZD_TRY(const std::string reason, line_for(text + ", then press Enter (or type why it cannot be done): "));
      if (!reason.empty()) return fail(declined(request, reason));
    }
    return answer;
  }

 private:
  static Result<std::string> line_for(const std::string& question) {
    std::fprintf(stderr, "\r%s", question.c_str());
    std::string line;
    if (!std::getline(std::cin, line)) return fail(ErrorCode::operator_gone);
    return line;
  }

  std::mutex m_mutex;
};

}  // namespace

void add_operator_option(CLI::App& command, std::string& option) {
  command.add_option(
      "--operator", option,
      "Who operates a control without a link: - for a program by lines of JSON; default: a person at this terminal");
}

Result<std::shared_ptr<controller::Operator>> operator_of(const controller::Profile& profile,
                                                          const std::string& option) {
  if (!option.empty() && option != "-") {
    return fail(ErrorCode::bad_argument, {{"what", "--operator"}, {"found", option}, {"expected", "-"}});
  }
  if (!profile.manual) return std::shared_ptr<controller::Operator>();
  if (option == "-") return std::make_shared<JsonOperator>();
  const bool terminal = ::isatty(STDIN_FILENO) != 0 && ::isatty(STDERR_FILENO) != 0;
  if (!terminal) return fail(ErrorCode::operator_missing);
  return std::make_shared<TerminalOperator>();
}

}  // namespace zerodrift::cli

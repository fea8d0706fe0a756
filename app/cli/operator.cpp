#include "app/cli/operator.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <mutex>
#include <nlohmann/json.hpp>

#include "app/cli/typed.h"
#include "app/text/error_text.h"
#include "app/text/operator_text.h"
#include "core/base/json.h"

namespace zerodrift::cli {
namespace {

using controller::OperatorAct;
using controller::OperatorAnswer;
using controller::OperatorRequest;
using nlohmann::json;

constexpr int most_tries = 10;  // then the other end does not speak this language

/// What the person is to do. A program reads the figures, so they are those of the C locale.
std::string text_of(const OperatorRequest& request) {
  return operatorText(request, QLocale::c()).toStdString();
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
    json line = to_json(request, ++m_number);
    for (int tries = 1;; ++tries) {
      std::printf("%s\n", json_text(line).c_str());
      std::fflush(stdout);
      ZD_TRY(const auto typed, typed_line());
      if (!typed) return fail(ErrorCode::operator_gone);
      auto answer = answer_in(*typed, request);
      // Asked again where the answer cannot be understood; a no is an answer.
      if (answer || answer.error().code == ErrorCode::operator_declined || tries == most_tries) return answer;
      line["error"] = lineOf(answer.error()).toStdString();
    }
  }

 private:
  Result<OperatorAnswer> answer_in(const std::string& typed, const OperatorRequest& request) const {
    ZD_TRY(const json answer, parse_json(typed, "the operator's answer"));
    return from_json<OperatorAnswer>(answer, "the operator's answer", nullptr,
                                     [&](JsonObject& o) { return answer_of(o, request); });
  }

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
      std::string word;
      while (word != "on" && word != "off") {
        ZD_TRY(word, line_for(text + " Type on or off: "));
      }
      answer.compensation_on = word == "on";
    } else if (asks_for_check(request)) {
      ZD_TRY(answer.check, line_for(text + ": "));
    } else {
      ZD_TRY(const std::string reason, line_for(text + ", then press Enter (or type why it cannot be done): "));
      if (!reason.empty()) return fail(declined(request, reason));
    }
    return answer;
  }

 private:
  static Result<std::string> line_for(const std::string& question) {
    ZD_TRY(const auto line, typed_line("\r" + question));
    if (!line) return fail(ErrorCode::operator_gone);
    return *line;
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

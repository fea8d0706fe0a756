#include "app/machine/rig/operator_endpoint.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>

#include "app/machine/http/loopback_server.h"
#include "app/machine/nominal.h"
#include "app/text/error_text.h"
#include "core/base/clock.h"
#include "core/base/json.h"
#include "core/controller/table_words.h"

namespace zerodrift::machine {
namespace {

using nlohmann::json;

constexpr const char* body_name = "the request's body";
constexpr std::size_t largest_body = 1'000'000;
constexpr Seconds look_again{0.002};
constexpr Seconds longest_wait{60.0};  // wall time; the longest way takes 4 s even at speedup 1
constexpr double at_speed_rpm = 0.5;
constexpr int wrong_body = 400;
constexpr int wrong_state = 409;
const std::array<std::string, linear_axes> axis_letters{"X", "Y", "Z"};

struct Refusal {
  int status;
  std::string sentence;
};
using Answer = tl::expected<json, Refusal>;

tl::unexpected<Refusal> refuse_body(const Error& error) {
  return tl::unexpected(Refusal{wrong_body, textOf(error).sentence.toStdString()});
}

tl::unexpected<Refusal> refuse_state(std::string sentence) {
  return tl::unexpected(Refusal{wrong_state, std::move(sentence)});
}

std::string hex(std::uint32_t value) {
  return fmt::format("{:08x}", value);
}

/// Why a table is not taken, as the control's screen would say it.
std::string_view words_of(Rejection reason) {
  switch (reason) {
    case Rejection::switch_on:
      return "The compensation is on: switch it off first.";
    case Rejection::axes_move:
      return "The axes move: stop them first.";
    case Rejection::limit:
      return "A value of the table is beyond the control's limits.";
    case Rejection::count:
      return "The table is longer than the control holds.";
    default:
      return "The control cannot use this table.";
  }
}

/// The sensors by number, as the tables of this machine name them.
controller::Profile profile_of_table() {
  controller::Profile profile;
  for (int sensor = 1; sensor <= sensor_count; ++sensor) {
    controller::SensorProfile one;
    one.channel = fmt::format("T{}_C", sensor);
    profile.sensors.push_back(one);
  }
  return profile;
}

}  // namespace

class OperatorEndpoint::Impl {
 public:
  explicit Impl(LiveMachine& machine) : m_machine(machine) {
    m_machine.with([](Machine& now) { now.compensator().watchdog_s = std::numeric_limits<double>::infinity(); });
  }
  ~Impl() {
    m_stop.request_stop();
    m_server.stop();
  }

  Result<int> start() {
    m_server.http().set_payload_max_length(largest_body);
    serve("/spindle", &Impl::spindle);
    serve("/coolant", &Impl::coolant);
    serve("/cycle", &Impl::cycle);
    serve("/move", &Impl::move);
    serve("/compensation", &Impl::compensation);
    serve("/offset", &Impl::offset);
    serve("/table", &Impl::table);
    m_server.http().Get("/state", [this](const httplib::Request&, httplib::Response& response) {
      response.set_content(json_text(state()), "application/json");
    });
    ZD_TRY(m_port, m_server.start(0));
    return m_port;
  }
  int port() const { return m_port; }

 private:
  void serve(const char* path, Answer (Impl::*act)(const json& body)) {
    m_server.http().Post(path, [this, act](const httplib::Request& request, httplib::Response& response) {
      const auto body = parse_json(request.body, body_name);
      const Answer answer = body ? (this->*act)(*body) : Answer(refuse_body(body.error()));
      if (!answer) response.status = answer.error().status;
      response.set_content(json_text(answer ? *answer : json{{"error", answer.error().sentence}}), "application/json");
    });
  }

  /// What the reader takes out of the body; a key it does not ask for is an error too: a mistyped knob is not turned.
  template <class T, class Reader>
  static tl::expected<T, Refusal> taken(const json& body, Reader reader) {
    std::vector<std::string> unknown;
    auto value = from_json<T>(body, body_name, &unknown, reader);
    if (!value) return refuse_body(value.error());
    if (!unknown.empty()) {
      return refuse_body(Error{ErrorCode::bad_argument,
                               {{"what", body_name}, {"found", unknown.front()}, {"expected", "known keys alone"}}});
    }
    return *value;
  }
  static tl::expected<bool, Refusal> switch_in(const json& body) {
    return taken<bool>(body, [](JsonObject& o) {
      if (!o.has("on")) o.missing("on", "true or false");
      return o.flag_or("on", false);
    });
  }
  static tl::expected<Axes, Refusal> axes_in(const json& body, const Axes& limits) {
    return taken<Axes>(body, [&](JsonObject& o) {
      Axes axes{};
      for (std::size_t i = 0; i < axes.size(); ++i) {
        axes[i] = o.number(axis_letters[i], {-limits[i], limits[i], false, "a number within the axis's limits"});
      }
      return axes;
    });
  }

  /// Until the machine is so; a sentence when something else came between.
  template <class Condition>
  Answer wait_for(Condition condition, const char* otherwise) {
    const Seconds begin = host_clock().steady();
    while (!m_machine.with(condition)) {
      if (host_clock().steady() - begin > longest_wait || !host_clock().wait_for(look_again, m_stop.get_token())) {
        return refuse_state(otherwise);
      }
    }
    return json{{"done", true}};
  }

  Answer spindle(const json& body) {
    const auto rpm = taken<double>(body, [](JsonObject& o) {
      return o.number("rpm", {0.0, nominal::top_speed_rpm, false, "a number from 0 to the top speed"});
    });
    if (!rpm) return tl::unexpected(rpm.error());
    m_machine.with([&](Machine& now) { now.command_speed(*rpm); });
    return wait_for([&](const Machine& now) { return std::abs(now.speed_rpm() - *rpm) < at_speed_rpm; },
                    "The spindle did not come to this speed: another one was set meanwhile.");
  }

  Answer coolant(const json& body) {
    const auto on = switch_in(body);
    if (!on) return tl::unexpected(on.error());
    m_machine.with([&](Machine& now) { now.command_coolant(*on); });
    return json{{"done", true}};
  }

  Answer cycle(const json& body) {
    const auto on = switch_in(body);
    if (!on) return tl::unexpected(on.error());
    m_machine.with([&](Machine& now) {
      if (*on) now.motion().start_cycle();
      if (!*on && now.motion().cycling()) now.motion().stop();
    });
    return json{{"done", true}};
  }

  Answer move(const json& body) {
    const auto target_mm = axes_in(body, travel_mm);
    if (!target_mm) return tl::unexpected(target_mm.error());
    m_machine.with([&](Machine& now) { now.motion().move_to(*target_mm); });
    Answer arrived = wait_for([](const Machine& now) { return !now.motion().moving(); }, "The axes still move.");
    if (!arrived) return arrived;
    const Axes at_mm = m_machine.with([](const Machine& now) { return now.motion().position_mm(); });
    if (at_mm != *target_mm) return refuse_state("The axes did not arrive: they were sent elsewhere meanwhile.");
    return arrived;
  }

  Answer compensation(const json& body) {
    const auto on = switch_in(body);
    if (!on) return tl::unexpected(on.error());
    const std::scoped_lock lock(m_mutex);
    m_machine.with([&](Machine& now) {
      now.compensator().switch_to(*on);
      if (*on) apply_offset(now);
    });
    return json{{"done", true}};
  }

  Answer offset(const json& body) {
    constexpr double most = largest_compensation_um;
    const auto offset_um = axes_in(body, {most, most, most});
    if (!offset_um) return tl::unexpected(offset_um.error());
    const std::scoped_lock lock(m_mutex);
    m_offset_um = *offset_um;
    m_machine.with([&](Machine& now) {
      if (now.compensator().is_on()) apply_offset(now);
    });
    return json{{"done", true}};
  }
  void apply_offset(Machine& now) const {
    for (int axis = 0; axis < linear_axes; ++axis) now.compensator().write_offset(axis, m_offset_um[axis]);
  }

  Answer table(const json& body) {
    const auto table = compensation::table_from_json(body, body_name);
    if (!table) return refuse_body(table.error());
    const auto words = controller::encode_table(*table, profile_of_table(), table_capacity);
    if (!words) return refuse_body(words.error());
    const std::scoped_lock lock(m_mutex);
    if (++m_sequence == 0) ++m_sequence;  // 0 is no number of a table
    m_machine.with([&](Machine& now) {
      TableStore& store = now.table_store();
      for (std::size_t i = 0; i < words->size(); ++i) store.stage(static_cast<int>(i), (*words)[i]);
      store.count = static_cast<std::uint16_t>(words->size());
      store.crc = controller::crc_of_words(*words);
      store.sequence = m_sequence;
      store.commit(m_sequence);
    });
    Answer checked =
        wait_for([](const Machine& now) { return now.table_store().pending() == 0; }, "The table is still checked.");
    if (!checked) return checked;
    const auto reason = m_machine.with([](const Machine& now) { return now.table_store().reason(); });
    if (reason != Rejection::none) return refuse_state(std::string(words_of(reason)));
    m_check = body.contains("crc32") ? body.at("crc32").get<std::string>() : crc32_text(*table);
    m_version = table->version;
    json answer = check_values();
    answer["done"] = true;
    return answer;
  }

  /// What the control's screen shows of its table, to be typed back: `check` is the check sum of the table's file,
  /// `check_words` that of the words in the control.
  json check_values() {
    const std::uint32_t crc = m_machine.with([](const Machine& now) { return now.table_store().active_crc(); });
    return {{"check", m_check}, {"check_words", hex(crc)}, {"version", m_version}};
  }

  json state() {
    const std::scoped_lock lock(m_mutex);
    json state = check_values();
    m_machine.with([&](const Machine& now) {
      state["rpm"] = now.speed_rpm();
      state["coolant_on"] = now.coolant_on();
      state["cycle"] = now.motion().cycling();
      state["moving"] = now.motion().moving();
      state["compensation_on"] = now.compensator().is_on();
      for (std::size_t i = 0; i < axis_letters.size(); ++i) {
        state["position_mm"][axis_letters[i]] = now.motion().position_mm()[i];
        state["offset_um"][axis_letters[i]] = m_offset_um[i];
      }
    });
    return state;
  }

  LiveMachine& m_machine;
  std::mutex m_mutex;  // what is below, and the order of tables
  Axes m_offset_um{};  // entered by hand; in the axes while the compensation is on
  std::uint16_t m_sequence = 0;
  std::string m_check;
  int m_version = 0;
  std::stop_source m_stop;
  LoopbackServer m_server;
  int m_port = 0;
};

OperatorEndpoint::OperatorEndpoint(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
OperatorEndpoint::~OperatorEndpoint() = default;

int OperatorEndpoint::port() const {
  return m_impl->port();
}

Result<std::unique_ptr<OperatorEndpoint>> OperatorEndpoint::start(LiveMachine& machine) {
  auto impl = std::make_unique<Impl>(machine);
  ZD_CHECK(impl->start());
  return std::unique_ptr<OperatorEndpoint>(new OperatorEndpoint(std::move(impl)));
}

}  // namespace zerodrift::machine

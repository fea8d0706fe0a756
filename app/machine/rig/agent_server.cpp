#include "app/machine/rig/agent_server.h"

#include <charconv>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "app/machine/http/loopback_server.h"
#include "app/machine/rig/agent_documents.h"

namespace zerodrift::machine {
namespace {

constexpr double shortest_look_s = 0.02;
constexpr std::uint64_t usual_count = 100;  // of a sample request that says none (standard)
const char* const xml_type = "text/xml";
constexpr int not_found = 404;
constexpr int bad_request = 400;

/// A start later is another instance; two starts within a millisecond do not happen.
std::uint64_t new_instance() {
  return static_cast<std::uint64_t>(host_clock().utc().time_since_epoch().count());
}

/// The whole number of a query, or the value that stands for none; nothing for what is no such number.
std::optional<std::uint64_t> number_in(const httplib::Request& request, const char* key, std::uint64_t otherwise) {
  if (!request.has_param(key)) return otherwise;
  const std::string text = request.get_param_value(key);
  std::uint64_t value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

class AgentServer::Impl {
 public:
  Impl(LiveMachine& machine, double machine_second_s)
      : m_machine(machine),
        m_turn(std::max(machine_second_s, shortest_look_s)),
        m_documents("zerodrift-virtual-five-axis", new_instance()) {}
  ~Impl() {
    m_watcher.request_stop();
    m_server.stop();
  }

  Result<int> start() {
    const auto probe = [this](const httplib::Request&, httplib::Response& response) {
      answer(response, [this](UtcTime now) { return m_documents.probe(now); });
    };
    m_server.http().Get("/", probe);
    m_server.http().Get("/probe", probe);
    m_server.http().Get("/current", [this](const httplib::Request&, httplib::Response& response) {
      answer(response, [this](UtcTime now) { return m_documents.current(now); });
    });
    m_server.http().Get("/sample", [this](const httplib::Request& request, httplib::Response& response) {
      answer(response, [&](UtcTime now) { return sample(request, response, now); });
    });
    m_server.http().set_error_handler([this](const httplib::Request&, httplib::Response& response) {
      if (!response.body.empty()) return;
      answer(response, [this](UtcTime now) {
        return m_documents.error({"UNSUPPORTED", "The agent answers /probe, /current and /sample"}, now);
      });
    });
    ZD_TRY(m_port, m_server.start(0));
    m_watcher = std::jthread([this](const std::stop_token& stop) { watch(stop); });
    return m_port;
  }
  int port() const { return m_port; }

 private:
  /// Under the lock of the documents, which then know the machine of this moment.
  template <class Document>
  void answer(httplib::Response& response, Document document) {
    const std::scoped_lock lock(m_mutex);
    const UtcTime now = look();
    response.set_content(document(now), xml_type);
  }

  std::string sample(const httplib::Request& request, httplib::Response& response, UtcTime now) const {
    const auto from = number_in(request, "from", m_documents.first_sequence());
    const auto count = number_in(request, "count", usual_count);
    if (!from || !count) {
      response.status = bad_request;
      return m_documents.error({"INVALID_REQUEST", "'from' and 'count' must be whole numbers"}, now);
    }
    auto document = m_documents.sample(*from, *count, now);
    if (document) return *std::move(document);
    response.status = not_found;
    return m_documents.error(document.error(), now);
  }

  UtcTime look() {
    const UtcTime now = host_clock().utc();
    m_machine.with([&](const Machine& machine) { m_documents.observe(machine, now); });
    return now;
  }

  void watch(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      {
        const std::scoped_lock lock(m_mutex);
        look();
      }
      host_clock().wait_for(m_turn, stop);
    }
  }

  LiveMachine& m_machine;
  Seconds m_turn;
  std::mutex m_mutex;
  AgentDocuments m_documents;
  LoopbackServer m_server;
  int m_port = 0;
  std::jthread m_watcher;
};

AgentServer::AgentServer(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
AgentServer::~AgentServer() = default;

int AgentServer::port() const {
  return m_impl->port();
}

Result<std::unique_ptr<AgentServer>> AgentServer::start(LiveMachine& machine, double machine_second_s) {
  auto impl = std::make_unique<Impl>(machine, machine_second_s);
  ZD_CHECK(impl->start());
  return std::unique_ptr<AgentServer>(new AgentServer(std::move(impl)));
}

}  // namespace zerodrift::machine

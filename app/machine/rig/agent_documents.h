#pragma once
// What an MTConnect agent (standard ANSI/MTC1.4, version 1.5) tells of the machine: its data items, the observations it
// keeps, and the documents it answers with. An observation is kept where a value has changed, so each has a sequence
// number of its own.

#include <cstdint>
#include <deque>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "core/base/clock.h"

namespace zerodrift::machine {

class Machine;

/// What is wrong with a request, in the standard's words.
struct AgentError {
  std::string code;  // OUT_OF_RANGE, INVALID_REQUEST, UNSUPPORTED
  std::string text;
};

class AgentDocuments {
 public:
  static constexpr std::size_t buffer_size = 16384;

  /// instance: another one with each start of the agent, so that a client knows that the numbers begin anew.
  AgentDocuments(std::string device_uuid, std::uint64_t instance);

  /// Takes what has changed; observations already made stay as they are.
  void observe(const Machine& machine, UtcTime now);

  std::string probe(UtcTime now) const;
  /// The last observation of each data item.
  std::string current(UtcTime now) const;
  /// At most so many observations from this sequence number on; out of range for one that is not kept (any more).
  tl::expected<std::string, AgentError> sample(std::uint64_t from, std::uint64_t count, UtcTime now) const;
  std::string error(const AgentError& error, UtcTime now) const;

  std::uint64_t first_sequence() const;
  std::uint64_t next_sequence() const { return m_next; }

 private:
  struct Observation {
    std::uint64_t sequence = 0;
    std::size_t item = 0;
    std::string value;
    UtcTime time;
  };
  struct Header;
  std::string streams(const std::vector<const Observation*>& observations, std::uint64_t next, UtcTime now) const;

  std::string m_device_uuid;
  std::uint64_t m_instance;
  std::uint64_t m_next = 1;
  std::deque<Observation> m_buffer;
  std::vector<Observation> m_last;  // by item
};

}  // namespace zerodrift::machine

// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/stuck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "platform/machine/machine.hpp"

namespace parallax {
namespace {

// The engine that uses the port.
std::string engine(const MemoryPort& port) { return port.master->get_parent_object()->name(); }

std::string unanswered(const Machine& machine, const MemoryPort& port, const BusRequest& request) {
  const std::string what = fmt::format("the {} of {} bytes at {:#x}", request.write ? "write" : "read",
                                       request.bytes, request.address);
  return fmt::format(
      "  the memory has not {} {} at port {}, sent {} ns after the start, in cycle {} of the "
      "core's clock\n",
      request.taken ? "answered" : "taken", what, port.name, request.sent.to_seconds() * 1e9,
      machine.core_clock().cycle_at_or_after(request.sent).count());
}

std::string undone(const Machine& machine, const Wait& wait) {
  const StreamBase& stream = *wait.stream;
  const bool in_kernel_time = (wait.on_full ? stream.reader() : stream.writer()) == nullptr;
  const std::uint64_t token = wait.on_full ? stream.statistics().read : stream.statistics().written;
  const Cycles last = wait.on_full ? stream.last_read() : stream.last_written();
  const std::string place = machine.pipeline().place(stream.basename(), token);
  return fmt::format(
      "  {}{} does not {} token {}{} of stream {}, since cycle {} of clock {}; {} waits for it\n", wait.other,
      in_kernel_time ? " (in kernel time)" : "", wait.on_full ? "read" : "write", token,
      place.empty() ? "" : " (" + place + ")", stream.name(), std::max(last, Cycles(0)).count(),
      (wait.on_full ? stream.reader_clock() : stream.writer_clock()).name(), wait.waiter);
}

}  // namespace

std::string describe_ends(const Machine& machine) {
  std::string text;
  std::vector<std::string> at_memory;
  for (const MemoryPort* port : machine.ports()) {
    const std::optional<BusRequest> oldest = port->master->oldest();
    if (!oldest) continue;
    text += unanswered(machine, *port, *oldest);
    at_memory.push_back(engine(*port));
  }
  const std::vector<Wait> waits = machine.dataflow().waits();
  for (const Wait& wait : waits) {
    const bool goes_on = std::any_of(waits.begin(), waits.end(),
                                     [&](const Wait& other) { return other.waiter == wait.other; }) ||
                         std::find(at_memory.begin(), at_memory.end(), wait.other) != at_memory.end();
    if (!goes_on) text += undone(machine, wait);
  }
  return text;
}

}  // namespace parallax

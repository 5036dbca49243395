// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/fifo_grants.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace parallax {
namespace {

// Of one side. Says in which cycle what was granted is taken back, -1: never.
std::int64_t grants_of(const FifoSide& side, std::vector<FifoGrants::Grant>& grants,
                       std::vector<std::int64_t>& dates) {
  grants.push_back({});
  for (std::size_t i = 0; i < side.edges.size(); ++i) {
    const auto cycle = static_cast<std::int64_t>(i);
    FifoGrants::Grant& next = grants.back();
    if (!side.granted[i]) {
      if (next.first) return cycle;
      continue;
    }
    if (!next.first) next.first = cycle;
    if (!side.wanted[i]) continue;
    dates.push_back(cycle);
    grants.push_back({cycle + 1, std::nullopt});
  }
  // Not even a cycle is left in which the next one could have been granted.
  if (grants.back().since >= static_cast<std::int64_t>(side.edges.size())) grants.pop_back();
  return -1;
}

// Edges in (from, up to that of `cycle`].
std::int64_t edges_after(const std::vector<std::int64_t>& edges, std::int64_t from, std::int64_t cycle) {
  const auto first = std::upper_bound(edges.begin(), edges.end(), from) - edges.begin();
  return cycle - first + 1;
}

}  // namespace

FifoGrants::FifoGrants(const FifoCapture& capture)
    : file(capture.file),
      two_clocks(capture.two_clocks),
      write_edges_(capture.write.edges),
      read_edges_(capture.read.edges) {
  // The earliest one: what comes after it may be its consequence.
  std::int64_t fault_time = 0;
  const auto note = [&](const char* what, bool of_reader, std::size_t token, std::int64_t cycle) {
    const std::int64_t time = (of_reader ? read_edges_ : write_edges_)[static_cast<std::size_t>(cycle)];
    if (!fault.empty() && fault_time <= time) return;
    fault = what;
    fault_of_reader = of_reader;
    fault_token = token;
    fault_cycle = cycle;
    fault_time = time;
  };
  if (const std::int64_t cycle = grants_of(capture.write, slots, write_dates); cycle >= 0) {
    note("it takes back that it can be written, without a write", false, write_dates.size(), cycle);
  }
  if (const std::int64_t cycle = grants_of(capture.read, tokens, read_dates); cycle >= 0) {
    note("it takes back a token that can be read, before it is read", true, read_dates.size(), cycle);
  }
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (!tokens[i].first) continue;
    const bool is_written =
        i < write_dates.size() && to_reader(write_dates[i], *tokens[i].first) >= (two_clocks ? 1 : 0);
    if (!is_written) note("it has a token to be read that nobody has written", true, i, *tokens[i].first);
  }
}

std::int64_t FifoGrants::to_reader(std::int64_t written, std::int64_t read) const {
  if (!two_clocks) return read - written;
  return edges_after(read_edges_, write_edges_[static_cast<std::size_t>(written)], read);
}

std::int64_t FifoGrants::to_writer(std::int64_t read, std::int64_t written) const {
  if (!two_clocks) return written - read;
  return edges_after(write_edges_, read_edges_[static_cast<std::size_t>(read)], written);
}

bool FifoGrants::was_read_by(std::size_t token, std::int64_t cycle) const {
  return to_writer(read_dates[token], cycle) >= (two_clocks ? 1 : 0);
}

std::int64_t FifoGrants::last_read_cycle() const { return static_cast<std::int64_t>(read_edges_.size()) - 1; }
std::int64_t FifoGrants::last_write_cycle() const {
  return static_cast<std::int64_t>(write_edges_.size()) - 1;
}

std::size_t FifoGrants::fill(bool of_reader, std::int64_t cycle) const {
  const std::vector<std::int64_t>& edges = of_reader ? read_edges_ : write_edges_;
  const std::int64_t now = edges[static_cast<std::size_t>(cycle)];
  const auto before = [&](const std::vector<std::int64_t>& dates, const std::vector<std::int64_t>& times) {
    return static_cast<std::size_t>(
        std::partition_point(dates.begin(), dates.end(),
                             [&](std::int64_t date) { return times[static_cast<std::size_t>(date)] < now; }) -
        dates.begin());
  };
  const std::size_t written = before(write_dates, write_edges_);
  return written - std::min(written, before(read_dates, read_edges_));  // a faulty one may read more
}

std::size_t FifoGrants::most_held() const {
  std::size_t most = 0;
  for (std::size_t i = 0; i < write_dates.size(); ++i) most = std::max(most, fill(false, write_dates[i]) + 1);
  return most;
}

}  // namespace parallax

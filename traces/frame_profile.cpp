// SPDX-License-Identifier: Apache-2.0
#include "traces/frame_profile.hpp"

#include <algorithm>

namespace parallax {
namespace {

constexpr std::size_t kBins = 200;

}  // namespace

void FrameProfile::port_row(const PortRow& row) {
  rows_.push_back(row);
  if (parts_.ports[row.port].name != by_row_) return;
  if (!frame_.empty() && frame_.back().position.frame != row.position.frame) {
    whole_frame_.swap(frame_);
    frame_.clear();
  }
  frame_.push_back(row);
}

void FrameProfile::frame_step(std::int64_t, FrameStep step, Picoseconds time) {
  if (step != FrameStep::kAtHost) return;
  begin_ = end_;
  end_ = time;
  last_.swap(rows_);
  rows_.clear();
}

nlohmann::ordered_json FrameProfile::to_json() const {
  if (begin_ < Picoseconds(0)) return nullptr;
  const double period = (end_ - begin_).real();
  const double bin = period / static_cast<double>(kBins);
  std::vector<std::vector<double>> bytes(parts_.ports.size(), std::vector<double>(kBins));
  for (const PortRow& row : last_) {
    // Spread over the time in which they came; what began in the period before counts here from its begin on.
    const double from = std::max(0.0, (row.begin - begin_).real());
    const double to = std::min(period, std::max(from, (row.end - begin_).real()));
    auto number = static_cast<std::size_t>(from / bin);
    for (; number < kBins && static_cast<double>(number) * bin <= to; ++number) {
      const double low = std::max(from, static_cast<double>(number) * bin);
      const double high = std::min(to, static_cast<double>(number + 1) * bin);
      const double share = to > from ? std::max(0.0, high - low) / (to - from) : 1;
      bytes[row.port][number] += static_cast<double>(row.bytes) * share;
    }
  }
  auto rows = nlohmann::ordered_json::object();
  for (const char* what : {"bytes", "latency_mean", "latency_longest"})
    rows[what] = nlohmann::ordered_json::array();
  for (const PortRow& row : whole_frame_) {
    rows["bytes"].push_back(row.bytes);
    rows["latency_mean"].push_back(
        row.bursts == 0 ? 0 : row.latency.count() / static_cast<std::int64_t>(row.bursts));
    rows["latency_longest"].push_back(row.longest_latency.count());
  }
  nlohmann::ordered_json tree{{"period", (end_ - begin_).count()}, {"bin", bin}};
  for (std::size_t port = 0; port < bytes.size(); ++port) {
    auto list = nlohmann::ordered_json::array();
    for (const double value : bytes[port]) list.push_back(value * 1e6 / bin);  // B/ps are 10^6 MB/s
    tree["bandwidth"][parts_.ports[port].name] = std::move(list);
  }
  tree["rows"][by_row_] = std::move(rows);
  return tree;
}

}  // namespace parallax

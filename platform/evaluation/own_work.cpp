// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/own_work.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace parallax {
namespace {

// A part whose work for a frame is the same whatever else is faster, and what makes that less.
struct OwnWork {
  const char* part;
  std::vector<Relief> relieved_by;
  bool of_lost_frames = false;  ///< too
};

const std::vector<OwnWork>& own_work() {
  static const std::vector<OwnWork> all{
      {"camera_frame_rate", {Relief::kCamera}, true},
      {"host", {Relief::kHost}},
      {"link", {Relief::kLink, Relief::kLinkClock}},
      {"matching", {Relief::kCoreClock, Relief::kMatchingInterval, Relief::kPathStorage, Relief::kFrameGap}}};
  return all;
}

// What is faulty is so whatever else is faster; what is lost may come through.
bool any_lost(const MetricGroup& metrics) {
  return metrics.number_or("camera/dropped_frames", 0) + metrics.number_or("camera/missed_triggers", 0) > 0;
}

}  // namespace

double most_gain(const Relaxation& relaxation, const MetricGroup& metrics) {
  double most = std::numeric_limits<double>::infinity();
  for (const OwnWork& work : own_work()) {
    if (work.of_lost_frames && any_lost(metrics)) continue;
    const bool relieves = std::any_of(relaxation.limits.begin(), relaxation.limits.end(), [&](Relief limit) {
      return std::find(work.relieved_by.begin(), work.relieved_by.end(), limit) != work.relieved_by.end();
    });
    const double share = metrics.number_or(std::string("limit/utilisation_by_part/") + work.part, 0) / 100;
    if (!relieves && share > 0) most = std::min(most, 100 * (1 / share - 1));
  }
  return most;
}

}  // namespace parallax

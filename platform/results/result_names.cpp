// SPDX-License-Identifier: Apache-2.0
#include "platform/results/result_names.hpp"

#include <algorithm>
#include <utility>

namespace parallax {
namespace {

template <class... Names>
bool is_one_of(const std::string& name, const Names&... names) {
  return ((name == names) || ...);
}

/// "frame_0012" for "frame_": at least four digits.
bool is_numbered(const std::string& name, const std::string& prefix) {
  return name.size() >= prefix.size() + 4 && name.compare(0, prefix.size(), prefix) == 0 &&
         name.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
}

/// The folder and the file's name in it.
std::pair<std::string, std::string> split(const std::string& path) {
  const std::size_t slash = path.find('/');
  if (slash == std::string::npos) return {"", path};
  return {path.substr(0, slash), path.substr(slash + 1)};
}

bool is_of_frame(const ResultPlan& plan, const std::string& name) {
  if (!plan.frames) return false;
  if (name == "error.png") return plan.truth;
  if (name == "points.ply") return plan.points;
  return is_one_of(name, "disparity.png", "disparity_color.png", "causes.png", "cause_labels.png",
                   "left_rectified.png", "side_by_side.png", "disparity.bin");
}

/// "circuit_census.vcd", "circuit_census.pftrace", "circuit_census_left_codes.png"
bool is_of_circuit(const std::string& name) {
  const std::string begin = "circuit_";
  if (name.compare(0, begin.size(), begin) != 0) return false;
  const std::size_t dot = name.find('.');
  return dot != std::string::npos && is_one_of(name.substr(dot), ".vcd", ".pftrace", ".png");
}

bool is_of_run(const ResultPlan& plan, const std::string& name) {
  if (name == "timing.json" || name == "profile.json") return plan.timing;
  if (name == "relaxations.json") return plan.relaxations;
  if (name == "report.html") return plan.report;
  if (is_of_circuit(name)) return plan.circuits;
  return name == "strip.gif" && plan.frames && plan.sequence;
}

bool is_trace(const std::string& format, const std::string& name) {
  if (format == "csv") {
    return is_one_of(name, "trace_rows.csv", "trace_fifos.csv", "trace_ports.csv", "trace_frames.csv",
                     "trace_firings.csv", "trace_tokens.csv", "trace_bursts.csv");
  }
  return name == "trace." + (format == "perfetto" ? "pftrace" : format);
}

}  // namespace

bool is_planned(const ResultPlan& plan, const std::string& path) {
  const auto [folder, name] = split(path);
  if (!folder.empty()) {
    if (is_numbered(folder, "point_")) {
      return plan.sweep && (name == "timing.json" || (name == "relaxations.json" && plan.relaxations));
    }
    return plan.sequence && is_numbered(folder, "frame_") && is_of_frame(plan, name);
  }
  return is_of_run(plan, name) || (!plan.sequence && is_of_frame(plan, name)) ||
         std::any_of(plan.traces.begin(), plan.traces.end(),
                     [&result = name](const std::string& format) { return is_trace(format, result); });
}

bool is_result_name(const std::string& path) {
  ResultPlan any{true, false, true, true, true, true, true, true, true, {"perfetto", "vcd", "csv", "json"}};
  if (is_planned(any, path)) return true;
  any.sequence = true;
  return is_planned(any, path);
}

}  // namespace parallax

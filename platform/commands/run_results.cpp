// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/run_results.hpp"

#include <fmt/format.h>

#include "platform/commands/command_context.hpp"
#include "platform/config/config_writer.hpp"
#include "platform/evaluation/evaluation_result.hpp"
#include "platform/report/report_file.hpp"
#include "platform/results/run_summary.hpp"
#include "traces/json_text.hpp"

namespace parallax {

nlohmann::ordered_json RunResults::write(const MetricGroup& metrics, const RunProfile* profile,
                                         RunFrames& frames) const {
  nlohmann::ordered_json tree = timing_json(metrics, to_json(configuration_, false));
  if (folder_ == nullptr) return tree;
  if (profile != nullptr) folder_->write("profile.json", json_text(profile->to_json()) + "\n");
  folder_->write("timing.json", json_text(tree, 2) + "\n");
  frames.complete();
  folder_->publish();
  if (options_.report) {
    folder_->write("report.html", report_of(folder_->path()));
    folder_->publish();
  }
  return tree;
}

void RunResults::print(const MetricGroup& metrics, const nlohmann::ordered_json& tree) const {
  if (options_.json) {
    context_.out << json_text(tree, 2) << '\n';
    return;
  }
  if (context_.verbosity == Verbosity::kQuiet) return;
  context_.out << summary(metrics);
  if (context_.verbosity == Verbosity::kVerbose) context_.out << stage_summary(metrics);
  if (folder_ != nullptr) context_.out << fmt::format("results             {}\n", options_.out.string());
  if (options_.report)
    context_.out << fmt::format("report              {}\n", (options_.out / "report.html").string());
}

}  // namespace parallax

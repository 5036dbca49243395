// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/compare_runs_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/report/comparison_page.hpp"
#include "platform/report/run_comparison.hpp"
#include "platform/results/file_identity.hpp"
#include "platform/results/output_file.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"

namespace parallax {
namespace {

struct CompareOptions {
  std::string a;
  std::string b;
  bool all = false;
  bool json = false;
  std::string html;
};

std::vector<NamedInput> inputs_of(const CompareOptions& options) {
  std::vector<NamedInput> inputs;
  for (const std::filesystem::path run : {options.a, options.b}) {
    for (const auto& file : {run, run / "timing.json", run / "profile.json", run / "relaxations.json"})
      inputs.push_back({file.string(), file});
  }
  return inputs;
}

// Where a number should be there may be a text. Which file is damaged shows when each is compared with
// itself.
template <class Make>
auto of_whole(const RunReport& a, const RunReport& b, const Make& make) -> decltype(make(a, b)) {
  const auto attempt = [&make](const RunReport& first, const RunReport& second) {
    try {
      return make(first, second);
    } catch (const MetricError& damage) {
      throw UserError(
          fmt::format("{}: damaged, {}; run parallax again", first.path, excerpt(damage.what(), 200)));
    }
  };
  attempt(a, a);
  attempt(b, b);
  return attempt(a, b);
}

RunComparison compared(const RunReport& a, const RunReport& b) {
  return of_whole(a, b,
                  [](const RunReport& first, const RunReport& second) { return compare(first, second); });
}

std::string compared_page(const RunComparison& comparison, const RunReport& a, const RunReport& b) {
  return of_whole(a, b, [&](const RunReport& first, const RunReport& second) {
    return comparison_page(comparison, first, second);
  });
}

}  // namespace

void add_compare_runs_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App& command = *app.add_subcommand(
      "compare-runs", "What changed between two runs: configuration, results, stage by stage");
  command.add_option("A", options->a, "Folder of a run's results, or its timing.json")->required();
  command.add_option("B", options->b, "Likewise, of the other run")->required();
  command.add_flag("--all", options->all, "Every number that changed");
  add_json_option(command, options->json);
  command.add_option("--html", options->html, "Write the comparison to this file, a page of HTML")
      ->type_name("FILE");
  command.callback([options, &context] {
    context.action = [options, &context] {
      refuse_to_replace(inputs_of(*options), "--html " + options->html, options->html);
      const RunReport a = read_run_report(options->a), b = read_run_report(options->b);
      const RunComparison comparison = compared(a, b);
      if (!options->html.empty()) write_file(options->html, compared_page(comparison, a, b));
      if (options->json) {
        context.out << json_text(to_json(comparison), 2) << '\n';
      } else if (context.verbosity != Verbosity::kQuiet) {
        context.out << to_text(comparison, options->all);
      }
      return 0;
    };
  });
}

}  // namespace parallax

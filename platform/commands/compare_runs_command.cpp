// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/compare_runs_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>
#include <string>

#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/report/comparison_page.hpp"
#include "platform/report/run_comparison.hpp"
#include "platform/results/output_file.hpp"
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
      const RunReport a = read_run_report(options->a), b = read_run_report(options->b);
      const RunComparison comparison = compare(a, b);
      if (!options->html.empty()) write_file(options->html, comparison_page(comparison, a, b));
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

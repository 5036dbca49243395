// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/validate_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/config/preset.hpp"
#include "platform/results/output_folder.hpp"
#include "platform/results/progress.hpp"
#include "platform/validation/sensitivity.hpp"
#include "platform/validation/validation.hpp"
#include "traces/json_text.hpp"

namespace parallax {
namespace {

struct ValidateOptions {
  std::vector<std::string> rows = published_row_files();
  std::string preset;
  std::vector<std::string> assignments;
  std::filesystem::path out;
  bool sensitivity = false;
  bool json = false;
};

std::vector<PublishedRow> read_rows(const ValidateOptions& options) {
  std::vector<PublishedRow> rows;
  for (const std::string& name : options.rows) {
    const PublishedRows file = read_published_rows(name, preset_folders());
    for (PublishedRow row : file.rows) {
      if (row.preset.empty()) row.preset = file.preset;
      if (row.preset == file.preset) {
        if (!options.preset.empty()) row.preset = options.preset;
        // What a row sets is its operating point: it wins over --set.
        std::vector<std::string> all = options.assignments;
        all.insert(all.end(), row.assignments.begin(), row.assignments.end());
        row.assignments = std::move(all);
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

int validate(const ValidateOptions& options, CommandContext& context) {
  const std::vector<PublishedRow> rows = read_rows(options);
  std::optional<OutputFolder> folder;
  if (!options.out.empty()) {
    FolderPlan plan;
    plan.writes = [](const std::string& name) { return name == "validation.json"; };
    folder.emplace(options.out, std::move(plan));
  }
  const Interruption interruption;
  const auto interrupted = [&interruption] { return interruption.requested(); };
  Notes notes(context);
  auto progress =
      std::make_unique<Progress>(context.err, shows_progress(context), "rows", rows.size(), notes.sink());
  const std::vector<ValidatedRow> validated = validate_rows(
      rows, [&] { progress->advance(); }, interrupted);
  progress.reset();
  nlohmann::ordered_json tree = to_json(validated);
  std::string text = table(validated);
  if (options.sensitivity && !interruption.requested()) {
    const std::vector<ValidatedRow> moved = rows_with_fitted_parameters(validated);
    const std::vector<Sensitivity> found = sensitivities(moved, interrupted);
    tree["sensitivity"] = to_json(moved, found);
    text += "\n" + table(moved, found);
  }
  if (interruption.requested()) {
    return interrupted_after(fmt::format("{} of {} rows", validated.size(), rows.size()), context,
                             interruption);
  }
  if (folder) {
    folder->write("validation.json", json_text(tree, 2) + "\n");
    folder->publish();
  }
  if (options.json) {
    context.out << json_text(tree, 2) << '\n';
  } else if (context.verbosity != Verbosity::kQuiet) {
    context.out << text;
  }
  return all_within(validated) ? 0 : kNotAsExpected;
}

}  // namespace

void add_validate_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<ValidateOptions>();
  CLI::App& command = *app.add_subcommand(
      "validate", "Published figures beside what the model predicts; 1 if one is outside its tolerance");
  command.add_option("--rows", options->rows, "Files of published rows, by name or path")
      ->capture_default_str();
  command.add_option("--preset", options->preset,
                     "Machine to validate in place of the one that the rows are for");
  command.add_option("--set", options->assignments, "A configuration key of that machine: key=value")
      ->allow_extra_args(false);
  command.add_flag("--sensitivity", options->sensitivity,
                   "Also how the predictions move when a fitted parameter changes by 10 %");
  command.add_option("--out", options->out, "Folder for validation.json");
  add_json_option(command, options->json);
  command.callback(
      [options, &context] { context.action = [options, &context] { return validate(*options, context); }; });
}

}  // namespace parallax

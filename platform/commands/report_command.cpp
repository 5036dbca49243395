// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/report_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <system_error>
#include <utility>

#include "platform/commands/command_context.hpp"
#include "platform/report/report_file.hpp"
#include "platform/results/output_folder.hpp"
#include "tlm/error.hpp"

namespace parallax {

void add_report_command(CLI::App& app, CommandContext& context) {
  const auto folder = std::make_shared<std::string>();
  CLI::App& command =
      *app.add_subcommand("report", "One page of HTML, report.html, from the folder of a run's results");
  command.add_option("DIR", *folder, "Folder of a run's results")->required();
  command.callback([folder, &context] {
    context.action = [folder, &context] {
      std::error_code error;
      if (std::filesystem::is_regular_file(*folder, error))
        throw UserError(fmt::format("{} is a file, a report is made of a run's folder", *folder));
      const std::string page = report_of(*folder);
      FolderPlan plan;
      plan.writes = [](const std::string& name) { return name == "report.html"; };
      OutputFolder out(*folder, std::move(plan));
      out.write("report.html", page);
      out.publish();
      if (context.verbosity != Verbosity::kQuiet)
        context.out << fmt::format("report              {}\n",
                                   (std::filesystem::path(*folder) / "report.html").string());
      return 0;
    };
  });
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/cli.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <new>
#include <opencv2/core/utility.hpp>
#include <string>
#include <systemc>
#include <vector>

#include "platform/commands/ask_command.hpp"
#include "platform/commands/circuit_command.hpp"
#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/commands/compare_command.hpp"
#include "platform/commands/compare_runs_command.hpp"
#include "platform/commands/config_command.hpp"
#include "platform/commands/estimate_command.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/explore_command.hpp"
#include "platform/commands/fifo_command.hpp"
#include "platform/commands/fifos_command.hpp"
#include "platform/commands/glossary_command.hpp"
#include "platform/commands/map_command.hpp"
#include "platform/commands/memory_command.hpp"
#include "platform/commands/parse_line.hpp"
#include "platform/commands/registers_command.hpp"
#include "platform/commands/report_command.hpp"
#include "platform/commands/run_command.hpp"
#include "platform/commands/scene_command.hpp"
#include "platform/commands/stage_command.hpp"
#include "platform/commands/validate_command.hpp"
#include "platform/commands/vectors_command.hpp"
#include "platform/results/version.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

int fail(std::ostream& err, const std::string& line) {
  err << "parallax: error: " << one_line(line) << '\n';
  return kBadInput;
}

// A fault that no input should be able to cause: one line, never an abort.
int fail_internally(std::ostream& err, const std::string& line) {
  err << "parallax: internal error: " << one_line(line) << '\n';
  return kInternalError;
}

}  // namespace

std::string one_line(const std::string& text) {
  constexpr std::size_t kLongest = 2000;
  return excerpt(text, kLongest);
}

void add_commands(CLI::App& app, CommandContext& context) {
  add_run_command(app, context);
  add_explore_command(app, context);
  add_merge_command(app, context);
  add_ask_command(app, context);
  add_config_command(app, context);
  add_map_command(app, context);
  add_scene_command(app, context);
  add_memory_command(app, context);
  add_registers_command(app, context);
  add_glossary_command(app, context);
  add_report_command(app, context);
  add_compare_runs_command(app, context);
  add_validate_command(app, context);
  add_vectors_command(app, context);
  add_compare_command(app, context);
  add_circuit_command(app, context);
  add_fifo_command(app, context);
  add_fifos_command(app, context);
  add_stage_command(app, context);
  add_estimate_command(app, context);
  refuse_empty_values(app);
}

int run_command_line(int argc, const char* const* argv) {
  return run_command_line(argc, argv, std::cout, std::cerr);
}

int run_command_line(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  // Timing is evaluated in forks of this process, and a fork of one with threads may hang on their locks.
  cv::setNumThreads(0);

  CLI::App app("A SystemC model of an FPGA that turns stereo image pairs into disparity maps.", "parallax");
  app.set_version_flag("--version", fmt::format("parallax {} ({})", version(), revision()),
                       "Print the version");
  app.set_help_all_flag("--help-all", "Print the help of all commands");
  bool quiet = false, verbose = false;
  app.add_flag("-q,--quiet", quiet, "Print errors only, and what was asked for (--json)");
  app.add_flag("-v,--verbose", verbose, "Print more")->excludes("--quiet");
  app.fallthrough();  // the options above may follow the command

  CommandContext context{out, err, CommandLine(argc, argv)};
  add_commands(app, context);

  try {
    if (parse_line(app, argc, argv, out)) {
      if (!out.flush()) throw UserError("cannot write to standard output");
      return 0;
    }
    if (quiet) context.verbosity = Verbosity::kQuiet;
    if (verbose) context.verbosity = Verbosity::kVerbose;
    if (!context.action) throw UserError("no command given; parallax --help lists them");
    const int code = context.action();
    if (!out.flush()) throw UserError("cannot write to standard output");
    return code;
  } catch (const UserError& error) {
    return fail(err, error.what());
  } catch (const sc_core::sc_report& report) {
    return fail_internally(err, fmt::format("{}: {}", report.get_msg_type(), report.get_msg()));
  } catch (const std::bad_alloc&) {
    return fail_internally(err, "out of memory");
  } catch (const std::exception& error) {
    return fail_internally(err, error.what());
  }
}

}  // namespace parallax

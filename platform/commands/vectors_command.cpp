// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/vectors_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <set>
#include <string>

#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/input_options.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/commands/run_folder.hpp"
#include "platform/commands/run_images.hpp"
#include "platform/commands/simulation.hpp"
#include "platform/config/preset.hpp"
#include "platform/cosim/circuit_stub.hpp"
#include "platform/cosim/test_bench.hpp"
#include "platform/cosim/vector_capture.hpp"
#include "platform/input/run_input.hpp"
#include "platform/machine/machine.hpp"
#include "platform/results/deadlock_report.hpp"
#include "platform/results/progress.hpp"
#include "traces/json_text.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

struct VectorsOptions {
  RunOptions run;
  std::string stage;
  VectorExtras extras;
};

bool ends_with(const std::string& name, const std::string& ending) {
  return name.size() > ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

/// Whether a file has the name of one that some `parallax vectors` writes.
bool is_of_vectors(const std::string& name) {
  if (name == VectorManifest::kFile) return true;
  return std::any_of(kVectorEndings.begin(), kVectorEndings.end(),
                     [&](const char* ending) { return ends_with(name, ending); });
}

std::string text(const VectorManifest& manifest) {
  std::string out =
      fmt::format("stage               {}, a firing every {} cycle{}, latency {}, reads {} token{} ahead\n",
                  manifest.stage, manifest.interval, manifest.interval == 1 ? "" : "s", manifest.latency,
                  manifest.look_ahead, manifest.look_ahead == 1 ? "" : "s");
  for (const VectorStream& stream : manifest.streams) {
    out += fmt::format("  {:17} {:3} {} tokens of {} bits\n", stream.name,
                       stream.is_input ? "in"
                       : stream.is_tap ? "tap"
                                       : "out",
                       grouped(std::to_string(stream.tokens)), stream.shape.format.width().count());
  }
  return out;
}

int write_vectors(const VectorsOptions& options, CommandContext& context) {
  check_options(options.run);
  Notes notes(context, true);
  const Configuration configuration = load_configuration(options.run.configuration, preset_folders());
  const RunImages images(options.run, configuration.machine, notes.sink());
  const Interruption interruption;
  Simulation simulation(images.frames(), [&] { return interruption.requested(); });
  auto progress = std::make_unique<Progress>(context.err, shows_progress(context), "frames", images.frames(),
                                             notes.sink());

  MachineInput input;
  input.width = images.padded().width;
  input.height = images.padded().height;
  input.map = &images.map();
  input.frames = images.frames();
  input.expose = [&](std::int64_t frame) {
    return simulation.at_exposure(
        frame, [&] { return frame < images.frames() ? images.load(frame) : StereoFrame{}; });
  };
  std::int64_t delivered = 0;
  input.deliver = [&](const FrameResult&) {
    simulation.at_delivery([&] {
      ++delivered;
      progress->advance();
    });
  };
  const Machine machine("machine", configuration.machine, input);
  check_vectors(machine, options.stage, "--stage");
  if (options.extras.taps) check_taps(machine, options.stage, "--taps");

  FolderPlan plan = folder_plan(options.run, ResultPlan{});
  plan.writes = [names = vector_file_names(machine, options.stage, options.extras)](const std::string& name) {
    return names.count(name) > 0;
  };
  plan.replaces = is_of_vectors;
  OutputFolder folder(options.run.out, plan);
  VectorCapture capture(machine, options.stage, options.extras, folder);
  notes.begin();
  simulation.run([](double) {});
  progress.reset();
  if (simulation.stopped())
    return interrupted_after(fmt::format("{} of {} frames", delivered, images.frames()), context,
                             interruption);
  if (!machine.finished()) {
    context.err << "parallax: error: " << message(find_deadlock(machine));
    return kNotAsExpected;
  }
  const VectorManifest manifest = capture.finish(images.frames());
  const std::string json = json_text(to_json(manifest), 2) + "\n";
  folder.write(VectorManifest::kFile, json);
  folder.write(options.stage + "_tb.sv", test_bench(manifest));
  folder.write(options.stage + "_stub.sv", circuit_stub(manifest));
  folder.publish();
  if (options.run.json) {
    context.out << json;
  } else if (context.verbosity != Verbosity::kQuiet) {
    context.out << text(manifest)
                << fmt::format(
                       "test bench          {0}_tb.sv, for a module {0} with the ports of {0}_stub.sv\n"
                       "vectors             {1}\n",
                       options.stage, options.run.out.string());
  }
  return 0;
}

}  // namespace

void add_vectors_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<VectorsOptions>();
  CLI::App& command = *app.add_subcommand("vectors",
                                          "What goes in and out of a stage while the machine processes "
                                          "images, as $readmemh files, with a test bench");
  command.option_defaults()->take_last();
  command.add_option("--stage", options->stage, "The stage, by its name in the time table of a run")
      ->type_name("NAME")
      ->required();
  add_input_options(command, options->run);
  command.add_option("--out", options->run.out, "Folder for the files")
      ->type_name("DIR")
      ->required()
      ->group("Output");
  command
      .add_flag("--dates", options->extras.dates,
                "Write also in which cycle of the core's clock each token is read or written in the machine")
      ->group("Output");
  command
      .add_flag("--taps", options->extras.taps,
                "Write also what the matcher works out on the way to its sums: the matching costs, and each "
                "path's costs")
      ->group("Output");
  add_json_option(command, options->run.json);
  add_configuration_options(command, options->run.configuration);
  command.callback([options, &context] {
    context.action = [options, &context] { return write_vectors(*options, context); };
  });
}

}  // namespace parallax

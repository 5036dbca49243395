// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/stage_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/commands/input_options.hpp"
#include "platform/commands/notes.hpp"
#include "platform/commands/run_images.hpp"
#include "platform/config/nearest_name.hpp"
#include "platform/config/preset.hpp"
#include "platform/cosim/stage_values.hpp"
#include "platform/cosim/token_words.hpp"
#include "platform/cosim/vector_manifest.hpp"
#include "platform/input/run_input.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

struct StageOptions {
  RunOptions run;
  std::string stage;
};

// What is asked and answered, a line each.
class StageDialogue {
 public:
  StageDialogue(StageValues& stage, std::ostream& out) : stage_(stage), out_(out) {}

  void describe() {
    for (const StageValues::Port& port : stage_.ports()) {
      out_ << fmt::format("{} {} {} {} {} {}\n", port.is_input ? "in" : "out", port.name, port.stream,
                          port.shape.format.width().count(), port.shape.row_tokens, port.pass_tokens);
    }
    out_ << std::endl;
  }

  void take(const std::string& line) {
    ++line_;
    std::istringstream words(line);
    std::string name;
    if (!(words >> name)) return;
    const std::size_t index = find(name);
    const StageValues::Port& port = stage_.ports()[index];
    std::string word;
    if (!port.is_input) {
      if (words >> word) fail(fmt::format("{} is an output, which takes no token", name));
      answer(index);
      return;
    }
    for (; words >> word;) stage_.push(index, bits_of(port, word));
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw UserError(fmt::format("standard input, line {}: {}", line_, what));
  }

  std::size_t find(const std::string& name) const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < stage_.ports().size(); ++i) {
      const StageValues::Port& port = stage_.ports()[i];
      if (name == port.name || name == port.stream) return i;
      names.push_back(port.name);
    }
    fail(fmt::format("the stage has no port '{}'; the nearest is {}", excerpt(name),
                     nearest_name(name, names)));
  }

  std::vector<std::uint64_t> bits_of(const StageValues::Port& port, const std::string& word) const {
    const std::size_t width = port.shape.format.width().size();
    TokenWords token(width);
    const std::string wrong = token.append_hex(word.data(), word.data() + word.size());
    if (!wrong.empty()) fail(fmt::format("{}: {}", port.name, wrong));
    if (token.unknown(0)) fail(fmt::format("{}: '{}' has unknown bits", port.name, excerpt(word)));
    std::vector<std::uint64_t> bits((width + 63) / 64);
    for (std::size_t i = 0; i < bits.size(); ++i)
      bits[i] = token.raw(0, {"", 64 * i, std::min<std::size_t>(64, width - 64 * i), false});
    return bits;
  }

  // All tokens that are there.
  void answer(std::size_t port) {
    const std::size_t width = stage_.ports()[port].shape.format.width().size();
    std::string text;
    for (std::vector<std::uint64_t> bits; stage_.pop(port, bits);) {
      if (!text.empty()) text += ' ';
      append_hex(text, bits, width);
    }
    out_ << text << std::endl;
  }

  StageValues& stage_;
  std::ostream& out_;
  std::uint64_t line_ = 0;  // of what is asked
};

int answer_tokens(const StageOptions& options, CommandContext& context) {
  check_options(options.run);
  Notes notes(context, true);
  const Configuration configuration = load_configuration(options.run.configuration, preset_folders());
  const RunImages images(options.run, configuration.machine, notes.sink());
  if (images.size() != images.padded()) {
    // A test bench would not see a note.
    throw UserError(
        fmt::format("images of {}x{} are processed as {}x{}, and so are their tokens: --size {}x{}",
                    images.size().width, images.size().height, images.padded().width, images.padded().height,
                    images.padded().width, images.padded().height));
  }
  StageValues stage(configuration.machine, images.padded().width, images.padded().height, images.map(),
                    options.stage, "parallax stage");
  StageDialogue dialogue(stage, context.out);
  notes.begin();
  dialogue.describe();
  for (std::string line; std::getline(std::cin, line);) dialogue.take(line);
  return 0;
}

}  // namespace

void add_stage_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<StageOptions>();
  CLI::App& command =
      *app.add_subcommand("stage", "What a stage makes of tokens on standard input, for test benches");
  command.option_defaults()->take_last();
  command.add_option("STAGE", options->stage, "The stage, by its name in the time table of a run")
      ->type_name("NAME")
      ->required();
  add_input_options(command, options->run);
  add_configuration_options(command, options->run.configuration);
  command.callback([options, &context] {
    context.action = [options, &context] { return answer_tokens(*options, context); };
  });
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/compare_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/config/nearest_name.hpp"
#include "platform/cosim/difference_image.hpp"
#include "platform/cosim/dump_file.hpp"
#include "platform/cosim/path_sums.hpp"
#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_dates.hpp"
#include "platform/images/image_codecs.hpp"
#include "platform/results/output_file.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"

namespace parallax {
namespace {

struct DumpOptions {
  std::filesystem::path vectors;
  std::vector<std::string> dumps;
  std::vector<std::string> signals;
  std::filesystem::path image;
  std::optional<std::int64_t> bound;
  bool json = false;
};

struct NamedDump {
  const VectorStream* stream;
  std::string file;
};

UserError no_stream(const VectorManifest& manifest, const std::string& where, const std::string& name) {
  std::vector<std::string> names;
  for (const VectorStream& stream : manifest.streams) names.push_back(stream.name);
  return UserError(fmt::format("{}: {} has no stream '{}'; the nearest is {}", where, manifest.stage,
                               excerpt(name), nearest_name(name, names)));
}

// FILE, which is of the first output stream, or STREAM=FILE.
NamedDump dump_of(const VectorManifest& manifest, const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals != std::string::npos) {
    const std::string name = word.substr(0, equals);
    if (const VectorStream* const stream = manifest.find(name)) return {stream, word.substr(equals + 1)};
    if (!std::filesystem::exists(word)) {
      throw no_stream(manifest, "--dump " + excerpt(word), name);
    }
  }
  const auto output =
      std::find_if(manifest.streams.begin(), manifest.streams.end(),
                   [](const VectorStream& stream) { return !stream.is_input && !stream.is_tap; });
  if (output == manifest.streams.end())
    throw UserError(fmt::format("{} has no output stream: --dump STREAM=FILE", manifest.stage));
  return {&*output, word};
}

// Of a stream: KIND=NAME, which is of all streams, and STREAM.KIND=NAME.
DumpSignals read_signals(const VectorManifest& manifest, const VectorStream& stream,
                         const std::vector<std::string>& words) {
  DumpSignals signals;
  std::vector<std::string> in_order = words;
  const auto is_of_all = [](const std::string& word) {
    return word.substr(0, word.find('=')).find('.') == std::string::npos;
  };
  std::stable_partition(in_order.begin(), in_order.end(), is_of_all);
  for (const std::string& word : in_order) {
    const std::size_t equals = word.find('=');
    std::string kind = word.substr(0, equals);
    bool is_of_it = true;
    if (!is_of_all(word)) {
      const std::string of = kind.substr(0, kind.rfind('.'));
      const VectorStream* const named = manifest.find(of);
      if (named == nullptr) throw no_stream(manifest, "--signals " + excerpt(word), of);
      kind = kind.substr(of.size() + 1);
      is_of_it = named == &stream;
    }
    std::string* const target = kind == "data"    ? &signals.data
                                : kind == "valid" ? &signals.valid
                                : kind == "ready" ? &signals.ready
                                : kind == "clock" ? &signals.clock
                                                  : nullptr;
    if (target == nullptr || equals == std::string::npos || equals + 1 == word.size()) {
      throw UserError(fmt::format("--signals: '{}' is not data=NAME, valid=NAME, ready=NAME or clock=NAME",
                                  excerpt(word)));
    }
    if (is_of_it) *target = word.substr(equals + 1);
  }
  return signals;
}

// Beside the model's, counted from the first token of each; nothing, if either has none.
std::optional<TokenDates> compare_dates(const DumpOptions& options, const NamedDump& named,
                                        const Dump& dump) {
  if (named.stream->dates_file.empty()) {
    if (options.bound) {
      throw UserError(fmt::format("--bound: {} has no dates of {}; parallax vectors --dates writes them",
                                  options.vectors.string(), named.stream->name));
    }
    return std::nullopt;
  }
  if (dump.cycles.empty()) {
    if (options.bound) {
      throw UserError(
          fmt::format("--bound: {} does not say in which cycles its tokens are; a VCD does, or a CSV with a "
                      "column cycle",
                      named.file));
    }
    return std::nullopt;
  }
  const std::vector<std::int64_t> model =
      read_dates((options.vectors / named.stream->dates_file).string(), *named.stream);
  std::vector<std::int64_t> cycles = dump.cycles;
  const std::int64_t begin = model.empty() ? 0 : cycles.front() - model.front();
  for (std::int64_t& cycle : cycles) cycle -= begin;
  return TokenDates(*named.stream, cycles, model);
}

// The words of a folder of vectors, each file read once. A file that is away is of a stream that nothing is
// asked of.
class VectorFiles {
 public:
  explicit VectorFiles(const std::filesystem::path& folder) : folder_(folder) {}
  const TokenWords& read(const VectorStream& stream) {
    auto found = words_.find(stream.name);
    if (found == words_.end())
      found = words_.emplace(stream.name, read_vectors((folder_ / stream.file).string(), stream)).first;
    return found->second;
  }
  const TokenWords* find(const VectorStream& stream) {
    return std::filesystem::exists(folder_ / stream.file) ? &read(stream) : nullptr;
  }

 private:
  const std::filesystem::path folder_;
  std::map<std::string, TokenWords> words_;
};

int compare_dumps(const DumpOptions& options, CommandContext& context) {
  const VectorManifest manifest = read_vector_manifest(options.vectors);
  bool equal = true;
  cv::Mat image;  // of the first stream that differs
  std::string said;
  nlohmann::ordered_json streams = nlohmann::ordered_json::array();
  VectorFiles model(options.vectors);
  for (const std::string& word : options.dumps) {
    const NamedDump dump = dump_of(manifest, word);
    const TokenWords& expected = model.read(*dump.stream);
    const DumpSignals signals = read_signals(manifest, *dump.stream, options.signals);
    const Dump got = read_dump(dump.file, *dump.stream, signals);
    TokenComparison comparison =
        compare_tokens(manifest, *dump.stream, expected, got,
                       [&model](const VectorStream& stream) { return model.find(stream); });
    if (const auto one_path = find_one_path(comparison, expected, got.words, options.vectors))
      say_first(comparison, *one_path);
    const std::optional<TokenDates> dates = compare_dates(options, dump, got);
    equal = equal && comparison.equal() && (!dates || dates->within(options.bound));
    said += text(comparison);
    nlohmann::ordered_json tree = to_json(comparison);
    if (dates) {
      said += dates->text(options.bound);
      dates->add_to(tree);
    }
    if (!options.image.empty() && image.empty())
      image = difference_image(manifest, *dump.stream, expected, got.words);
    streams.push_back(std::move(tree));
  }
  if (!image.empty()) {
    const std::vector<std::uint8_t> bytes = encode_image(".png", image);
    OutputFile file(options.image);
    file.write(bytes.data(), bytes.size());
    file.publish();
    said += fmt::format("image               {}\n", options.image.string());
  }
  nlohmann::ordered_json tree{{"stage", manifest.stage}, {"equal", equal}};
  // The first stream that differs, where a script looks for it.
  const auto different = std::find_if(streams.begin(), streams.end(), [](const auto& stream) {
    return !stream.at("equal").template get<bool>();
  });
  if (different != streams.end()) {
    for (const char* const key : {"stream", "first_difference", "pattern"}) {
      if (different->contains(key)) tree[key] = different->at(key);
    }
  }
  tree["streams"] = std::move(streams);
  if (options.json) {
    context.out << json_text(tree, 2) << '\n';
  } else if (context.verbosity != Verbosity::kQuiet) {
    context.out << said;
  }
  return equal ? 0 : kNotAsExpected;
}

}  // namespace

void add_compare_command(CLI::App& app, CommandContext& context) {
  const auto options = std::make_shared<DumpOptions>();
  CLI::App& command = *app.add_subcommand(
      "compare",
      "What a simulator wrote down of a circuit, beside the vectors of a stage: the first difference");
  command.add_option("--vectors", options->vectors, "Folder of parallax vectors")
      ->type_name("DIR")
      ->required();
  command
      .add_option(
          "--dump", options->dumps,
          "What came out, in the order of the tokens: the text that $readmemh reads, CSV or VCD; without "
          "a name, of the first output stream. Repeated for several streams")
      ->type_name("[STREAM=]FILE")
      ->allow_extra_args(false)
      ->required();
  command
      .add_option(
          "--signals", options->signals,
          "Of a VCD, which signals are the stream: data=NAME,valid=NAME,ready=NAME,clock=NAME; of several "
          "streams STREAM.data=NAME and so on; if not given, PORT_data, PORT_valid, PORT_ready and clk")
      ->type_name("[STREAM.]KIND=NAME,...")
      ->delimiter(',');
  command
      .add_option("--image", options->image,
                  "Writes where the first stream that differs does: black as the model, red different, blue "
                  "not there. Nothing if all is equal")
      ->type_name("FILE.png");
  command
      .add_option(
          "--bound", options->bound,
          "Most cycles by which a token may be later than in the machine, counted from the first one; "
          "more is a difference. Needs parallax vectors --dates, and a dump with cycles")
      ->type_name("NUMBER");
  add_json_option(command, options->json);
  command.callback([options, &context] {
    context.action = [options, &context] { return compare_dumps(*options, context); };
  });
}

}  // namespace parallax

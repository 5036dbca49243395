// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "platform/cosim/circuit_build.hpp"
#include "tlm/error.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

// The stage, and the files behind the sign.
std::pair<std::string, std::vector<std::filesystem::path>> read_circuit(const std::string& word) {
  const std::size_t equals = word.find('=');
  std::vector<std::filesystem::path> files;
  if (equals != std::string::npos) {
    std::istringstream list(word.substr(equals + 1));
    for (std::string file; std::getline(list, file, ',');) {
      if (!file.empty()) files.emplace_back(file);
    }
  }
  if (equals == 0 || files.empty()) {
    throw UserError(
        fmt::format("--circuit: '{}' is not STAGE=FILE[,FILE...], as census=census.sv or census=libcensus.so",
                    excerpt(word)));
  }
  return {word.substr(0, equals), files};
}

std::string cycles_text(std::int64_t cycles) {
  return grouped(std::to_string(cycles)) + (cycles == 1 ? " cycle" : " cycles");
}

}  // namespace

CircuitRun::CircuitRun(const CircuitOptions& options, const MachineConfig& config, const MachineInput& model,
                       const std::function<bool()>& interrupted)
    : options_(options), frames_(model.frames) {
  const auto [stage, files] = read_circuit(options.circuit);
  stage_name_ = stage;
  // What is cheap to get wrong comes before what takes long.
  const CircuitFile library(files, options);
  circuit_ = std::make_unique<Circuit>(library.path(), static_cast<unsigned>(options.seed));
  model_ = record_stage(config, model, stage, interrupted);
  if (model_.outputs.empty() && model_.manifest.streams.empty()) return;  // interrupted
  pins_ = find_pins(*circuit_, model_.manifest, options);
}

CircuitRun::~CircuitRun() = default;

StageReplacements CircuitRun::replacements(const std::function<void()>& stop) {
  return {{stage_name_, [this, stop](const std::string& name, const StageContext& context) {
             auto stage = std::make_unique<CircuitStage>(name.c_str(), *circuit_, pins_, model_.manifest,
                                                         options_, frames_, context, stop);
             stage_ = stage.get();
             SlotModule slot;
             slot.module = std::move(stage);
             slot.takes_tokens = true;
             // What leads past it is as deep as for the model's stage.
             slot.look_ahead = model_.manifest.look_ahead;
             slot.latency = model_.manifest.latency;
             return slot;
           }}};
}

void CircuitRun::conclude() {
  as_model_ = stage_->fault().empty() && stage_->breach().empty();
  std::size_t output = 0;
  for (const VectorStream& stream : model_.manifest.streams) {
    if (stream.is_input) continue;
    const StageRecord::Tokens& model = model_.outputs[output++];
    const Dump& dump = stage_->written(stream);
    comparisons_.push_back(compare_tokens(model_.manifest, stream, model.words, dump));
    as_model_ = as_model_ && comparisons_.back().equal();
    Timing timing;
    timing.stream = stream.name;
    const std::size_t both = std::min(dump.cycles.size(), model.cycles.size());
    for (std::size_t token = 0; token < both; ++token) {
      const std::int64_t later = dump.cycles[token] - model.cycles[token];
      if (token == 0 || later > timing.latest) {
        timing.latest = later;
        timing.latest_token = token;
      }
    }
    for (std::size_t last = stream.frame_tokens - 1; last < both; last += stream.frame_tokens) {
      const std::size_t first = last + 1 - stream.frame_tokens;
      timing.circuit.push_back(dump.cycles[last] - dump.cycles[first] + 1);
      timing.model.push_back(model.cycles[last] - model.cycles[first] + 1);
    }
    if (options_.bound && both > 0) as_model_ = as_model_ && timing.latest <= *options_.bound;
    timings_.push_back(std::move(timing));
  }
}

const std::string& CircuitRun::fault() const { return stage_->fault(); }

std::string CircuitRun::text() const {
  std::string out =
      fmt::format("circuit             {} in the place of {}, clocked for {}\n", circuit_->name(),
                  stage_name_, cycles_text(static_cast<std::int64_t>(stage_->cycles())));
  if (!stage_->fault().empty()) out += fmt::format("given up            {}\n", stage_->fault());
  if (!stage_->breach().empty()) out += fmt::format("handshake           {}\n", stage_->breach());
  for (std::size_t i = 0; i < comparisons_.size(); ++i) {
    out += parallax::text(comparisons_[i]);
    const Timing& timing = timings_[i];
    if (timing.circuit.empty()) continue;
    out += fmt::format("{:20}{} from the first to the last token of frame 0; the model {}\n", "dates",
                       cycles_text(timing.circuit[0]), grouped(std::to_string(timing.model[0])));
    if (timing.latest > 0) {
      out += fmt::format("{:20}at most {} later than the model, at token {}\n", "",
                         cycles_text(timing.latest), timing.latest_token);
    } else if (timing.latest < 0) {
      out += fmt::format("{:20}each at least {} earlier than the model\n", "", cycles_text(-timing.latest));
    } else {
      out += fmt::format("{:20}never later than the model\n", "");
    }
    if (options_.bound && timing.latest > *options_.bound) {
      out += fmt::format("{:20}more than the bound of {}\n", "", cycles_text(*options_.bound));
    }
  }
  return out;
}

nlohmann::ordered_json CircuitRun::json() const {
  nlohmann::ordered_json out{{"module", circuit_->name()},
                             {"stage", stage_name_},
                             {"cycles", stage_->cycles()},
                             {"as_model", as_model_}};
  if (!stage_->fault().empty()) out["given_up"] = stage_->fault();
  if (!stage_->breach().empty()) out["handshake"] = stage_->breach();
  out["streams"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < comparisons_.size(); ++i) {
    nlohmann::ordered_json stream = to_json(comparisons_[i]);
    const Timing& timing = timings_[i];
    stream["frame_cycles"] = timing.circuit;
    stream["model_frame_cycles"] = timing.model;
    if (!timing.circuit.empty())
      stream["latest"] = {{"cycles", timing.latest}, {"token", timing.latest_token}};
    out["streams"].push_back(std::move(stream));
  }
  return out;
}

}  // namespace parallax

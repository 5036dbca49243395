// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <utility>

#include "platform/cosim/circuit_build.hpp"
#include "platform/evaluation/own_process.hpp"
#include "tlm/error.hpp"

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

// On the way from another process: files hold any bytes.
std::string packed(const CircuitOutcome& outcome) {
  using Json = nlohmann::ordered_json;
  Json files = Json::array();
  for (const CircuitOutcome::File& file : outcome.files) {
    files.push_back(
        {{"name", file.name}, {"content", Json::binary({file.content.begin(), file.content.end()})}});
  }
  const std::vector<std::uint8_t> bytes = Json::to_cbor({{"text", outcome.text},
                                                         {"json", outcome.json},
                                                         {"as_model", outcome.as_model},
                                                         {"fault", outcome.fault},
                                                         {"files", files}});
  return {bytes.begin(), bytes.end()};
}

CircuitOutcome unpacked(const std::string& bytes) {
  const nlohmann::ordered_json tree = nlohmann::ordered_json::from_cbor(bytes);
  CircuitOutcome outcome{tree.at("text").get<std::string>(), tree.at("json"), tree.at("as_model").get<bool>(),
                         tree.at("fault").get<std::string>()};
  for (const auto& file : tree.at("files")) {
    const auto& content = file.at("content").get_binary();
    outcome.files.push_back({file.at("name").get<std::string>(), {content.begin(), content.end()}});
  }
  return outcome;
}

}  // namespace

CircuitRun::CircuitRun(const std::vector<CircuitOptions>& circuits, bool shadow, bool keeps_waves,
                       const MachineConfig& config, const MachineInput& model,
                       const std::function<bool()>& interrupted)
    : shadow_(shadow), keeps_waves_(keeps_waves) {
  if (circuits.size() > CircuitStage::kMost) {
    throw UserError(fmt::format("--circuit: {} circuits are too many; at most {} can be in one machine",
                                circuits.size(), CircuitStage::kMost));
  }
  std::vector<std::vector<std::filesystem::path>> files;
  for (const CircuitOptions& options : circuits) {
    auto [stage, of_it] = read_circuit(options.circuit);
    for (const Placed& other : circuits_) {
      if (other.stage == stage)
        throw UserError(
            fmt::format("--circuit: {} is given twice; one circuit stands for it", excerpt(stage)));
    }
    circuits_.push_back({&options, std::move(stage), nullptr, {}, {}});
    files.push_back(std::move(of_it));
  }
  // What is cheap to get wrong comes before what takes long.
  const std::vector<VectorManifest> manifests = check_stages(config, model, stages(), interrupted);
  if (manifests.empty()) return;  // interrupted
  for (std::size_t i = 0; i < circuits_.size(); ++i) {
    const CircuitOptions& options = *circuits_[i].options;
    const PinCheck check = [&](const PinList& pins) { find_pins(pins, manifests[i], options); };
    const CircuitFile library(files[i], options, check);
    circuits_[i].circuit = std::make_unique<Circuit>(library.path(), static_cast<unsigned>(options.seed));
    check(circuits_[i].circuit->list());
  }
  record(config, model, interrupted);
  if (shadow_ && !interrupted()) run_shadows(config, model, interrupted);
}

CircuitRun::~CircuitRun() = default;

std::vector<std::string> CircuitRun::stages() const {
  std::vector<std::string> all;
  for (const Placed& placed : circuits_) all.push_back(placed.stage);
  return all;
}

void CircuitRun::record(const MachineConfig& config, const MachineInput& model,
                        const std::function<bool()>& interrupted) {
  std::vector<StageRecord> records = record_stages(config, model, stages(), interrupted);
  if (records.empty()) return;  // interrupted
  for (std::size_t i = 0; i < circuits_.size(); ++i) {
    Placed& placed = circuits_[i];
    placed.model = std::move(records[i]);
    placed.pins = find_pins(placed.circuit->list(), placed.model.manifest, *placed.options);
  }
  std::sort(circuits_.begin(), circuits_.end(),
            [](const Placed& a, const Placed& b) { return a.model.slot < b.model.slot; });
  in_place_ = circuits_.size();
  if (shadow_) return;
  check_ready_paths(config.streams);
  for (std::size_t i = 1; i < circuits_.size(); ++i) {
    MachineInput behind = model;
    behind.replacements = replacements(0, i, [] { sc_core::sc_stop(); });
    records = record_stages(config, behind, {circuits_[i].stage}, interrupted);
    if (records.empty()) {  // interrupted, or one upstream was given up, and is again in the run
      in_place_ = i;
      return;
    }
    circuits_[i].model = std::move(records[0]);
  }
}

// Within a cycle the circuit upstream is evaluated first, and sees a cycle late what the other one reads.
void CircuitRun::check_ready_paths(const StreamConfig& streams) const {
  const auto check = [&](const Placed& from, const Placed& to, const std::string& name) {
    for (const VectorStream& input : to.model.manifest.streams) {
      if (!input.is_input || input.name != name || streams.offsets(name).read_to_write != 0) continue;
      throw UserError(
          fmt::format("streams.{}.read_to_write = 0: between the circuits of {} and {} no place can "
                      "be freed and taken in one cycle; 1 or more can be kept, or any with "
                      "--circuit-shadow",
                      name, from.stage, to.stage));
    }
  };
  for (const Placed& from : circuits_) {
    for (const VectorStream& output : from.model.manifest.streams) {
      if (output.is_input) continue;
      for (const Placed& to : circuits_) {
        check(from, to, output.name);
        for (const std::string& name : output.also) check(from, to, name);
      }
    }
  }
}

void CircuitRun::run_shadows(const MachineConfig& config, const MachineInput& model,
                             const std::function<bool()>& interrupted) {
  for (std::size_t i = 0; i < circuits_.size(); ++i) {
    MachineInput beside = model;
    beside.replacements = replacements(i, i + 1, [] { sc_core::sc_stop(); });
    const std::optional<std::string> told = in_own_process(
        [&] {
          const Machine machine("machine", config, beside);
          simulate_to_end(machine);
          machine.dataflow().bring_up_to_date();
          return packed(outcome(circuits_[i]));
        },
        interrupted);
    if (!told) return;
    outcomes_.push_back(unpacked(*told));
  }
}

StageReplacements CircuitRun::replacements(std::size_t begin, std::size_t end,
                                           const std::function<void()>& stop) {
  StageReplacements all;
  for (std::size_t i = begin; i < end; ++i) {
    all.emplace(circuits_[i].stage, [this, i, stop](const std::string& name, const StageContext& context) {
      Placed& placed = circuits_[i];
      auto stage = std::make_unique<CircuitStage>(name.c_str(), *placed.circuit, placed.pins, placed.model,
                                                  *placed.options, i, context, stop);
      placed.module = stage.get();
      if (keeps_waves_) stage->keep_waves(placed.options->waves.value_or(kCircuitWaves));
      SlotModule slot;
      slot.module = std::move(stage);
      slot.takes_tokens = true;
      // What leads past it is as deep as for the model's stage.
      slot.look_ahead = placed.model.manifest.look_ahead;
      slot.latency = placed.model.manifest.latency;
      return slot;
    });
  }
  return all;
}

StageReplacements CircuitRun::replacements(const std::function<void()>& stop) {
  return shadow_ ? StageReplacements{} : replacements(0, in_place_, stop);
}

CircuitOutcome CircuitRun::outcome(const Placed& placed) {
  return circuit_outcome(placed.circuit->name(), *placed.module, placed.model, *placed.options);
}

void CircuitRun::conclude() {
  if (shadow_) return;
  for (std::size_t i = 0; i < in_place_; ++i) outcomes_.push_back(outcome(circuits_[i]));
  const auto given_up = std::find_if(outcomes_.begin(), outcomes_.end(),
                                     [](const CircuitOutcome& outcome) { return !outcome.fault.empty(); });
  const std::size_t at = given_up == outcomes_.end() ? 0 : given_up - outcomes_.begin();
  const std::string why = fmt::format("the circuit of {} before it was given up", circuits_[at].stage);
  for (std::size_t i = in_place_; i < circuits_.size(); ++i) {
    CircuitOutcome left_out;
    left_out.text =
        fmt::format("circuit             {} is left out: {}\n", circuits_[i].circuit->name(), why);
    left_out.json = {{"module", circuits_[i].circuit->name()},
                     {"stage", circuits_[i].stage},
                     {"as_model", false},
                     {"left_out", why}};
    outcomes_.push_back(std::move(left_out));
  }
}

bool CircuitRun::as_model() const {
  return std::all_of(outcomes_.begin(), outcomes_.end(),
                     [](const auto& outcome) { return outcome.as_model; });
}

std::string CircuitRun::fault() const {
  for (std::size_t i = 0; i < outcomes_.size(); ++i) {
    const std::string& fault = outcomes_[i].fault;
    if (fault.empty()) continue;
    return fmt::format("circuit {} in the place of {} was given up: {}", circuits_[i].circuit->name(),
                       circuits_[i].stage, fault);
  }
  return {};
}

std::string CircuitRun::text() const {
  std::string all;
  for (const CircuitOutcome& outcome : outcomes_) all += outcome.text;
  return all;
}

std::vector<CircuitOutcome::File> CircuitRun::files() const {
  std::vector<CircuitOutcome::File> all;
  for (const CircuitOutcome& outcome : outcomes_)
    all.insert(all.end(), outcome.files.begin(), outcome.files.end());
  return all;
}

nlohmann::ordered_json CircuitRun::json() const {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const CircuitOutcome& outcome : outcomes_) all.push_back(outcome.json);
  return all;
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/stage_record.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include "platform/cosim/vector_capture.hpp"
#include "platform/evaluation/own_process.hpp"
#include "platform/machine/simulated_time.hpp"
#include "platform/results/deadlock_report.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// A text of parts, each with its length in front.
void append_part(std::string& text, const void* bytes, std::uint64_t size) {
  text.append(reinterpret_cast<const char*>(&size), sizeof size);
  text.append(static_cast<const char*>(bytes), size);
}

template <class T>
void append_numbers(std::string& text, const std::vector<T>& numbers) {
  append_part(text, numbers.data(), numbers.size() * sizeof(T));
}

class Parts {
 public:
  explicit Parts(const std::string& text) : text_(text) {}
  std::string next() {
    const std::size_t size = next_size();
    at_ += size;
    return text_.substr(at_ - size, size);
  }
  template <class T>
  std::vector<T> numbers() {
    const std::size_t size = next_size();
    std::vector<T> all(size / sizeof(T));
    std::memcpy(all.data(), text_.data() + at_, all.size() * sizeof(T));
    at_ += size;
    return all;
  }

 private:
  std::size_t next_size() {
    std::uint64_t size = 0;
    std::memcpy(&size, text_.data() + at_, sizeof size);
    at_ += sizeof size;
    return size;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

// A stage's tokens, while they pass.
struct Recording {
  struct Port {
    std::vector<std::uint64_t> bits;
    std::vector<std::int64_t> cycles;
  };
  VectorManifest manifest;
  std::vector<Port> all;
  std::vector<std::unique_ptr<TokenTap>> taps;

  Recording(const Machine& machine, const std::string& stage) : manifest(stage_manifest(machine, stage)) {
    const std::vector<TokenPort> ports = machine.pipeline().ports(stage);
    all.resize(ports.size());
    for (std::size_t i = 0; i < ports.size(); ++i) {
      taps.push_back(ports[i].tap([&port = all[i]](const WiredToken& token) {
        port.bits.insert(port.bits.end(), token.bits.begin(), token.bits.end());
        port.cycles.push_back(token.date.count());
      }));
    }
  }

  void finish(std::int64_t frames, std::string& text) {
    manifest.frames = frames;
    for (std::size_t i = 0; i < all.size(); ++i) {
      manifest.streams[i].tokens = all[i].cycles.size();
      manifest.streams[i].frame_tokens = manifest.streams[i].tokens / static_cast<std::uint64_t>(frames);
    }
    const std::string json = to_json(manifest).dump();
    std::size_t size = text.size() + json.size() + 64 * (1 + all.size());  // with their lengths
    for (const Port& port : all) size += 8 * (port.bits.size() + port.cycles.size());
    text.reserve(size);
    append_part(text, json.data(), json.size());
    for (const Port& port : all) {
      append_numbers(text, port.bits);
      append_numbers(text, port.cycles);
    }
  }
};

// Nothing, if the simulation was stopped.
std::string simulate(const MachineConfig& config, const MachineInput& input,
                     const std::vector<std::string>& stages) {
  const Machine machine("machine", config, input);
  std::vector<std::unique_ptr<Recording>> recordings;
  for (const std::string& stage : stages) recordings.push_back(std::make_unique<Recording>(machine, stage));
  simulate_to_end(machine);
  if (!machine.finished()) return {};
  machine.dataflow().bring_up_to_date();
  std::string text;
  const std::vector<std::string> slots = machine.pipeline().slots();
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const auto slot = static_cast<std::uint64_t>(
        std::distance(slots.begin(), std::find(slots.begin(), slots.end(), stages[i])));
    append_part(text, &slot, sizeof slot);
    recordings[i]->finish(input.frames, text);
  }
  return text;
}

}  // namespace

void simulate_to_end(const Machine& machine) {
  do {
    simulate_for(sc_core::sc_time(1000, sc_core::SC_SEC));
  } while (sc_core::sc_get_status() != sc_core::SC_STOPPED && sc_core::sc_pending_activity());
  if (!machine.finished() && sc_core::sc_get_status() != sc_core::SC_STOPPED)
    throw UserError(message(find_deadlock(machine)));
}

std::vector<VectorManifest> check_stages(const MachineConfig& config, const MachineInput& input,
                                         const std::vector<std::string>& stages,
                                         const std::function<bool()>& interrupted) {
  const std::optional<std::string> text = in_own_process(
      [&] {
        const Machine machine("machine", config, input);
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        for (const std::string& stage : stages) check_vectors(machine, stage, "--circuit");
        for (const std::string& stage : stages) all.push_back(to_json(stage_manifest(machine, stage)));
        return all.dump();
      },
      interrupted);
  std::vector<VectorManifest> manifests;
  if (!text) return manifests;
  for (const nlohmann::ordered_json& tree : nlohmann::ordered_json::parse(*text))
    manifests.push_back(vector_manifest(tree));
  return manifests;
}

std::vector<StageRecord> record_stages(const MachineConfig& config, const MachineInput& input,
                                       const std::vector<std::string>& stages,
                                       const std::function<bool()>& interrupted) {
  const std::optional<std::string> text =
      in_own_process([&] { return simulate(config, input, stages); }, interrupted);
  if (!text || text->empty()) return {};
  Parts parts(*text);
  std::vector<StageRecord> records(stages.size());
  for (StageRecord& record : records) {
    record.slot = static_cast<std::size_t>(parts.numbers<std::uint64_t>().front());
    record.manifest = vector_manifest(nlohmann::ordered_json::parse(parts.next()));
    for (const VectorStream& stream : record.manifest.streams) {
      StageRecord::Tokens tokens{
          TokenWords(stream.shape.format.width().size(), parts.numbers<std::uint64_t>()), {}};
      tokens.cycles = parts.numbers<std::int64_t>();
      record.streams.push_back(std::move(tokens));
    }
  }
  return records;
}

}  // namespace parallax

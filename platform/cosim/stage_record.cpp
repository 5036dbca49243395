// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/stage_record.hpp"

#include <fmt/format.h>

#include <cstring>
#include <exception>
#include <memory>
#include <stdexcept>
#include <utility>

#include "platform/cosim/vector_capture.hpp"
#include "platform/evaluation/worker_process.hpp"
#include "platform/machine/simulated_time.hpp"
#include "platform/results/deadlock_report.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// What the other process sends: a letter, and either a line of error or the record, whose parts have their
// length in front.
constexpr char kDone = '+';
constexpr char kUserError = '-';
constexpr char kFailed = '!';

void append_part(std::string& text, const void* bytes, std::uint64_t size) {
  text.append(reinterpret_cast<const char*>(&size), sizeof size);
  text.append(static_cast<const char*>(bytes), size);
}

class Parts {
 public:
  explicit Parts(const std::string& text) : text_(text) {}
  std::string next() {
    std::uint64_t size = 0;
    std::memcpy(&size, text_.data() + at_, sizeof size);
    at_ += sizeof size;
    std::string part = text_.substr(at_, size);
    at_ += size;
    return part;
  }

 private:
  const std::string& text_;
  std::size_t at_ = 1;
};

std::string simulate(const MachineConfig& config, const MachineInput& input, const std::string& stage) {
  sc_core::sc_report_handler::set_actions(sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
  sc_core::sc_report_handler::set_actions(sc_core::SC_ID_NO_SC_START_ACTIVITY_, sc_core::SC_DO_NOTHING);
  const Machine machine("machine", config, input);
  check_vectors(machine, stage, "--circuit");
  VectorManifest manifest = stage_manifest(machine, stage);
  const std::vector<TokenPort> ports = machine.pipeline().ports(stage);
  struct Recorded {
    std::vector<std::uint64_t> bits;
    std::vector<std::int64_t> cycles;
  };
  std::vector<Recorded> all(ports.size());
  std::vector<std::unique_ptr<TokenTap>> taps;
  for (std::size_t i = 0; i < ports.size(); ++i) {
    taps.push_back(ports[i].tap([&recorded = all[i], is_input = ports[i].is_input](const WiredToken& token) {
      if (!is_input) recorded.bits.insert(recorded.bits.end(), token.bits.begin(), token.bits.end());
      recorded.cycles.push_back(token.date.count());
    }));
  }
  do {
    simulate_for(sc_core::sc_time(1000, sc_core::SC_SEC));
  } while (sc_core::sc_get_status() != sc_core::SC_STOPPED && sc_core::sc_pending_activity());
  if (!machine.finished()) throw UserError(message(find_deadlock(machine)));
  machine.dataflow().bring_up_to_date();
  manifest.frames = input.frames;
  for (std::size_t i = 0; i < ports.size(); ++i) {
    manifest.streams[i].tokens = all[i].cycles.size();
    manifest.streams[i].frame_tokens = manifest.streams[i].tokens / static_cast<std::uint64_t>(input.frames);
  }
  std::string text(1, kDone);
  const std::string json = to_json(manifest).dump();
  append_part(text, json.data(), json.size());
  for (std::size_t i = 0; i < ports.size(); ++i) {
    if (ports[i].is_input) continue;
    append_part(text, all[i].bits.data(), all[i].bits.size() * sizeof(std::uint64_t));
    append_part(text, all[i].cycles.data(), all[i].cycles.size() * sizeof(std::int64_t));
  }
  return text;
}

std::string simulate_to_text(const MachineConfig& config, const MachineInput& input,
                             const std::string& stage) {
  try {
    return simulate(config, input, stage);
  } catch (const UserError& error) {
    return kUserError + std::string(error.what());
  } catch (const sc_core::sc_report& report) {
    return kFailed + fmt::format("{}: {}", report.get_msg_type(), report.get_msg());
  } catch (const std::exception& error) {
    return kFailed + std::string(error.what());
  }
}

template <class T>
std::vector<T> numbers(const std::string& bytes) {
  std::vector<T> all(bytes.size() / sizeof(T));
  std::memcpy(all.data(), bytes.data(), all.size() * sizeof(T));
  return all;
}

}  // namespace

StageRecord record_stage(const MachineConfig& config, const MachineInput& input, const std::string& stage,
                         const std::function<bool()>& interrupted) {
  WorkerProcess process([&](const std::string&) { return simulate_to_text(config, input, stage); });
  process.ask({});
  while (process.state() == WorkerProcess::State::kWorking) {
    if (interrupted()) return {};
    process.receive(WorkerProcess::kPollMilliseconds);
  }
  if (process.state() != WorkerProcess::State::kAnswered)
    throw std::runtime_error(fmt::format("the model's run ended by signal {}", process.signal()));
  const std::string text = process.take_answer();
  if (text[0] == kUserError) throw UserError(text.substr(1));
  if (text[0] == kFailed) throw std::runtime_error(text.substr(1));
  Parts parts(text);
  StageRecord record;
  record.manifest = vector_manifest(nlohmann::ordered_json::parse(parts.next()));
  for (const VectorStream& stream : record.manifest.streams) {
    if (stream.is_input) continue;
    const std::size_t width = stream.shape.format.width().size();
    StageRecord::Tokens tokens{TokenWords(width, numbers<std::uint64_t>(parts.next())), {}};
    tokens.cycles = numbers<std::int64_t>(parts.next());
    record.outputs.push_back(std::move(tokens));
  }
  return record;
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "platform/cosim/stalls.hpp"

namespace parallax {
namespace {

constexpr int kResetCycles = 8;
constexpr std::uint64_t kPatience = 100000;  // cycles
constexpr std::uint64_t kRest = 1000;        // cycles without anything due, after which the clock stands
// Where the kernel's time has come this far behind an edge, whatever happens at the edge has happened.
const sc_core::sc_time kAfterEdge(1, sc_core::SC_PS);

}  // namespace

struct CircuitStage::Input {
  const VectorStream& model;
  const PortPins& pins;
  CircuitEnd* end;
  Stalls stalls;
  std::uint64_t tokens = 0;  // that were taken
  std::uint64_t flush = 0;   // tokens of zeros that are still due behind the frame
  bool offered = false;      // valid is 1, and stays so until the token is taken
  bool loaded = false;       // its bits are on the pins
  Cycles next{0};            // earliest cycle of the next one
  Cycles starved{0};         // cycles in which it was wanted and not there
  std::vector<std::uint64_t> bits{};
};

struct CircuitStage::Output {
  const VectorStream& model;
  const PortPins& pins;
  std::vector<CircuitEnd*> ends;  // several have the same tokens
  Stalls stalls;
  Dump dump;
  std::uint64_t skip;        // tokens that count for nothing before the next one of a frame
  std::uint64_t tokens = 0;  // that were written
  bool ready = false;
  bool valid = false;
  bool held = false;  // a token was offered and not taken
  Cycles blocked{0};
  std::vector<std::uint64_t> bits{}, before{};
};

CircuitStage::CircuitStage(const sc_core::sc_module_name& name, Circuit& circuit, const CircuitPins& pins,
                           const VectorManifest& stage, const CircuitOptions& options, std::int64_t frames,
                           const StageContext& context, std::function<void()> stop)
    : sc_module(name),
      circuit_(circuit),
      pins_(pins),
      stage_(stage),
      options_(options),
      frames_(frames),
      clock_(context.clock),
      stop_(std::move(stop)),
      flush_(options.flush.value_or(options.latency)) {
  std::uint64_t seed = options.seed;
  for (std::size_t i = 0; i < stage.streams.size(); ++i) {
    const VectorStream& stream = stage.streams[i];
    const PortPins& port = pins.ports[i];
    Stalls stalls(options.stall, ++seed);
    if (stream.is_input) {
      inputs_.push_back(std::make_unique<Input>(Input{stream, port, nullptr, stalls}));
    } else {
      Dump dump{TokenWords(stream.shape.format.width().size()), {}};
      outputs_.push_back(
          std::make_unique<Output>(Output{stream, port, {}, stalls, std::move(dump), options.skip}));
    }
  }
  for (const auto& input : inputs_) of_pass_ = std::max(of_pass_, stage.pass_tokens(input->model) + flush_);
  for (const VectorStream& stream : stage.streams)
    timeout_ = std::max({timeout_, kPatience, 4 * stream.frame_tokens});
  if (options.timeout) timeout_ = *options.timeout;
  needs_all_ = std::any_of(outputs_.begin(), outputs_.end(),
                           [](const auto& output) { return output->pins.valid == nullptr; });
  SC_HAS_PROCESS(CircuitStage);
  SC_METHOD(resolve);
  sensitive << timer_;
  dont_initialize();
}

CircuitStage::~CircuitStage() = default;

void CircuitStage::add(std::unique_ptr<CircuitEnd> end) {
  bool known = false;
  for (const auto& input : inputs_) {
    if (input->model.port != end->port()) continue;
    input->end = end.get();
    known = true;
  }
  for (const auto& output : outputs_) {
    if (output->model.port != end->port()) continue;
    output->ends.push_back(end.get());
    known = true;
  }
  if (!known) throw std::logic_error("the circuit's stage has no port " + end->port());
  ends_.push_back(std::move(end));
}

void CircuitStage::end_of_elaboration() {
  for (const auto& end : ends_) end->attach(this->name(), this);
}

// Reset is over when time begins.
void CircuitStage::start_of_simulation() {
  const auto reset = [this](bool active) {
    if (pins_.reset != nullptr) set_pin(*pins_.reset, active != pins_.reset_is_low ? 1u : 0u);
  };
  if (pins_.enable != nullptr) set_pin(*pins_.enable, std::uint64_t{1});
  for (const PortPins& port : pins_.ports) {
    for (const parallax_pin* pin : {port.is_input ? port.valid : port.ready, port.first, port.last}) {
      if (pin != nullptr) set_pin(*pin, std::uint64_t{0});
    }
    if (port.keep != nullptr)
      set_pin(*port.keep, std::vector<std::uint64_t>((port.keep->width + 63) / 64, ~std::uint64_t{0}));
  }
  reset(false);
  circuit_.evaluate();
  reset(true);
  for (int i = 0; i < kResetCycles; ++i) {
    if (pins_.clock != nullptr) set_pin(*pins_.clock, std::uint64_t{0});
    circuit_.evaluate();
    edge();
  }
  reset(false);
  go_on();
}

void CircuitStage::advance() { go_on(); }

// Whatever lives in the kernel's time has done what it does before now; and where nobody is left who could do
// anything, before the next date at which somebody does.
void CircuitStage::resolve() {
  timer_runs_ = false;
  known_until_ = sc_core::sc_time_stamp();
  if (!sc_core::sc_pending_activity_at_current_time()) {
    known_until_ = sc_core::sc_pending_activity()
                       ? sc_core::sc_time_stamp() + sc_core::sc_time_to_pending_activity()
                       : sc_core::sc_max_time();
  }
  go_on();
}

void CircuitStage::go_on() {
  while (fault_.empty()) {
    if (rests_ && !wakes()) return;
    const bool known = all_known();
    if (!known && clock_.time_of(cycle_) >= known_until_) {
      wait_for_dates();
      return;
    }
    const Cycles moved = moved_;
    step();
    // Others may answer to what has just passed.
    if (moved_ != moved) known_until_ = sc_core::SC_ZERO_TIME;
  }
}

// Whether a token comes, from whose date on the clock runs again.
bool CircuitStage::wakes() {
  for (const auto& input : inputs_) {
    StreamBase& stream = input->end->stream();
    if (stream.read_date_known()) {
      cycle_ = std::max(cycle_, stream.readable_at());
      idle_ = cycle_;
      rests_ = false;
      return true;
    }
    stream.wait_for_token();
  }
  return false;
}

bool CircuitStage::all_known() const {
  for (const auto& input : inputs_) {
    if (input->flush == 0 && !input->end->stream().read_date_known()) return false;
  }
  for (const auto& output : outputs_) {
    for (const CircuitEnd* end : output->ends) {
      if (!end->stream().write_date_known()) return false;
    }
  }
  return true;
}

void CircuitStage::wait_for_dates() {
  for (const auto& input : inputs_) {
    if (!input->end->stream().read_date_known()) input->end->stream().wait_for_token();
  }
  for (const auto& output : outputs_) {
    for (const CircuitEnd* end : output->ends) {
      if (!end->stream().write_date_known()) end->stream().wait_for_room();
    }
  }
  if (std::exchange(timer_runs_, true)) return;
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  const sc_core::sc_time edge = clock_.time_of(cycle_);
  // After a token has passed, in this date's next delta cycle, when the engine has come to rest; else when
  // the edge is over.
  timer_.notify(known_until_ < now ? sc_core::SC_ZERO_TIME : edge + kAfterEdge - now);
}

void CircuitStage::offer(Input& input) {
  const StreamBase& stream = input.end->stream();
  const bool zeros = input.flush > 0;
  const bool there = zeros || (stream.read_date_known() && stream.readable_at() <= cycle_);
  if (there && !input.offered) input.offered = cycle_ >= input.next && !input.stalls.next();
  if (input.pins.valid != nullptr) set_pin(*input.pins.valid, input.offered ? 1u : 0u);
  if (!input.offered || input.loaded) return;
  input.loaded = true;
  const std::uint64_t token = input.tokens % stage_.pass_tokens(input.model);
  const bool has_value =
      !zeros && input.tokens / input.model.frame_tokens < static_cast<std::uint64_t>(frames_);
  if (!has_value || !input.end->front(input.bits)) {
    if (has_value) {
      give_up(
          fmt::format("token {} of {} has no value yet when it is read: another circuit or block in kernel "
                      "time stands upstream, and the stages between work on whole rows",
                      input.tokens, input.model.name));
    }
    input.bits.assign((input.model.shape.format.width().size() + 63) / 64, 0);
  }
  if (input.pins.data.size() == 1) {
    set_pin(*input.pins.data[0].pin, input.bits);
  } else {
    FieldUnpacker fields(input.model.shape.format, input.bits);
    for (const PortPins::Data& data : input.pins.data)
      set_pin(*data.pin, static_cast<std::uint64_t>(fields.next()));
  }
  const std::uint64_t row_tokens = input.model.shape.row_tokens;
  const auto set = [](const parallax_pin* pin, std::uint64_t value) {
    if (pin != nullptr) set_pin(*pin, value);
  };
  set(input.pins.first, !zeros && token == 0 ? 1 : 0);
  set(input.pins.last, !zeros && row_tokens > 0 && token % row_tokens == row_tokens - 1 ? 1 : 0);
  set(input.pins.row, row_tokens > 0 ? token / row_tokens : 0);
  set(input.pins.column, row_tokens > 0 ? token % row_tokens : token);
}

// Whether the circuit's clock may have an edge: it stands where something cannot wait.
bool CircuitStage::can_run() const {
  for (const auto& input : inputs_) {
    if ((needs_all_ || input->pins.valid == nullptr) && !input->offered) return false;
  }
  for (const auto& output : outputs_) {
    if (output->pins.ready == nullptr && output->valid && !output->ready) return false;
  }
  return true;
}

void CircuitStage::step() {
  ++clocked_;
  for (const auto& input : inputs_) offer(*input);
  for (const auto& output : outputs_) {
    output->ready = !output->stalls.next();
    for (const CircuitEnd* end : output->ends) {
      const StreamBase& stream = end->stream();
      output->ready = output->ready && stream.write_date_known() && stream.writable_at() <= cycle_;
    }
    if (output->pins.ready != nullptr) set_pin(*output->pins.ready, output->ready ? 1u : 0u);
  }
  if (pins_.clock != nullptr) set_pin(*pins_.clock, std::uint64_t{0});
  if (pins_.enable != nullptr) set_pin(*pins_.enable, std::uint64_t{1});
  circuit_.evaluate();
  for (const auto& output : outputs_) {
    output->valid = output->pins.valid != nullptr
                        ? is_set(*output->pins.valid)
                        : steps_ >= options_.latency &&
                              steps_ - options_.latency < stage_.pass_tokens(output->model) + options_.skip;
    watch(*output);
  }
  const bool stands = !can_run();
  bool moved = false;
  // What is written was there before the edge, as what is read is.
  for (const auto& output : outputs_) moved |= put(*output, stands);
  for (const auto& input : inputs_) moved |= take(*input, stands);
  if (moved) moved_ = cycle_;
  if (!stands && ++steps_ == of_pass_) steps_ = 0;
  if (stands && pins_.enable != nullptr) {
    set_pin(*pins_.enable, std::uint64_t{0});
    circuit_.evaluate();
  }
  if (!stands || pins_.enable != nullptr) edge();
  if (circuit_.finished())
    give_up(fmt::format("it has ended the simulation ($finish or $stop) in cycle {}", cycle_.count()));
  cycle_ += Cycles(1);
  const std::uint64_t quiet = (cycle_ - std::max(moved_, idle_)).size();
  if (quiet == kRest) rests_ = !owes();
  if (quiet > timeout_) {
    give_up(fmt::format("nothing has moved at its ports since cycle {}: {}", moved_.count(), waits()));
  }
}

bool CircuitStage::put(Output& output, bool stands) {
  if (!output.valid) return false;
  if (!output.ready || stands) {
    output.blocked += Cycles(1);
    output.held = output.pins.ready != nullptr && !output.ready;
    return false;
  }
  output.held = false;
  if (output.skip > 0) {
    --output.skip;
    return true;
  }
  if (output.tokens == begun() * output.model.frame_tokens && breach_.empty()) {
    breach_ = fmt::format("{}: a token more than the {} of frame {}, in cycle {}", output.model.name,
                          output.model.frame_tokens, begun() - 1, cycle_.count());
  }
  if (output.pins.data.size() == 1) {
    read_pin(*output.pins.data[0].pin, output.bits);
  } else {
    FieldPacker fields(output.model.shape.format, output.bits);
    for (const PortPins::Data& data : output.pins.data) {
      std::vector<std::uint64_t> value;
      read_pin(*data.pin, value);
      const bool negative = data.field.is_signed && (value[0] >> (data.field.width - 1) & 1u) != 0;
      fields.next(
          static_cast<std::int64_t>(negative ? value[0] | ~std::uint64_t{0} << data.field.width : value[0]));
    }
  }
  const bool has_value = output.tokens / output.model.frame_tokens < static_cast<std::uint64_t>(frames_);
  if (has_value) {
    output.dump.words.append(output.bits);
    output.dump.cycles.push_back(cycle_.count());
  }
  for (CircuitEnd* end : output.ends) {
    if (has_value) end->send(output.bits);
    end->stream().mark_written(cycle_, output.blocked);
  }
  output.blocked = Cycles(0);
  if (++output.tokens % stage_.pass_tokens(output.model) == 0) output.skip = options_.skip;
  return true;
}

bool CircuitStage::take(Input& input, bool stands) {
  const bool wanted = !stands && (input.pins.ready == nullptr || is_set(*input.pins.ready));
  if (!input.offered) {
    if (input.pins.ready != nullptr && wanted) input.starved += Cycles(1);
    return false;
  }
  if (!wanted) return false;
  input.offered = input.loaded = false;
  input.next = cycle_ + Cycles(static_cast<std::int64_t>(options_.interval));
  if (input.flush > 0) {
    --input.flush;
    return true;
  }
  input.end->pop();
  input.end->stream().mark_read(cycle_, input.starved);
  input.starved = Cycles(0);
  if (++input.tokens % stage_.pass_tokens(input.model) == 0) input.flush = flush_;
  return true;
}

// A token that is offered stays until it is taken.
void CircuitStage::watch(Output& out) {
  if (out.pins.ready == nullptr || out.pins.valid == nullptr || !breach_.empty()) return;
  if (out.held && !out.valid) {
    breach_ = fmt::format("{}: valid goes from 1 to 0 before token {} was taken, in cycle {}", out.model.name,
                          out.tokens, cycle_.count());
  }
  if (!out.valid || (!out.held && out.ready)) return;
  read_pin(*out.pins.data[0].pin, out.bits);
  if (out.held && out.bits != out.before) {
    breach_ = fmt::format("{}: the data change before token {} was taken, in cycle {}", out.model.name,
                          out.tokens, cycle_.count());
  }
  out.before.swap(out.bits);
}

void CircuitStage::edge() {
  if (pins_.clock == nullptr) return;
  set_pin(*pins_.clock, std::uint64_t{1});
  circuit_.evaluate();
}

void CircuitStage::give_up(const std::string& why) {
  if (!fault_.empty()) return;
  fault_ = why;
  stop_();
}

// Frames of which a token has come.
std::uint64_t CircuitStage::begun() const {
  std::uint64_t frames = 0;
  for (const auto& input : inputs_) {
    const std::uint64_t tokens = input->tokens + (input->offered && input->flush == 0 ? 1 : 0);
    frames = std::max(frames, (tokens + input->model.frame_tokens - 1) / input->model.frame_tokens);
  }
  return frames;
}

// Whether something is due: a frame is begun and not written, or a token is there that is not taken.
bool CircuitStage::owes() const {
  const std::uint64_t frames = begun();
  return std::any_of(inputs_.begin(), inputs_.end(), [](const auto& input) { return input->offered; }) ||
         std::any_of(outputs_.begin(), outputs_.end(), [&](const auto& output) {
           return output->tokens < frames * output->model.frame_tokens;
         });
}

// What each port waits for.
std::string CircuitStage::waits() const {
  std::string text;
  const auto say = [&text](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  for (const auto& input : inputs_) {
    const std::uint64_t token = input->tokens % input->model.frame_tokens;
    const std::uint64_t frame = input->tokens / input->model.frame_tokens;
    const std::string place = fmt::format("token {} of frame {}", token, frame);
    if (input->offered) {
      say(fmt::format("{} offers {}, and the circuit is not ready", input->model.name, place));
    } else {
      say(fmt::format("{} has no token ({} comes next)", input->model.name, place));
    }
  }
  for (const auto& output : outputs_) {
    const std::uint64_t token = output->tokens % output->model.frame_tokens;
    const std::uint64_t frame = output->tokens / output->model.frame_tokens;
    say(fmt::format("at {} {} {} of frame {}", output->model.name,
                    output->valid ? "there is no room for token" : "the circuit does not offer token", token,
                    frame));
  }
  return text;
}

const Dump& CircuitStage::written(const VectorStream& stream) const {
  for (const auto& output : outputs_) {
    if (&output->model == &stream) return output->dump;
  }
  throw std::logic_error("the circuit has no output " + stream.name);
}

}  // namespace parallax

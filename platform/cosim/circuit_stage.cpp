// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace parallax {
namespace {

constexpr int kResetCycles = 8;
constexpr std::uint64_t kPatience = 100000;  // cycles
constexpr std::uint64_t kRest = 1000;        // cycles without anything due, after which the clock stands

// What others do at an edge of their own is over 1 ps behind it; circuits follow, one a picosecond.
sc_core::sc_time after_edge(std::size_t order) {
  return sc_core::sc_time(1 + static_cast<double>(order), sc_core::SC_PS);
}

// Puts those that pass together into one group each.
template <class Port>
void join(const std::vector<std::unique_ptr<Port>>& ports, std::vector<std::vector<Port*>>& groups) {
  for (const auto& port : ports) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&port](const std::vector<Port*>& others) {
      return others.front()->port().pins.joined_with(port->port().pins);
    });
    if (group != groups.end()) {
      group->push_back(port.get());
    } else {
      groups.push_back({port.get()});
    }
  }
}

}  // namespace

CircuitStage::CircuitStage(const sc_core::sc_module_name& name, Circuit& circuit, const CircuitPins& pins,
                           const StageRecord& model, const CircuitOptions& options, std::size_t order,
                           const StageContext& context, std::function<void()> stop)
    : sc_module(name),
      circuit_(circuit),
      pins_(pins),
      where_(fmt::format("circuit {} in the place of {}", circuit.name(), model.manifest.stage)),
      options_(options),
      dataflow_(context.dataflow),
      clock_(context.clock),
      stop_(std::move(stop)),
      after_edge_(after_edge(order)) {
  const VectorManifest& stage = model.manifest;
  std::uint64_t seed = options.seed;
  std::uint64_t of_pass = 0;
  for (std::size_t i = 0; i < stage.streams.size(); ++i) {
    const VectorStream& stream = stage.streams[i];
    const CircuitPort port{stage, stream, model.streams[i], pins.ports[i], options};
    timeout_ = std::max({timeout_, kPatience, 4 * stream.frame_tokens});
    ++seed;
    if (stream.is_input) {
      inputs_.push_back(std::make_unique<CircuitInput>(port, seed));
      of_pass = std::max(of_pass, port.pass_tokens() + port.pass_flush());
    } else {
      outputs_.push_back(std::make_unique<CircuitOutput>(port, seed));
      needs_all_ |= !port.pins.valid;
    }
  }
  delay_.configure(options.latency, of_pass);
  timeout_ += options.row_gap + options.frame_gap;
  join(inputs_, joined_inputs_);
  join(outputs_, joined_outputs_);
  if (options.stall > 0) {
    for (const auto& outputs : joined_outputs_) probes_.emplace_back(circuit_, outputs);
  }
  if (options.timeout) timeout_ = *options.timeout;
  SC_HAS_PROCESS(CircuitStage);
  SC_METHOD(resolve);
  sensitive << timer_;
  dont_initialize();
}

CircuitStage::~CircuitStage() = default;

void CircuitStage::add(std::unique_ptr<CircuitEnd> end) {
  bool known = false;
  for (const auto& input : inputs_) {
    if (input->port().stream.port != end->port()) continue;
    input->bind(*end);
    known = true;
  }
  for (const auto& output : outputs_) {
    if (output->port().stream.port != end->port()) continue;
    output->add(*end);
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
    if (pins_.reset) pins_.reset.set(active != pins_.reset_is_low ? 1 : 0);
  };
  if (pins_.enable) pins_.enable.set(1);
  for (const PortPins& port : pins_.ports) {
    for (const PinBits& pin : {port.is_input ? port.valid : port.ready, port.first, port.last,
                               port.line_valid, port.frame_valid}) {
      if (pin && pin.pin().is_input != 0) pin.set(0);
    }
    if (port.keep)
      port.keep.set(std::vector<std::uint64_t>((port.keep.width() + 63) / 64, ~std::uint64_t{0}));
  }
  watch_ = std::make_unique<CircuitWatch>(circuit_, where_, options_.seconds);
  reset(false);
  circuit_.evaluate();
  reset(true);
  for (int i = 0; i < kResetCycles; ++i) {
    set_clock(false);
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
    // Another circuit may act at an edge as long ago as its turn comes behind it.
    if (!sc_core::sc_pending_activity()) {
      known_until_ = sc_core::sc_max_time();
    } else if (sc_core::sc_time_to_pending_activity() > after_edge(kMost)) {
      known_until_ += sc_core::sc_time_to_pending_activity() - after_edge(kMost);
    }
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
    StreamBase& stream = input->stream();
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
  return std::all_of(inputs_.begin(), inputs_.end(), [](const auto& input) { return input->date_known(); }) &&
         std::all_of(outputs_.begin(), outputs_.end(),
                     [](const auto& output) { return output->dates_known(); });
}

void CircuitStage::wait_for_dates() {
  for (const auto& input : inputs_) {
    if (!input->stream().read_date_known()) input->stream().wait_for_token();
  }
  for (const auto& output : outputs_) {
    for (const CircuitEnd* end : output->ends()) {
      if (!end->stream().write_date_known()) end->stream().wait_for_room();
    }
  }
  if (std::exchange(timer_runs_, true)) return;
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  const sc_core::sc_time edge = clock_.time_of(cycle_);
  // After a token has passed, in this date's next delta cycle, when the engine has come to rest; else when
  // the edge is over.
  timer_.notify(known_until_ < now ? sc_core::SC_ZERO_TIME : edge + after_edge_ - now);
}

// Whether the circuit's clock may have an edge: it stands where something cannot wait.
bool CircuitStage::can_run() const {
  for (const auto& input : inputs_) {
    if (lacks_token(*input)) return false;
  }
  return has_room();
}

// Whether an edge that would take a token at each input takes none, since one of them shows that it has none.
bool CircuitStage::goes_without_token() const {
  return needs_all_ && std::any_of(inputs_.begin(), inputs_.end(),
                                   [this](const auto& input) { return input->shows_none(paced_); });
}

bool CircuitStage::has_room() const {
  return std::none_of(outputs_.begin(), outputs_.end(),
                      [](const auto& output) { return lacks_room(*output); });
}

bool CircuitStage::lacks_token(const CircuitInput& input) const {
  return (needs_all_ || !input.port().pins.valid) && !input.offered() && !input.shows_none(paced_);
}

// Whether what is at an output without valid lies behind the last result of a pass.
bool CircuitStage::is_behind(const CircuitOutput& output) const {
  return delay_.number() >= output.port().pass_tokens() + options_.skip;
}

bool CircuitStage::lacks_room(const CircuitOutput& output) {
  return !output.port().pins.ready && output.valid() && !output.ready();
}

void CircuitStage::step() {
  ++clocked_;
  watch_->at(cycle_);
  for (const auto& input : inputs_) {
    if (input->offer(cycle_, paced_)) due_ = cycle_;
  }
  for (const auto& output : outputs_) output->make_ready(cycle_);
  const bool bare = goes_without_token();
  for (const auto& inputs : joined_inputs_) {
    const bool all =
        std::all_of(inputs.begin(), inputs.end(), [](const CircuitInput* input) { return input->offered(); });
    for (CircuitInput* const input : inputs) input->present(all && !bare);
  }
  for (const auto& outputs : joined_outputs_) {
    const bool all = std::all_of(outputs.begin(), outputs.end(),
                                 [](const CircuitOutput* output) { return output->ready(); });
    for (CircuitOutput* const output : outputs) output->present(all);
  }
  set_clock(false);
  if (pins_.enable) pins_.enable.set(1);
  circuit_.evaluate();
  for (ReadyProbe& probe : probes_) probe.look(cycle_);
  for (const auto& output : outputs_) {
    output->look(cycle_, delay_.there(!bare) && !is_behind(*output));
  }
  const bool stands = !can_run();
  bool moved = false;
  // What is written was there before the edge, as what is read is.
  const std::uint64_t frames = begun();
  for (const auto& output : outputs_) moved |= output->put(cycle_, stands, frames);
  for (const auto& input : inputs_) moved |= input->take(cycle_, paced_, stands);
  if (moved) moved_ = cycle_;
  for (const auto& output : outputs_) {
    const bool drops = !output->port().pins.valid && delay_.there(!bare) && delay_.within_pass();
    if (!stands && drops && is_behind(*output)) output->drop();
  }
  if (!stands && needs_all_) delay_.edge(!bare);
  if (has_room()) ++paced_;
  if (stands && pins_.enable) {
    pins_.enable.set(0);
    circuit_.evaluate();
  }
  const bool clocked = !stands || pins_.enable;
  if (waves_) {
    waves_->take(cycle_, clocked, moved);
    if (!waves_->any()) look_for_first();
  }
  if (clocked) edge();
  if (circuit_.finished())
    give_up(fmt::format("it has ended the simulation ($finish, $stop or an error of Verilator's) in cycle {}",
                        cycle_.count()));
  cycle_ += Cycles(1);
  const std::uint64_t quiet = (cycle_ - std::max({moved_, idle_, due_})).size();
  if (quiet == std::min(kRest, timeout_)) rests_ = !owes();
  if (!rests_ && quiet > timeout_) {
    const std::string since = moved_ > Cycles(0) ? fmt::format(" since cycle {}", moved_.count()) : "";
    give_up(fmt::format("nothing has moved at its ports{}: {}", since, waits()));
  }
}

void CircuitStage::edge() {
  if (pins_.clock == nullptr) return;
  set_clock(true);
  circuit_.evaluate();
}

void CircuitStage::set_clock(bool high) {
  if (pins_.clock != nullptr) *static_cast<unsigned char*>(pins_.clock->at) = high ? 1 : 0;
}

void CircuitStage::keep_waves(std::uint64_t cycles) {
  waves_ = std::make_unique<CircuitWaves>(circuit_, pins_, outputs_, cycles);
}

std::optional<PinWaves> CircuitStage::waves() const {
  if (!waves_ || !waves_->any()) return std::nullopt;
  return waves_->waves(clock_);
}

void CircuitStage::look_for_first() {
  for (const auto& output : outputs_) {
    const std::string& stream = output->port().stream.name;
    const std::uint64_t token = output->tokens() - 1;
    if (!output->breach().empty()) {
      waves_->happened(output->breach(), cycle_);
    } else if (!output->framing().breach().empty()) {
      waves_->happened(output->framing().breach(), cycle_);
    } else if (output->differs()) {
      waves_->happened(fmt::format("{}: {} is the first that differs", stream, output->port().place(token)),
                       cycle_);
    } else if (output->late()) {
      waves_->happened(fmt::format("{}: {} is the first that is later than the bound", stream,
                                   output->port().place(token)),
                       cycle_);
    }
  }
}

void CircuitStage::give_up(const std::string& why) {
  if (!fault_.empty()) return;
  fault_ = why;
  if (waves_) waves_->happened(why, moved_);
  stop_();
}

// Frames of which a token has come.
std::uint64_t CircuitStage::begun() const {
  std::uint64_t frames = 0;
  for (const auto& input : inputs_) {
    const std::uint64_t of_frame = input->port().stream.frame_tokens;
    frames = std::max(frames, (input->tokens_begun() + of_frame - 1) / of_frame);
  }
  return frames;
}

// Whether something is due: a frame is begun and not written, or a token is there that is not taken.
bool CircuitStage::owes() const {
  const std::uint64_t frames = begun();
  return std::any_of(inputs_.begin(), inputs_.end(), [](const auto& input) { return input->offered(); }) ||
         std::any_of(outputs_.begin(), outputs_.end(),
                     [frames](const auto& output) { return output->owes(frames); });
}

}  // namespace parallax

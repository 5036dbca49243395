// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <systemc>
#include <utility>
#include <vector>

#include "platform/config/stream_config.hpp"
#include "platform/machine/circuit_end.hpp"
#include "platform/machine/frame_count.hpp"
#include "platform/machine/stage_slot.hpp"
#include "platform/machine/token_port.hpp"
#include "platform/machine/token_shape.hpp"
#include "tlm/fork_depths.hpp"
#include "tlm/stream.hpp"

namespace parallax {

/// A port of what stands in a slot, by their names.
struct PortName {
  std::string slot;
  std::string port;
};

/// Stages and the streams between them: slots are filled, ports are connected, and when all is known the
/// streams are made, as deep as the graph needs them. All of it lives in the module under construction.
class Wiring {
 public:
  /// Facts of a slot that do not depend on what stands there.
  struct Facts {
    std::size_t passes = 1;   ///< times that it goes through its schedule for one frame
    bool enabled = true;      ///< false: tokens pass it as they are
    std::uint64_t group = 0;  ///< tokens of a pixel, if it reads or writes them in groups; else 0
    Bits storage{0};          ///< beside what the module itself says
  };
  struct Slot {
    std::string name;
    Facts facts;
    SlotModule content;
    bool is_usual;  ///< no replacement
  };
  enum class Reads {
    kAhead,  ///< the reader looks ahead on this stream
    kLate,   ///< it reads a token with the one that it writes
  };

  /// `streams` must outlive the wiring. std::logic_error, here and below, for what does not fit together.
  Wiring(const StreamConfig& streams, const StageContext& context, StageReplacements replacements);

  /// Fills the next slot (upstream to downstream): with its replacement, or by `usual`.
  Slot& place(const std::string& name, const Facts& facts, const StageFactory& usual);
  /// Fills it with its replacement, or a stage made of its name and `arguments`; returns that, or nullptr.
  template <class S, class... Arguments>
  S* place(const std::string& name, const Facts& facts, Arguments&&... arguments) {
    S* made = nullptr;
    place(name, facts, [&](const std::string& own, const StageContext&) {
      auto stage = std::make_unique<S>(own.c_str(), std::forward<Arguments>(arguments)...);
      made = stage.get();
      return slot_module(std::move(stage));
    });
    return made;
  }

  /// A stream of tokens of this shape; `groups`: a pixel is as many of them as its slots say. Depth and kind
  /// are configured under its name.
  template <class T>
  void connect(const std::string& stream, const TokenShape& shape, const PortName& from, const PortName& to,
               Reads reads = Reads::kAhead, bool groups = false);
  /// One end of a stream that is there already: at a port of the memory. `frame_tokens`: of a frame, all
  /// tiles of it; 0: not known.
  template <class T>
  void attach(Stream<T>& stream, const TokenShape& shape, const PortName& port,
              std::uint64_t frame_tokens = 0) {
    stream.require_width(shape.format.width());
    const bool is_input = bind<T>(stream, shape, port);
    ends_.push_back({port, is_input, stream.basename(), shape, frame_tokens,
                     [&stream, shape](bool reads, const TokenTap::Take& take) {
                       return std::make_unique<ValueTap<T>>(stream, shape, reads, take);
                     },
                     [&stream, shape, name = port.port, is_input] {
                       return std::make_unique<ValueEnd<T>>(name, !is_input, shape, stream);
                     },
                     [&stream, is_input, fields = kWiredFields<T>](FrameSize frame) {
                       frame.values /= fields;
                       return std::make_unique<ValueCount<T>>(stream, is_input, frame);
                     }});
  }

  /// Makes and binds the streams. Nothing can be placed or connected behind this.
  void build();
  /// After elaboration. Throws UserError when by their schedules the stages at both ends of a stream do not
  /// agree on the tokens of a frame; from then on what passes each slot is counted (FrameCount).
  void check_frames();

  /// "frame 0, row 1": where token number `token` of a stream lies; empty where that is not known.
  std::string place(const std::string& stream, std::uint64_t token) const;
  /// Whether what stands in a slot is neither a stage nor a circuit.
  bool has_kernel_time_blocks() const;

  const std::vector<std::unique_ptr<Slot>>& slots() const { return slots_; }
  const Slot& slot(const std::string& name) const { return *slots_[index(name)]; }
  /// The ports of what stands in a slot, inputs first, after build().
  std::vector<TokenPort> ports(const std::string& slot) const;
  /// The stream of that name, after build().
  template <class T>
  Stream<T>& stream(const std::string& name) const;

 private:
  struct Wire {
    std::string name;
    Bits width;
    std::size_t from, to;  // slots
    Reads reads;
    bool groups;
    std::function<std::unique_ptr<StreamBase>(const char* name, const FifoConfig& fifo)> make;  // and bind
  };

  struct End {  // of a stream
    PortName port;
    bool is_input;
    std::string stream;
    TokenShape shape;
    std::uint64_t frame_tokens;  // 0: not known
    std::function<std::unique_ptr<TokenTap>(bool reads, const TokenTap::Take& take)> tap;
    std::function<std::unique_ptr<CircuitEnd>()> opposite;
    std::function<std::unique_ptr<PortCount>(FrameSize frame)> count;  // `frame.values` in fields
  };

  std::size_t index(const std::string& slot) const;
  std::uint64_t frame_tokens(const TokenShape& shape) const;
  sc_core::sc_object& port(const PortName& name) const;
  [[noreturn]] static void misfit(const PortName& name);
  std::uint64_t scheduled_tokens(const End& end) const;
  FrameSize frame_size(const End& end) const;
  void check_schedules(bool usual) const;
  // Says whether the port is an input.
  template <class T>
  bool bind(Stream<T>& stream, const TokenShape& shape, const PortName& name) const {
    if (auto* circuit = dynamic_cast<CircuitEnds*>(slots_[index(name.slot)]->content.module.get())) {
      const bool is_input = name.port.rfind("in_", 0) == 0;
      circuit->add(std::make_unique<ValueEnd<T>>(name.port, is_input, shape, stream));
      return is_input;
    }
    sc_core::sc_object& found = port(name);
    if (auto* out = dynamic_cast<StreamOut<T>*>(&found)) {
      (*out)(stream);
      return false;
    }
    auto* in = dynamic_cast<StreamIn<T>*>(&found);
    if (in == nullptr) misfit(name);
    (*in)(stream);
    return true;
  }

  const StreamConfig& streams_config_;
  const StageContext context_;
  const StageReplacements replacements_;
  std::vector<std::unique_ptr<Slot>> slots_;
  std::vector<Wire> wires_;
  std::vector<End> ends_;
  std::vector<std::unique_ptr<StreamBase>> streams_;
  std::vector<std::unique_ptr<FrameCount>> counts_;
};

template <class T>
void Wiring::connect(const std::string& stream, const TokenShape& shape, const PortName& from,
                     const PortName& to, Reads reads, bool groups) {
  const auto make = [this, shape, from, to](const char* name, const FifoConfig& fifo) {
    auto made = std::make_unique<Stream<T>>(name, context_.dataflow, context_.clock, context_.clock, fifo);
    attach(*made, shape, from, frame_tokens(shape));
    attach(*made, shape, to, frame_tokens(shape));
    return made;
  };
  wires_.push_back({stream, shape.format.width(), index(from.slot), index(to.slot), reads, groups, make});
}

template <class T>
Stream<T>& Wiring::stream(const std::string& name) const {
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    auto* const found = dynamic_cast<Stream<T>*>(streams_[i].get());
    if (wires_[i].name == name && found != nullptr) return *found;
  }
  throw std::logic_error("no stream " + name + " of these tokens");
}

}  // namespace parallax

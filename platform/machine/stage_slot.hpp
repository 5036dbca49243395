// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <systemc>
#include <type_traits>
#include <utility>

#include "modules/raster_schedule.hpp"
#include "tlm/stage.hpp"

namespace parallax {

struct MachineConfig;

/// What stands in a slot of the pipeline, between its input and its output streams: a stage, or a block in
/// kernel time. Its stream ports are found by their names, which are those of the stage that usually stands
/// there ("in_left", say), and take the same tokens.
struct SlotModule {
  std::unique_ptr<sc_core::sc_module> module;
  /// The same, if it is one; else reports leave it out.
  const Stage* stage = nullptr;
  /// Whether it takes tokens of several pixels (StageContext), as stages do. A block that reads and writes
  /// values one by one does not.
  bool takes_tokens = false;
  std::uint64_t look_ahead = 0;  ///< tokens of pixels that it has read beyond the one that it writes
  std::uint64_t latency = 0;     ///< cycles of the core's clock from reading to writing
  Bits storage{0};               ///< line buffers and the like
  /// Called, if there is one, for the next frame with values: its configuration, or nullptr: as before.
  std::function<void(const MachineConfig* next)> follow{};
};

/// A stage, or a block in kernel time, with what it says of itself: latency(), look_ahead() and storage(), as
/// far as it has them.
template <class S>
SlotModule slot_module(std::unique_ptr<S> block);

/// Makes what stands in a slot, under the slot's name.
using StageFactory = std::function<SlotModule(const std::string& name, const StageContext& context)>;

/// What takes the place of the usual stages, by the names of their slots (as in reports: "census"). An empty
/// factory: the usual stage.
using StageReplacements = std::map<std::string, StageFactory>;

/// In place of a name, all slots that are not named.
constexpr const char* kAllOtherSlots = "*";

namespace detail {

template <class S, class = void>
struct HasLookAhead : std::false_type {};
template <class S>
struct HasLookAhead<S, std::void_t<decltype(std::declval<const S&>().look_ahead())>> : std::true_type {};

template <class S, class = void>
struct HasLatency : std::false_type {};
template <class S>
struct HasLatency<S, std::void_t<decltype(std::declval<const S&>().latency())>> : std::true_type {};

template <class S, class = void>
struct HasStorage : std::false_type {};
template <class S>
struct HasStorage<S, std::void_t<decltype(std::declval<const S&>().storage())>> : std::true_type {};

}  // namespace detail

template <class S>
SlotModule slot_module(std::unique_ptr<S> block) {
  SlotModule slot;
  if constexpr (detail::HasLatency<S>::value) slot.latency = block->latency();
  if constexpr (detail::HasLookAhead<S>::value) slot.look_ahead = block->look_ahead();
  if constexpr (detail::HasStorage<S>::value) slot.storage = block->storage();
  if constexpr (std::is_base_of_v<Stage, S>) {
    slot.stage = block.get();
    slot.takes_tokens = true;
    if (block->writing_side() != nullptr) slot.latency += block->writing_side()->latency();
  }
  slot.module = std::move(block);
  return slot;
}

}  // namespace parallax

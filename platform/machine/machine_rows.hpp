// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <unordered_map>

#include "platform/machine/machine.hpp"
#include "traces/row_ends.hpp"
#include "traces/stage_rows.hpp"

namespace parallax {

/// Where the image's rows are in what passes the stages and streams of a machine, after elaboration; those of
/// its memory's ports are MemoryPort::rows.
class MachineRows {
 public:
  explicit MachineRows(const Machine& machine);

  /// Of a stream's tokens; none for bursts, which rows do not end with.
  std::shared_ptr<const RowEnds> of(const StreamBase& stream) const;
  /// Of a stage's firings.
  StagePorts of(const StageInfo& info) const;

 private:
  void add(const StreamBase& stream, std::uint64_t tokens_of_a_frame);

  const Machine& machine_;
  const std::int32_t height_;
  const std::int32_t tiles_;
  const std::uint64_t row_tokens_;         // of a tile
  const StreamBase* map_words_ = nullptr;  // the compressed map: the one stream whose rows differ in length
  std::unordered_map<const StreamBase*, std::shared_ptr<const RowEnds>> streams_;
};

}  // namespace parallax

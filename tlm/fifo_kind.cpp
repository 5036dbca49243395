// SPDX-License-Identifier: Apache-2.0
#include "tlm/fifo_kind.hpp"

#include <stdexcept>

namespace parallax {

const char* name_of(FifoKind kind) {
  switch (kind) {
    case FifoKind::kFree:
      return "free";
    case FifoKind::kRegistered:
      return "registered";
    case FifoKind::kFirstWordFallThrough:
      return "first_word_fall_through";
    case FifoKind::kBlockRam:
      return "block_ram";
    case FifoKind::kAsynchronous:
      return "asynchronous";
  }
  throw std::logic_error("no such kind of FIFO");
}

FifoOffsets offsets_of(FifoKind kind, const SynchroniserStages& stages) {
  switch (kind) {
    case FifoKind::kFree:
      break;
    case FifoKind::kRegistered:
      return {1, 1};
    case FifoKind::kFirstWordFallThrough:
      return {0, 1};
    case FifoKind::kBlockRam:
      return {2, 1};
    case FifoKind::kAsynchronous:
      return {1 + stages.to_reader, 1 + stages.to_writer};
  }
  throw std::logic_error("this kind of FIFO has no offsets of its own");
}

}  // namespace parallax

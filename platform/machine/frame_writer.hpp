// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "tlm/dma.hpp"
#include "tlm/transfer_progress.hpp"

namespace parallax {

/// An engine that writes frames, row by row, for another one that reads each while it comes.
struct FrameWriter {
  std::shared_ptr<TransferProgress> progress;  ///< null: a frame is read when all of it is in memory
  std::uint64_t height = 0;                    ///< rows of a frame
  std::function<std::uint64_t(std::uint64_t rows)> bursts_until;  ///< that hold the first rows of a frame

  /// Lets `job`, which reads `frame` or some columns of it in rows of equal length, wait for each row until
  /// all of it is there. This object must outlive the job.
  void lead(DmaJob& job, std::int64_t frame) const {
    if (!progress) return;
    job.behind = progress;
    job.needed = [this, before = static_cast<std::uint64_t>(frame) * bursts_until(height),
                  row = std::uint64_t{job.row_bytes.front()}](std::uint64_t last_byte) {
      return before + bursts_until((last_byte + row - 1) / row);
    };
  }
};

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/host.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <systemc>
#include <utility>

namespace parallax {

void Host::expect(const Disparity* row) {
  const std::size_t width = input_.width;
  const std::size_t height = input_.height;
  leaving_.resize(width * height);
  const Tile& tile = tiles_.tiles[rows_ / height];
  std::copy(row + (tile.keep_begin - tile.begin), row + (tile.keep_end - tile.begin),
            leaving_.data() + rows_ % height * width + tile.keep_begin);
  if (++rows_ < tiles_.tiles.size() * height) return;
  rows_ = 0;
  expected_.push_back(std::move(leaving_));
  leaving_.clear();
}

FrameResult Host::unpack(std::int64_t frame, const std::vector<std::uint8_t>& bytes) {
  FrameResult result;
  result.index = frame;
  if (bytes.empty()) return result;
  const std::size_t width = input_.width;
  const std::size_t height = input_.height;
  const std::size_t row_bytes = OutputPacking::row_bytes(input_.width, left_);
  std::vector<std::uint16_t> values(width);
  result.disparities = std::move(expected_.front());
  expected_.pop_front();
  result.left.resize(result.disparities.size());
  for (std::size_t y = 0; y < height; ++y) {
    unpack_output(bytes.data() + y * row_bytes, input_.width, left_, result.left.data() + y * width,
                  values.data());
    for (std::size_t x = 0; x < width; ++x) {
      if (result.disparities[y * width + x].value == values[x]) continue;
      SC_REPORT_ERROR(
          "/parallax/machine/values",
          fmt::format("frame {}: the host's disparity at ({}, {}) is not the pipeline's", frame, x, y)
              .c_str());
    }
  }
  return result;
}

void Host::receive(std::int64_t frame, const std::vector<std::uint8_t>& bytes) {
  const FrameResult result = unpack(frame, bytes);
  if (done_) return;  // the simulation goes on, though the run is over
  if (input_.deliver) input_.deliver(result);
  ++frames_;
  done_ = frames_ == input_.frames || (input_.least_frames > 0 && frames_ >= input_.least_frames && ended_());
  if (!done_) return;
  input_.finished ? input_.finished() : sc_core::sc_stop();
}

}  // namespace parallax

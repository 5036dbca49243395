// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/right_images.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace parallax {
namespace {

Stream<Gray>& right_rectified(const Machine& machine) {
  for (StreamBase* stream : machine.dataflow().streams()) {
    auto* const pixels = dynamic_cast<Stream<Gray>*>(stream);
    if (pixels != nullptr && pixels->basename() == std::string("right_rectified")) return *pixels;
  }
  throw std::logic_error("the machine has no stream right_rectified");
}

}  // namespace

RightImages::RightImages(const Machine& machine)
    : tiles_(machine.tiles()), size_(machine.input().width, machine.input().height), rows_(tiles_.width) {
  right_rectified(machine).add_row_listener(*this);
}

void RightImages::row(const StreamBase&, const Gray* values, std::size_t size) {
  rows_.push(values, size, [this](const Gray* row, std::size_t) { keep(row); });
}

// A frame comes tile by tile, of which each keeps some columns.
void RightImages::keep(const Gray* row) {
  if (kept_ == 0) coming_.create(size_, CV_8UC1);
  const std::size_t height = size_.height;
  const Tile& tile = tiles_.tiles[kept_ / height];
  std::copy(row + (tile.keep_begin - tile.begin), row + (tile.keep_end - tile.begin),
            coming_.ptr<Gray>(static_cast<int>(kept_ % height)) + tile.keep_begin);
  if (++kept_ < tiles_.tiles.size() * height) return;
  kept_ = 0;
  whole_.push_back(std::exchange(coming_, {}));
}

cv::Mat RightImages::take() {
  if (whole_.empty()) throw std::logic_error("the host has a frame before it is rectified");
  cv::Mat image = whole_.front();
  whole_.pop_front();
  return image;
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/sensor.hpp"

#include <algorithm>
#include <utility>

namespace parallax {

Sensor::Sensor(const sc_core::sc_module_name& name, const SensorConfig& config, const ClockDomain& clock,
               Dataflow& dataflow)
    : sc_module(name), config_(config), clock_(clock), dataflow_(dataflow), at_(image_bytes()) {
  SC_HAS_PROCESS(Sensor);
  SC_METHOD(advance);
  sensitive << go_on_;
  dont_initialize();
}

void Sensor::read_out(SensorImage image, Cycles delay, LostRows lost, std::shared_ptr<Received> received) {
  exposed_.push_back({std::move(image), clock_.now() + delay, lost, std::move(received)});
  go_on_.notify();
}

void Sensor::read_out_unheard(Cycles begin) {
  free_ = begin + frame_time();
  busy_ += frame_time();
}

bool Sensor::reads_out_in(Cycles cycle) const {
  return !exposed_.empty() || at_ < image_bytes() || std::max(free_, last_write_) > cycle;
}

Cycles Sensor::frame_time() const { return config_.row * config_.height + config_.frame_blanking; }

Cycles Sensor::busy() const { return busy_ - std::max(Cycles(0), free_ - clock_.now()); }

void Sensor::advance() {
  StreamBase& out = *out_bursts[0];
  while (at_ < image_bytes() || begin_image()) {
    const std::int64_t bytes = image_bytes();
    if (!out.write_date_known()) {
      out.wait_for_room();
      return;
    }
    const std::int64_t end = std::min(at_ + config_.burst.count(), bytes);
    const Cycles complete = due(end - 1);
    const Cycles free = std::max(complete, last_write_ + Cycles(1));
    const Cycles room = out.writable_at();
    last_write_ = std::max(free, room);
    if (last_write_ > complete) note_late_burst();
    out.mark_written(last_write_, last_write_ - free);
    at_ = end;
  }
}

// When a byte of the image is there: with the pixel that its last bit belongs to, and not before the cable
// has brought it.
Cycles Sensor::due(std::int64_t byte) const {
  const std::int64_t bytes = byte % row_bytes() + 1;  // of the row
  const std::int64_t last_bit = bytes * 8 - 1;
  std::int64_t row = byte / row_bytes();
  if (row >= lost_.first) row += lost_.count;
  const Cycles pixel(last_bit / bits_per_pixel(config_.format) + 1);
  return begin_ + config_.row * row + std::max(pixel, Cycles(config_.byte_time.ceil(bytes)));
}

void Sensor::send(const SensorImage& image) {
  if (config_.format == PixelFormat::kMono8) {
    out_bursts.send_row(image->data(), image->size());
    return;
  }
  const std::size_t width = config_.width;
  std::vector<std::uint8_t> bytes(row_bytes());
  for (std::size_t y = 0; y < static_cast<std::size_t>(config_.height); ++y) {
    pack_pixels(config_.format, image->data() + y * width, width, bytes.data());
    out_bursts.send_row(bytes.data(), bytes.size());
  }
}

void Sensor::note_late_burst() {
  for (; !late_to_come_.empty() && has_come(late_to_come_.front()); late_to_come_.pop_front()) ++late_bursts_;
  late_to_come_.push_back(last_write_);
}

bool Sensor::has_come(Cycles cycle) const { return clock_.time_of(cycle) <= sc_core::sc_time_stamp(); }

std::uint64_t Sensor::late_bursts() const {
  std::uint64_t count = late_bursts_;
  for (std::size_t i = 0; i < late_to_come_.size() && has_come(late_to_come_[i]); ++i) ++count;
  return count;
}

// Whether another image is there whose time has come.
bool Sensor::begin_image() {
  if (exposed_.empty()) return false;
  const Cycles begin = std::max({exposed_.front().at, free_, last_write_});
  if (begin > clock_.now()) {
    go_on_.notify(clock_.time_of(begin) - sc_core::sc_time_stamp());
    return false;
  }
  if (const SensorImage image = exposed_.front().image) {
    dataflow_.post([this, image] { send(image); });
  }
  lost_ = exposed_.front().lost;
  const std::shared_ptr<Received> received = exposed_.front().received;
  exposed_.pop_front();
  begin_ = begin;
  if (received) *received = {begin, due(image_bytes() - 1), config_.height - lost_.count};
  free_ = begin + frame_time();
  busy_ += frame_time();
  at_ = 0;
  return true;
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/sensor.hpp"

#include <algorithm>
#include <utility>

namespace parallax {

Sensor::Sensor(const sc_core::sc_module_name& name, const SensorConfig& config, const ClockDomain& clock,
               Dataflow& dataflow)
    : sc_module(name), config_(config), clock_(clock), dataflow_(dataflow) {
  SC_HAS_PROCESS(Sensor);
  SC_THREAD(run);
}

void Sensor::read_out(SensorImage image) {
  images_.push_back(std::move(image));
  exposed_.notify();
}

Cycles Sensor::frame_time() const { return config_.row * config_.height + config_.frame_blanking; }

Cycles Sensor::busy() const { return busy_ - std::max(Cycles(0), free_ - clock_.now()); }

void Sensor::run() {
  const std::int64_t bytes = std::int64_t{config_.width} * config_.height;
  for (;;) {
    while (images_.empty()) sc_core::wait(exposed_);
    if (const SensorImage image = images_.front())
      dataflow_.post([this, image] { out_bursts.send_row(image->data(), image->size()); });
    images_.pop_front();
    const Cycles begin = clock_.now();
    busy_ += frame_time();
    free_ = begin + frame_time();
    for (std::int64_t at = 0; at < bytes; at += config_.burst.count()) {
      const std::int64_t last = std::min(at + config_.burst.count(), bytes) - 1;
      const Cycles due = begin + config_.row * (last / config_.width) + Cycles(last % config_.width + 1);
      clock_.wait_until(due);
      out_bursts[0]->wait_writable();
      if (clock_.now() > due) ++late_bursts_;
      out_bursts[0]->commit();
    }
    clock_.wait_until(free_);
  }
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/ethernet_link.hpp"

#include <algorithm>
#include <utility>

namespace parallax {
namespace {

// Two pixels are five bytes (output_packing.hpp).
constexpr std::int64_t kPixels = 2;
constexpr std::int64_t kPixelBytes = 5;

}  // namespace

EthernetLink::EthernetLink(const sc_core::sc_module_name& name, const LinkConfig& config, Bytes burst,
                           const ClockDomain& clock)
    : sc_module(name),
      config_(config),
      burst_(burst),
      clock_(clock),
      wire_(8 * clock.frequency().count(), config.line_rate),
      host_(config.host_pixel_rate == 0 ? 0 : kPixels * clock.frequency().count(),
            config.host_pixel_rate == 0 ? 1 : kPixelBytes * config.host_pixel_rate) {
  SC_HAS_PROCESS(EthernetLink);
  SC_THREAD(run);
  in_bursts.on_row(0, [this](const std::uint8_t* bytes, std::size_t size) {
    bytes_.insert(bytes_.end(), bytes, bytes + size);
  });
}

void EthernetLink::start(LinkJob job) {
  jobs_.push_back(std::move(job));
  started_.notify();
}

void EthernetLink::run() {
  const std::uint64_t overhead = config_.packet_wire_bytes - config_.packet_payload_bytes;
  const auto burst = static_cast<std::uint64_t>(burst_.count());
  for (;;) {
    while (jobs_.empty()) sc_core::wait(started_);
    job_ = std::move(jobs_.front());
    jobs_.pop_front();
    std::uint64_t received = 0;
    for (std::uint64_t sent = 0; sent < job_.bytes;) {
      const std::uint64_t payload = std::min<std::uint64_t>(config_.packet_payload_bytes, job_.bytes - sent);
      while (received < sent + payload) {
        in_bursts->wait_readable();
        in_bursts->release();
        received += std::min(burst, job_.bytes - received);
      }
      clock_.wait_until(std::max(wire_free_, host_free_));
      const Cycles begin = clock_.now();
      const Cycles wire = wire_.take(static_cast<std::int64_t>(payload + overhead));
      const Cycles host = host_.take(static_cast<std::int64_t>(payload));
      wire_free_ = begin + wire;
      host_free_ = std::max(host_free_, begin) + host;
      wire_busy_ += wire;
      host_busy_ += host;
      ++packets_;
      sent += payload;
    }
    clock_.wait_until(wire_free_);
    finish_frame();
  }
}

void EthernetLink::finish_frame() {
  std::vector<std::uint8_t> bytes;
  if (job_.values) {
    const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(job_.bytes);
    bytes.assign(bytes_.begin(), end);
    bytes_.erase(bytes_.begin(), end);
  }
  job_.sent(bytes);
}

Cycles EthernetLink::wire_busy() const { return wire_busy_ - std::max(Cycles(0), wire_free_ - clock_.now()); }

Cycles EthernetLink::host_busy() const { return host_busy_ - std::max(Cycles(0), host_free_ - clock_.now()); }

}  // namespace parallax

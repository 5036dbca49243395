// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/ethernet_link.hpp"

#include <algorithm>
#include <utility>

namespace parallax {
namespace {

// Whose results take OutputPacking::pair_bytes().
constexpr std::int64_t kPixels = 2;

}  // namespace

EthernetLink::EthernetLink(const sc_core::sc_module_name& name, const LinkConfig& config, Bytes burst,
                           const ClockDomain& clock)
    : sc_module(name),
      config_(config),
      burst_(burst),
      clock_(clock),
      wire_(8 * clock.frequency().count(), config.line_rate),
      host_(config.host_pixel_rate == 0 ? 0 : kPixels * clock.frequency().count(),
            config.host_pixel_rate == 0
                ? 1
                : static_cast<std::int64_t>(OutputPacking::pair_bytes(config.output_left())) *
                      config.host_pixel_rate) {
  SC_HAS_PROCESS(EthernetLink);
  SC_METHOD(advance);
  sensitive << go_on_;
  dont_initialize();
  in_bursts.on_row(0, [this](const std::uint8_t* bytes, std::size_t size) {
    bytes_.insert(bytes_.end(), bytes, bytes + size);
  });
}

void EthernetLink::start(LinkJob job) {
  jobs_.push_back(std::move(job));
  go_on_.notify();
}

void EthernetLink::advance() {
  for (;;) {
    if (!sending_) {
      if (jobs_.empty()) return;
      job_ = std::move(jobs_.front());
      jobs_.pop_front();
      sending_ = true;
      received_ = 0;
      sent_ = 0;
      ready_ = clock_.now();
    }
    while (sent_ < job_.bytes) {
      const std::uint64_t payload = std::min<std::uint64_t>(config_.packet_payload_bytes, job_.bytes - sent_);
      if (!gather(sent_ + payload)) return;
      send_packet(payload);
    }
    if (wire_free_ > clock_.now()) {
      go_on_.notify(clock_.time_of(wire_free_) - sc_core::sc_time_stamp());
      return;
    }
    sending_ = false;
    finish_frame();
  }
}

// Reads until the first `bytes` of the frame are there, if it is known when.
bool EthernetLink::gather(std::uint64_t bytes) {
  while (received_ < bytes) {
    if (!in_bursts->read_date_known()) {
      in_bursts->wait_for_token();
      return false;
    }
    const Cycles free = std::max(ready_, last_read_ + Cycles(1));
    last_read_ = std::max(free, in_bursts->readable_at());
    in_bursts->mark_read(last_read_, last_read_ - free);
    ready_ = last_read_;
    received_ += std::min(static_cast<std::uint64_t>(burst_.count()), job_.bytes - received_);
  }
  return true;
}

void EthernetLink::send_packet(std::uint64_t payload) {
  const std::uint64_t overhead = config_.packet_wire_bytes - config_.packet_payload_bytes;
  ready_ = std::max({ready_, wire_free_, host_free_});
  const Packet packet{ready_, wire_.take(payload + overhead), host_.take(payload)};
  wire_free_ = packet.begin + packet.wire;
  host_free_ = packet.begin + packet.host;
  sent_ += payload;
  packets_.push_back(packet);
  const Cycles now = clock_.now();
  while (!packets_.empty() &&
         packets_.front().begin + std::max(packets_.front().wire, packets_.front().host) <= now) {
    ++past_packets_;
    past_wire_ += packets_.front().wire;
    past_host_ += packets_.front().host;
    packets_.pop_front();
  }
}

void EthernetLink::finish_frame() {
  std::vector<std::uint8_t> bytes;
  if (job_.values) {
    const auto end = bytes_.begin() + job_.bytes;
    bytes.assign(bytes_.begin(), end);
    bytes_.erase(bytes_.begin(), end);
  }
  job_.sent(bytes);
}

std::uint64_t EthernetLink::packets() const {
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  const auto begun = [&](const Packet& packet) { return clock_.time_of(packet.begin) <= now; };
  return past_packets_ + std::count_if(packets_.begin(), packets_.end(), begun);
}

Cycles EthernetLink::wire_busy() const { return past_wire_ + passed(&Packet::wire); }

Cycles EthernetLink::host_busy() const { return past_host_ + passed(&Packet::host); }

// What has passed until now of a time that each of packets_ takes.
Cycles EthernetLink::passed(Cycles Packet::*time) const {
  const Cycles now = clock_.now();
  Cycles sum;
  for (const Packet& packet : packets_) {
    sum += std::clamp(now - packet.begin, Cycles(0), packet.*time);
  }
  return sum;
}

}  // namespace parallax

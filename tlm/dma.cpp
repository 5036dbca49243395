// SPDX-License-Identifier: Apache-2.0
#include "tlm/dma.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace parallax {
namespace {

using Ends = std::deque<std::pair<std::uint64_t, std::function<void()>>>;

void finish(Ends& ends, std::uint64_t answered) {
  while (!ends.empty() && ends.front().first <= answered) {
    const auto done = std::move(ends.front().second);
    ends.pop_front();
    if (done) done();
  }
}

}  // namespace

std::uint64_t DmaJob::bytes() const {
  return std::accumulate(row_bytes.begin(), row_bytes.end(), std::uint64_t{0});
}

std::uint64_t burst_count(std::uint64_t bytes, Bytes burst) {
  const auto size = static_cast<std::uint64_t>(burst.count());
  return (bytes + size - 1) / size;
}

DmaReader::DmaReader(const sc_core::sc_module_name& name, const DmaEngineConfig& config,
                     const ClockDomain& clock)
    : sc_module(name),
      master("master", static_cast<std::size_t>(config.burst.count()), config.outstanding,
             [this](::tlm::tlm_generic_payload&) { arrived(); }),
      config_(config),
      clock_(clock) {
  SC_HAS_PROCESS(DmaReader);
  SC_THREAD(run);
}

void DmaReader::start(DmaJob job) {
  jobs_.push_back(std::move(job));
  started_.notify(sc_core::SC_ZERO_TIME);  // also before the simulation starts
}

void DmaReader::run() {
  const auto burst = static_cast<std::uint64_t>(config_.burst.count());
  Cycles next(0);
  for (;;) {
    while (jobs_.empty()) sc_core::wait(started_);
    job_ = std::move(jobs_.front());
    jobs_.pop_front();
    const std::uint64_t bytes = job_.bytes();
    ends_.emplace_back(requested_ + burst_count(bytes, config_.burst), job_.done);
    finish(ends_, answered_);  // a job without bytes
    std::size_t row = 0;
    std::uint64_t row_start = 0;
    for (std::uint64_t at = 0; at < bytes; at += burst) {
      const std::uint64_t size = std::min(burst, bytes - at);
      for (int i = 0; i < out_bursts.size(); ++i) out_bursts[i]->wait_writable(requested_ - answered_);
      master.wait_for_place();
      clock_.wait_until(std::max(next, clock_.now()));
      send_rows(row, row_start, at + size);
      ++requested_;
      next = clock_.now() + Cycles(1);
      master.send(master.pool().take(::tlm::TLM_READ_COMMAND, job_.address + at, size));
    }
  }
}

// Hands on the rows that begin before byte `until` of the job.
void DmaReader::send_rows(std::size_t& row, std::uint64_t& row_start, std::uint64_t until) {
  for (; row < job_.row_bytes.size() && row_start < until; row_start += job_.row_bytes[row++]) {
    if (!job_.values) continue;
    std::vector<std::uint8_t> bytes(job_.row_bytes[row]);
    master.read_now(job_.address + row_start, bytes.data(), bytes.size());
    // In the engine, not here: whole rows go through all the kernels, and a thread's stack is small.
    out_bursts[0]->dataflow().post(
        [this, row_values = std::move(bytes)] { out_bursts.send_row(row_values.data(), row_values.size()); });
  }
}

void DmaReader::arrived() {
  for (int i = 0; i < out_bursts.size(); ++i) out_bursts[i]->commit();
  finish(ends_, ++answered_);
}

DmaWriter::DmaWriter(const sc_core::sc_module_name& name, const DmaEngineConfig& config,
                     const ClockDomain& clock)
    : sc_module(name),
      master("master", static_cast<std::size_t>(config.burst.count()), config.outstanding,
             [this](::tlm::tlm_generic_payload&) { finish(ends_, ++answered_); }),
      config_(config),
      clock_(clock) {
  SC_HAS_PROCESS(DmaWriter);
  SC_THREAD(run);
  in_bursts.on_row(0, [this](const std::uint8_t* bytes, std::size_t size) {
    bytes_.insert(bytes_.end(), bytes, bytes + size);
  });
}

void DmaWriter::start(DmaJob job) {
  jobs_.push_back(std::move(job));
  started_.notify(sc_core::SC_ZERO_TIME);  // also before the simulation starts
}

void DmaWriter::run() {
  const auto burst = static_cast<std::uint64_t>(config_.burst.count());
  for (;;) {
    while (jobs_.empty()) sc_core::wait(started_);
    job_ = std::move(jobs_.front());
    jobs_.pop_front();
    const std::uint64_t bytes = job_.bytes();
    ends_.emplace_back(requested_ + burst_count(bytes, config_.burst), job_.done);
    finish(ends_, answered_);  // a job without bytes
    for (std::uint64_t at = 0; at < bytes; at += burst) {
      const std::uint64_t size = std::min(burst, bytes - at);
      in_bursts->wait_readable();
      master.wait_for_place();
      clock_.wait_until(clock_.now());
      ::tlm::tlm_generic_payload& payload =
          master.pool().take(::tlm::TLM_WRITE_COMMAND, job_.address + at, size);
      if (job_.values) {
        if (bytes_.size() < size) {
          SC_REPORT_ERROR("/parallax/dma/values",
                          (std::string(name()) + ": a burst is due before its bytes").c_str());
        }
        const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(size);
        std::copy(bytes_.begin(), end, payload.get_data_ptr());
        bytes_.erase(bytes_.begin(), end);
      }
      ++requested_;
      master.send(payload);
      in_bursts->release();
    }
  }
}

}  // namespace parallax

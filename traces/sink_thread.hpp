// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "traces/trace_sink.hpp"

namespace parallax {

/// Lets another sink work in a thread of its own, so that encoding and writing a trace go on beside the
/// simulation. Events are handed over in batches; when the sink falls behind by some of them, the simulation
/// waits, so that memory stays flat.
///
/// begin() and end() are called in the caller's thread, before the first event and after the last.
class SinkThread final : public TraceSink {
 public:
  /// `failed` is called, in the caller's thread and once, when the sink has thrown; later events are dropped.
  SinkThread(std::unique_ptr<TraceSink> sink, std::function<void()> failed);
  /// What the sink has not been told yet is dropped, unless end() has come.
  ~SinkThread() override;
  SinkThread(const SinkThread&) = delete;
  SinkThread& operator=(const SinkThread&) = delete;

  void begin(const TraceParts& parts) override;
  void row_begins(const RowBegin& row) override;
  void row(const StageRow& row) override;
  void fifo(const FifoSpan& span) override;
  void port_row(const PortRow& row) override;
  void frame_step(std::int64_t frame, FrameStep step, Picoseconds time) override;
  void frame(const FrameRecord& record) override;
  void firing(const StageFiring& firing) override;
  void token(const TokenTransfer& token) override;
  void requests(const PortRequests& requests) override;
  void burst(const BurstTransfer& burst) override;
  void known_until(Picoseconds date) override;
  /// Returns when the sink has been told all. Throws what the sink throws now; see check().
  void end(Picoseconds time, const std::vector<EndlessWait>& waits) override;

  /// Throws what the sink has thrown in its thread.
  void check();

 private:
  enum class Kind : unsigned char {
    kRowBegins,
    kRow,
    kFifo,
    kPortRow,
    kFrameStep,
    kFrame,
    kFiring,
    kToken,
    kRequests,
    kBurst,
    kKnownUntil
  };
  struct Step {
    std::int64_t frame;
    FrameStep step;
    Picoseconds time;
  };
  struct Batch {  // of events: the kind, then the event's bytes
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size = 0;
  };

  static constexpr std::size_t kBatch = 1 << 18;  // bytes
  static constexpr std::size_t kMostBatches = 4;  // that wait for the sink

  template <class Event>
  void push(Kind kind, const Event& event);
  void hand_over();
  void stop(bool drop);
  void work();
  void tell(const Batch& batch);
  template <class Event>
  static Event take(const std::byte*& at);

  const std::unique_ptr<TraceSink> sink_;
  const std::function<void()> on_failure_;
  Batch filling_;
  bool told_failure_ = false;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Batch> waiting_;
  std::vector<Batch> spare_;
  bool closed_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace parallax

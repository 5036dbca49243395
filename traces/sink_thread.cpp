// SPDX-License-Identifier: Apache-2.0
#include "traces/sink_thread.hpp"

#include <cstring>
#include <type_traits>
#include <utility>

namespace parallax {

SinkThread::SinkThread(std::unique_ptr<TraceSink> sink, std::function<void()> failed)
    : sink_(std::move(sink)), on_failure_(std::move(failed)) {}

SinkThread::~SinkThread() { stop(true); }

void SinkThread::begin(const TraceParts& parts) {
  sink_->begin(parts);
  filling_.bytes = std::make_unique<std::byte[]>(kBatch);
  thread_ = std::thread([this] { work(); });
}

template <class Event>
void SinkThread::push(Kind kind, const Event& event) {
  static_assert(std::is_trivially_copyable_v<Event>);
  if (filling_.size + 1 + sizeof event > kBatch) hand_over();
  std::byte* const at = filling_.bytes.get() + filling_.size;
  *at = static_cast<std::byte>(kind);
  std::memcpy(at + 1, &event, sizeof event);
  filling_.size += 1 + sizeof event;
}

void SinkThread::row_begins(const RowBegin& row) { push(Kind::kRowBegins, row); }
void SinkThread::row(const StageRow& row) { push(Kind::kRow, row); }
void SinkThread::fifo(const FifoSpan& span) { push(Kind::kFifo, span); }
void SinkThread::port_row(const PortRow& row) { push(Kind::kPortRow, row); }
void SinkThread::frame(const FrameRecord& record) { push(Kind::kFrame, record); }
void SinkThread::firing(const StageFiring& firing) { push(Kind::kFiring, firing); }
void SinkThread::token(const TokenTransfer& token) { push(Kind::kToken, token); }
void SinkThread::requests(const PortRequests& requests) { push(Kind::kRequests, requests); }
void SinkThread::burst(const BurstTransfer& burst) { push(Kind::kBurst, burst); }
void SinkThread::known_until(Picoseconds date) { push(Kind::kKnownUntil, date); }
void SinkThread::frame_step(std::int64_t frame, FrameStep step, Picoseconds time) {
  push(Kind::kFrameStep, Step{frame, step, time});
}

void SinkThread::hand_over() {
  bool failed = false;
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_.size() < kMostBatches || failure_; });
    failed = failure_ != nullptr;
    if (!failed) {
      waiting_.push_back(std::move(filling_));
      filling_ = {};
      if (!spare_.empty()) {
        filling_ = std::move(spare_.back());
        spare_.pop_back();
      }
    }
  }
  changed_.notify_all();
  filling_.size = 0;
  if (!filling_.bytes) filling_.bytes = std::make_unique<std::byte[]>(kBatch);
  if (failed && !std::exchange(told_failure_, true)) on_failure_();
}

void SinkThread::stop(bool drop) {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    if (drop) waiting_.clear();
    closed_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void SinkThread::end(Picoseconds time, const std::vector<EndlessWait>& waits) {
  hand_over();
  stop(false);
  check();
  sink_->end(time, waits);
}

void SinkThread::check() {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
}

void SinkThread::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return closed_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    Batch batch = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    changed_.notify_all();
    std::exception_ptr failure;
    try {
      tell(batch);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    spare_.push_back(std::move(batch));
    if (failure) {
      failure_ = failure;
      waiting_.clear();
      changed_.notify_all();
      return;
    }
  }
}

template <class Event>
Event SinkThread::take(const std::byte*& at) {
  Event event;
  std::memcpy(&event, at, sizeof event);
  at += sizeof event;
  return event;
}

void SinkThread::tell(const Batch& batch) {
  const std::byte* at = batch.bytes.get();
  for (const std::byte* const end = at + batch.size; at < end;) {
    switch (static_cast<Kind>(*at++)) {
      case Kind::kRowBegins:
        sink_->row_begins(take<RowBegin>(at));
        break;
      case Kind::kRow:
        sink_->row(take<StageRow>(at));
        break;
      case Kind::kFifo:
        sink_->fifo(take<FifoSpan>(at));
        break;
      case Kind::kPortRow:
        sink_->port_row(take<PortRow>(at));
        break;
      case Kind::kFrameStep: {
        const Step step = take<Step>(at);
        sink_->frame_step(step.frame, step.step, step.time);
        break;
      }
      case Kind::kFrame:
        sink_->frame(take<FrameRecord>(at));
        break;
      case Kind::kFiring:
        sink_->firing(take<StageFiring>(at));
        break;
      case Kind::kToken:
        sink_->token(take<TokenTransfer>(at));
        break;
      case Kind::kRequests:
        sink_->requests(take<PortRequests>(at));
        break;
      case Kind::kBurst:
        sink_->burst(take<BurstTransfer>(at));
        break;
      case Kind::kKnownUntil:
        sink_->known_until(take<Picoseconds>(at));
        break;
    }
  }
}

}  // namespace parallax

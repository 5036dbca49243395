// SPDX-License-Identifier: Apache-2.0
#include "tlm/dma.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace parallax {

std::uint64_t DmaJob::bytes() const {
  return std::accumulate(row_bytes.begin(), row_bytes.end(), std::uint64_t{0});
}

std::uint64_t DmaJob::piece_bytes() const {
  return pitch == 0 || row_bytes.empty() ? bytes() : row_bytes.front();
}

std::uint64_t burst_count(std::uint64_t bytes, Bytes burst) {
  const auto size = burst.size();
  return (bytes + size - 1) / size;
}

std::uint64_t DmaJob::bursts_until(std::uint64_t bytes, Bytes burst) const {
  const std::uint64_t piece = std::max<std::uint64_t>(1, piece_bytes());
  return bytes / piece * burst_count(piece, burst) + burst_count(bytes % piece, burst);
}

DmaEngine::DmaEngine(const sc_core::sc_module_name& name, const DmaEngineConfig& config,
                     const ClockDomain& clock)
    : sc_module(name),
      master("master", config.burst.size(), config.outstanding, *this),
      burst_(config.burst.size()),
      clock_(clock) {
  SC_HAS_PROCESS(DmaEngine);
  SC_METHOD(advance);
  sensitive << go_on_;
  dont_initialize();
}

void DmaEngine::start(DmaJob job) {
  jobs_.push_back(std::move(job));
  go_on_.notify(sc_core::SC_ZERO_TIME);  // also before the simulation starts
}

void DmaEngine::advance() {
  finish_jobs();
  advancing_ = true;
  while (have_burst() && master.ready()) {
    free_ = std::max(free_, clock_.cycle_at_or_after(master.credit_at()));
    if (!request_next()) break;
  }
  advancing_ = false;
}

// Whether a burst is left to be requested; takes the next job when one is done.
bool DmaEngine::have_burst() {
  while (at_ == bytes_) {
    if (jobs_.empty()) return false;
    job_ = std::move(jobs_.front());
    jobs_.pop_front();
    bytes_ = job_.bytes();
    at_ = 0;
    piece_ = job_.piece_bytes();
    piece_end_ = piece_;
    piece_address_ = job_.address;
    free_ = std::max(free_, clock_.now());
    for (DmaJob::Mark& mark : job_.marks) {
      ends_.push_back({requested_ + job_.bursts_until(std::min(mark.bytes, bytes_), Bytes(burst_)),
                       std::move(mark.reached), last_answer_});
    }
    const std::uint64_t last = requested_ + job_.bursts_until(bytes_, Bytes(burst_));
    ends_.push_back({last, std::move(job_.done), last_answer_});
    if (job_.progress) followed_.push_back({requested_ + 1, last, job_.progress});
    finish_jobs();  // it may be without bytes
    job_begins();
  }
  return true;
}

::tlm::tlm_generic_payload& DmaEngine::take_payload(::tlm::tlm_command command, bool values) {
  return master.pool().take(command, memory_address(), last_byte() - first_byte(), values);
}

void DmaEngine::request(::tlm::tlm_generic_payload& payload, Cycles cycle) {
  at_ = last_byte();
  if (at_ == piece_end_ && at_ < bytes_) {
    piece_address_ += job_.pitch - piece_;
    piece_end_ += piece_;
  }
  ++requested_;
  request_cycle_ = cycle;
  request_time_ = clock_.time_of(cycle);
  free_ = cycle + Cycles(1);
  master.send(payload, request_time_);
}

void DmaEngine::look_again(Cycles cycle) { go_on_.notify(clock_.time_of(cycle) - sc_core::sc_time_stamp()); }

void DmaEngine::taken(const sc_core::sc_time& time) {
  const Cycles cycle = time == request_time_ ? request_cycle_ : clock_.cycle_at_or_after(time);
  free_ = std::max(free_, cycle);
  request_taken(cycle);
  if (!advancing_) dataflow().wake(*this);
}

void DmaEngine::answered(const sc_core::sc_time& time, bool was_full) {
  const Cycles cycle = clock_.cycle_at_or_after(time);
  ++answered_;
  last_answer_ = std::max(last_answer_, time);
  burst_answered(cycle);
  if (!followed_.empty() && answered_ >= followed_.front().first) {
    const std::shared_ptr<TransferProgress> progress = followed_.front().progress;
    if (answered_ == followed_.front().last) followed_.pop_front();
    progress->answered(time);
  }
  for (End& end : ends_) {
    if (end.answers == answered_) end.time = last_answer_;
  }
  if (!ends_.empty() && ends_.front().answers <= answered_) finish_jobs();
  if (was_full) dataflow().wake(*this);
}

// Calls back for the jobs whose last answer is there, and when the next one will be.
void DmaEngine::finish_jobs() {
  const sc_core::sc_time& now = sc_core::sc_time_stamp();
  while (!ends_.empty() && ends_.front().answers <= answered_) {
    if (ends_.front().time > now) {
      go_on_.notify(ends_.front().time - now);
      return;
    }
    const auto done = std::move(ends_.front().done);
    ends_.pop_front();
    if (done) done();
  }
}

bool DmaReader::request_next() {
  bool known = true;
  Cycles room(0);
  int latest = 0;
  for (int i = 0; i < out_bursts.size(); ++i) {
    StreamBase& stream = *out_bursts[i];
    if (!stream.write_date_known(under_way())) {
      stream.wait_for_room();
      known = false;
    } else if (const Cycles date = stream.writable_at(under_way()); date > room) {
      room = date;
      latest = i;
    }
  }
  const std::optional<Cycles> behind = written();
  if (!known || !behind) return false;
  const Cycles ready = std::max(free(), *behind);
  blocked_.push_back({latest, std::max(Cycles(0), room - ready)});
  send_rows(last_byte());
  request(take_payload(::tlm::TLM_READ_COMMAND, job().values), std::max(ready, room));
  return true;
}

// When the bytes of the next burst are in memory, if that is known; values must be there now.
std::optional<Cycles> DmaReader::written() {
  if (!job().behind) return Cycles(0);
  const std::optional<sc_core::sc_time> date = job().behind->reached(job().needed(last_byte()));
  if (!date) {
    job().behind->wait(*this);
    return std::nullopt;
  }
  const Cycles cycle = cycle_at_or_after(*date);
  if (job().values && !has_come(cycle)) {
    look_again(cycle);
    return std::nullopt;
  }
  return cycle;
}

void DmaReader::job_begins() {
  row_ = 0;
  row_start_ = 0;
}

// Hands on the rows that begin before byte `until` of the job.
void DmaReader::send_rows(std::uint64_t until) {
  for (; row_ < job().row_bytes.size() && row_start_ < until; row_start_ += job().row_bytes[row_++]) {
    if (!job().values) continue;
    std::vector<std::uint8_t> bytes(job().row_bytes[row_]);
    const std::uint64_t address =
        job().downwards ? memory_address() : job().row_address(row_, row_start_);  // of a burst or a row
    master.read_now(address, bytes.data(), bytes.size());
    // In the engine, not here: it goes through all the kernels before any date of the row does.
    dataflow().post(
        [this, row_values = std::move(bytes)] { out_bursts.send_row(row_values.data(), row_values.size()); });
  }
}

void DmaReader::burst_answered(Cycles cycle) {
  last_write_ = std::max(cycle, last_write_ + Cycles(1));
  const Blocked blocked = blocked_.front();
  blocked_.pop_front();
  for (int i = 0; i < out_bursts.size(); ++i) {
    out_bursts[i]->mark_written(last_write_, i == blocked.stream ? blocked.cycles : Cycles(0));
  }
}

DmaWriter::DmaWriter(const sc_core::sc_module_name& name, const DmaEngineConfig& config,
                     const ClockDomain& clock)
    : DmaEngine(name, config, clock) {
  in_bursts.on_row(0, [this](const std::uint8_t* bytes, std::size_t size) { take_bytes(bytes, size); });
}

void DmaWriter::take_bytes(const std::uint8_t* bytes, std::size_t size) {
  bytes_.insert(bytes_.end(), bytes, bytes + size);
  for (; !late_.empty() && bytes_.size() >= late_.front().bytes; late_.pop_front()) {
    const auto end = bytes_.begin() + late_.front().bytes;
    std::vector<std::uint8_t> burst(bytes_.begin(), end);
    bytes_.erase(bytes_.begin(), end);
    master.write_now(late_.front().address, burst.data(), burst.size());
  }
}

bool DmaWriter::request_next() {
  if (!in_bursts->read_date_known()) {
    in_bursts->wait_for_token();
    return false;
  }
  const Cycles readable = in_bursts->readable_at();
  const Cycles cycle = std::max(free(), readable);
  const std::uint64_t size = last_byte() - first_byte();
  const bool have_bytes = late_.empty() && bytes_.size() >= size;
  if (job().values && !have_bytes) {
    if (!has_come(cycle)) {
      look_again(cycle);
      return false;
    }
    if (!job().late_values || last_byte() == job().bytes()) {
      SC_REPORT_ERROR("/parallax/dma/values",
                      (std::string(name()) + ": a burst is due before its bytes").c_str());
    }
    late_.push_back({memory_address(), size});
  }
  const bool carries = job().values && have_bytes;
  ::tlm::tlm_generic_payload& payload = take_payload(::tlm::TLM_WRITE_COMMAND, carries);
  if (carries) {
    const auto end = bytes_.begin() + size;
    std::copy(bytes_.begin(), end, payload.get_data_ptr());
    bytes_.erase(bytes_.begin(), end);
  }
  starved_ = std::max(Cycles(0), readable - free());
  request(payload, cycle);
  return true;
}

void DmaWriter::request_taken(Cycles cycle) {
  not_free_before(cycle + Cycles(1));  // a FIFO is read once a cycle
  in_bursts->mark_read(cycle, starved_);
}

}  // namespace parallax

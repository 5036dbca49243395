// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <systemc>
#include <utility>
#include <vector>

#include "tlm/ring.hpp"
#include "tlm/stream.hpp"
#include "tlm/token_run.hpp"

namespace parallax {

/// How a tap puts values and dates of a stream together.
struct TapConfig {
  std::size_t values_per_token = 1;  ///< >= 1
  /// Where values come in pieces of one size whose last token may be shorter (bursts of an image): values of
  /// a piece. 0: every token is full.
  std::size_t values_per_piece = 0;
  /// Where tokens are of several sizes otherwise: runs of tokens, over and over (those of a frame), in place
  /// of the two above.
  using Run = TokenRun;
  std::vector<Run> runs{};
  enum class Side { kWrites, kReads };
  Side side = Side::kWrites;  ///< whose dates
  /// Values come before their dates, as from all stages and DMA engines, so a date without a value has none,
  /// and tokens with none come after all that have some. Set where dates may come first and each has a value:
  /// behind a block in kernel time that writes value by value what stages take as rows. Dates then wait, at
  /// most those of a row.
  bool dates_wait = false;
};

/// A token of a tapped stream.
template <class T>
struct TappedToken {
  std::uint64_t number = 0;   ///< in the stream, from 0
  const T* values = nullptr;  ///< valid while the tap calls
  std::size_t size = 0;       ///< 0: the token has no value, as in runs for dates alone
  Cycles date;                ///< of the writing (reading) edge, in Tap::clock()
};

/// Where the values of a stream meet their dates: `take` is called for each token, in their order, as soon as
/// both are known, which may be ahead of kernel time, and after it where a leap is under way
/// (Dataflow::bring_up_to_date() hands over what is known). Any number of taps on any stream. A tap keeps
/// what is on its way: values until their dates come. Make it before the simulation starts; it must outlive
/// the simulation, or be stopped.
///
/// SC_REPORT_ERROR /parallax/stream/tap when a date finds a part of its token's values: the values are cut
/// otherwise than TapConfig says.
template <class T>
class Tap final : private StreamListener, private RowListener<T> {
 public:
  using Take = std::function<void(const TappedToken<T>& token)>;

  Tap(Stream<T>& stream, const TapConfig& config, Take take)
      : stream_(stream), config_(config), take_(std::move(take)), in_run_(config_.runs) {
    stream_.add_listener(*this);
    stream_.add_row_listener(*this);
  }
  Tap(const Tap&) = delete;
  Tap& operator=(const Tap&) = delete;

  /// Hands over what is known, and nothing after that; once.
  void stop() {
    stream_.remove_listener(*this);
    stream_.remove_row_listener(*this);
  }
  /// In whose cycles the dates are.
  const ClockDomain& clock() const {
    return config_.side == TapConfig::Side::kWrites ? stream_.writer_clock() : stream_.reader_clock();
  }
  const Stream<T>& stream() const { return stream_; }

 private:
  void row(const StreamBase&, const T* values, std::size_t size) override {
    if (first_ != 0 && values_.size() + size > values_.capacity()) {
      values_.erase(values_.begin(), values_.begin() + first_);
      first_ = 0;
    }
    values_.insert(values_.end(), values, values + size);
    for (; !dates_.empty() && available() >= token_size(); dates_.pop_front()) hand_over(dates_.front());
  }
  void written(const StreamBase&, Cycles cycle) override {
    if (config_.side == TapConfig::Side::kWrites) date_known(cycle);
  }
  void read(const StreamBase&, Cycles cycle) override {
    if (config_.side == TapConfig::Side::kReads) date_known(cycle);
  }

  void date_known(Cycles date) {
    if (config_.dates_wait && (!dates_.empty() || available() < token_size())) {
      dates_.push_back(date);
    } else {
      hand_over(date);
    }
  }
  void hand_over(Cycles date) {
    const std::size_t wanted = token_size();
    const std::size_t size = std::min(wanted, available());
    if (size != 0 && size != wanted) SC_REPORT_ERROR("/parallax/stream/tap", stream_.name());
    const TappedToken<T> token{number_++, size == 0 ? nullptr : values_.data() + first_, size, date};
    take_(token);
    first_ += size;
    if (first_ == values_.size()) {
      values_.clear();
      first_ = 0;
    }
    into_piece_ += wanted;
    if (into_piece_ == config_.values_per_piece) into_piece_ = 0;
    if (!config_.runs.empty()) in_run_.next();
  }

  std::size_t available() const { return values_.size() - first_; }
  // Values of the next token.
  std::size_t token_size() const {
    if (!config_.runs.empty()) return in_run_.size();
    if (config_.values_per_piece == 0) return config_.values_per_token;
    return std::min(config_.values_per_token, config_.values_per_piece - into_piece_);
  }

  Stream<T>& stream_;
  const TapConfig config_;
  const Take take_;
  std::uint64_t number_ = 0;
  std::size_t into_piece_ = 0;  // values of the piece that are handed over
  PlaceInRuns in_run_;          // of the next token
  std::vector<T> values_;       // whose dates are not known,
  std::size_t first_ = 0;       // from this one on
  Ring<Cycles> dates_;          // whose values are not known
};

}  // namespace parallax

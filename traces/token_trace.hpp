// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "tlm/stream_base.hpp"
#include "traces/date_queue.hpp"
#include "traces/row_ends.hpp"
#include "traces/trace_sink.hpp"
#include "traces/trace_window.hpp"

namespace parallax {

/// Tells sinks every token that passes a stream within a window, with the level of the FIFO. Tokens far
/// outside are counted only, however many.
class TokenTrace final : public StreamListener {
 public:
  /// `rows`: of the tokens; none when they belong to no row.
  TokenTrace(StreamBase& stream, PartId id, const std::shared_ptr<const RowEnds>& rows,
             const TraceWindow& window, const TraceSinks& sinks);

  /// Tells of the tokens before `date`, when all of them are known.
  void known_until(Picoseconds date);

 private:
  static constexpr Picoseconds kNever{std::numeric_limits<std::int64_t>::max()};
  struct Token {
    Picoseconds begin;
    Picoseconds end;
    TracePosition position;
  };
  struct TokenDate {
    Picoseconds operator()(const Token& token) const { return token.begin; }
  };
  class Side {
   public:
    Side(const ClockDomain& clock, const std::shared_ptr<const RowEnds>& rows, const TraceWindow& window,
         std::uint32_t depth);

    void pass(Cycles cycle);
    void pass_again(const std::vector<Cycles>& period, Cycles every, std::uint64_t times);
    Picoseconds next() const { return tokens_.empty() ? kNever : tokens_.date(); }
    const Token& front() const { return tokens_.front(); }
    void pop() { tokens_.pop(); }
    /// Counts the token of `date`, if there is one.
    bool take(Picoseconds date) {
      if (next() != date) return false;
      ++taken_;
      return true;
    }
    /// Tokens until the last one that was taken.
    std::uint64_t taken() const { return taken_; }

   private:
    void count(std::uint64_t tokens);

    static constexpr std::uint64_t kEver = std::numeric_limits<std::uint64_t>::max();

    const ClockDomain& clock_;
    std::optional<RowCursor> rows_;
    // Earlier tokens and those in earlier cycles are before all of the window, on the other side too; later
    // ones after.
    std::uint64_t first_token_ = 0, end_token_ = kEver;
    Cycles first_cycle_{0}, end_cycle_{std::numeric_limits<std::int64_t>::max()};
    Cycles last_cycle_{-1};
    Picoseconds last_end_;  // of that cycle
    std::uint64_t passed_ = 0;
    std::uint64_t taken_ = 0;
    DateQueue<Token, TokenDate> tokens_{TokenDate{}};
  };

  void written(const StreamBase&, Cycles cycle) override { writes_.pass(cycle); }
  void read(const StreamBase&, Cycles cycle) override { reads_.pass(cycle); }
  void written_again(const StreamBase&, const std::vector<Cycles>& period, Cycles every,
                     std::uint64_t times) override {
    writes_.pass_again(period, every, times);
  }
  void read_again(const StreamBase&, const std::vector<Cycles>& period, Cycles every,
                  std::uint64_t times) override {
    reads_.pass_again(period, every, times);
  }
  void notify(const Token& token, bool is_read) const;

  const PartId id_;
  const TraceWindow& window_;
  const TraceSinks& sinks_;
  Side writes_;
  Side reads_;
};

}  // namespace parallax

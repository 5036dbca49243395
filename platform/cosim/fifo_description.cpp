// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/fifo_description.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/cosim/fifo_grants.hpp"

namespace parallax {
namespace {

constexpr std::int64_t kMostEdges = 64;  // as the configuration takes them
// So many tokens must have been awaited, and slots: one alone, some description follows by chance.
constexpr std::size_t kLeastAwaited = 3;

// What one token or slot tells of an offset: it is `edges`, or at most that, or more than that.
struct OffsetBound {
  enum class Is { kExactly, kAtMost, kMore } is;
  std::int64_t edges;

  bool allows(std::int64_t offset) const {
    return is == Is::kExactly ? offset == edges : is == Is::kAtMost ? offset <= edges : offset > edges;
  }
};

class FifoSearch {
 public:
  explicit FifoSearch(const std::vector<FifoCapture>& captures) {
    for (const FifoCapture& capture : captures) grants_.emplace_back(capture);
  }

  FifoFinding find() {
    for (const FifoGrants& grants : grants_) {
      finding_.tokens += grants.write_dates.size();
      if (!grants.fault.empty())
        return none(grants, grants.fault, grants.fault_token, grants.fault_cycle, grants.fault_of_reader);
    }
    description_.two_clocks = grants_.front().two_clocks;
    if (!find_start() || !find_write_to_read() || !find_depth() || !is_seen_often()) return finding_;
    finding_.description = description_;
    return finding_;
  }

 private:
  FifoFinding none(const FifoGrants& grants, const std::string& reason, std::size_t token, std::int64_t cycle,
                   bool of_reader = true) {
    finding_.reason = reason;
    finding_.place = {grants.file, token, cycle, grants.fill(of_reader, cycle)};
    return finding_;
  }
  bool lacks(const std::string& reason) {
    finding_.reason = reason;
    finding_.needs_stalls = true;
    return false;
  }

  bool is_seen_often() {
    if (std::min(finding_.awaited, finding_.refused) >= kLeastAwaited) return true;
    return lacks(
        fmt::format("the reader awaited {} tokens of the empty FIFO, the writer {} slots of the full one: {} "
                    "are needed of "
                    "each; let both rest more often",
                    finding_.awaited, finding_.refused, kLeastAwaited));
  }

  bool find_start() {
    for (const FifoGrants& grants : grants_) {
      if (grants.two_clocks != description_.two_clocks) {
        finding_.reason =
            fmt::format("{} has {}, {} {}", grants.file, grants.two_clocks ? "two clocks" : "one clock",
                        grants_.front().file, description_.two_clocks ? "two" : "one");
        return false;
      }
      const std::optional<std::int64_t> first = grants.slots.front().first;
      if (!first) return lacks(fmt::format("{}: the FIFO never takes a token", grants.file));
      if (&grants == &grants_.front()) description_.not_ready_cycles = *first;
      if (description_.two_clocks) {  // it depends on how they stand to each other
        description_.not_ready_cycles = std::max(description_.not_ready_cycles, *first);
      } else if (*first != description_.not_ready_cycles) {
        none(grants,
             fmt::format("after reset it is not ready for {} cycles in {}, for {} in {}",
                         description_.not_ready_cycles, grants_.front().file, *first, grants.file),
             0, *first, false);
        return false;
      }
    }
    return true;
  }

  // What token `i` of a capture tells of the way to the reader.
  static OffsetBound bound_of(const FifoGrants& grants, std::size_t i) {
    const FifoGrants::Grant& token = grants.tokens[i];
    const std::int64_t written = grants.write_dates[i];
    return of(token, grants.to_reader(written, grants.last_read_cycle()),
              token.first ? grants.to_reader(written, *token.first) : 0);
  }

  bool find_write_to_read() {
    std::optional<std::int64_t> offset;
    std::size_t seen_at = 0;
    const auto each = [&](const auto& action) {
      for (const FifoGrants& grants : grants_) {
        for (std::size_t i = 0; i < std::min(grants.tokens.size(), grants.write_dates.size()); ++i) {
          if (!action(grants, i, bound_of(grants, i))) return false;
        }
      }
      return true;
    };
    each([&](const FifoGrants&, std::size_t i, const OffsetBound& bound) {
      if (bound.is != OffsetBound::Is::kExactly) return true;
      ++finding_.awaited;
      if (!offset) seen_at = i;
      offset = offset.value_or(bound.edges);
      return true;
    });
    const bool is_stuck = each(
        [](const FifoGrants& grants, std::size_t i, const OffsetBound&) { return !grants.tokens[i].first; });
    if (is_stuck && finding_.tokens > 0) {
      return lacks(fmt::format(
          "of {} tokens that were written none could ever be read: is the reset over (its polarity), or does "
          "the FIFO wait for an input that nothing drives, as the end of a packet",
          finding_.tokens));
    }
    if (!offset) {
      return lacks(
          "no token is ever awaited: the FIFO must run empty, so that it shows when the next token can be "
          "read; "
          "let the writer rest now and then");
    }
    const bool is_constant = each([&](const FifoGrants& grants, std::size_t i, const OffsetBound& bound) {
      if (bound.allows(*offset)) return true;
      none(grants,
           fmt::format(
               "how long a token takes to the reader is not constant: token {} can be read {} after it is "
               "written, token {} {}{}",
               seen_at, edges(*offset), i, bound.is == OffsetBound::Is::kMore ? "not even after " : "after ",
               edges(bound.edges)),
           i, grants.tokens[i].first.value_or(grants.last_read_cycle()));
      return false;
    });
    if (!is_constant) return false;
    if (*offset > kMostEdges) {
      finding_.reason = fmt::format("a token takes {} to the reader, {} are the most that a stream has",
                                    edges(*offset), kMostEdges);
      return false;
    }
    description_.write_to_read = *offset;
    return true;
  }

  static std::string edges(std::int64_t count) {
    return fmt::format("{} edge{}", count, count == 1 ? "" : "s");
  }

  static OffsetBound of(const FifoGrants::Grant& grant, std::int64_t until_end, std::int64_t until_first) {
    if (!grant.first) return {OffsetBound::Is::kMore, until_end};
    return {*grant.first > grant.since ? OffsetBound::Is::kExactly : OffsetBound::Is::kAtMost, until_first};
  }

  struct Candidate {
    std::int64_t depth, read_to_write;
  };
  struct Failure {
    const FifoGrants* grants = nullptr;
    std::size_t captures = 0;  // that held before
    std::size_t slot = 0;
    bool later_than(const Failure& other) const {
      return captures != other.captures ? captures > other.captures : slot > other.slot;
    }
  };

  // Whether slot `i` is written when a candidate says so.
  static bool holds(const FifoGrants& grants, std::size_t i, const Candidate& candidate) {
    const FifoGrants::Grant& slot = grants.slots[i];
    const auto token = static_cast<std::int64_t>(i) - candidate.depth;
    if (token < 0) return slot.first && (i == 0 || *slot.first == slot.since);
    const auto freeing = static_cast<std::size_t>(token);
    if (freeing >= grants.read_dates.size()) return !slot.first;
    const std::int64_t read = grants.read_dates[freeing];
    if (slot.first && !grants.was_read_by(freeing, *slot.first)) return false;
    return of(slot, grants.to_writer(read, grants.last_write_cycle()),
              slot.first ? grants.to_writer(read, *slot.first) : 0)
        .allows(candidate.read_to_write);
  }

  std::optional<Failure> failure(const Candidate& candidate) const {
    for (std::size_t g = 0; g < grants_.size(); ++g) {
      for (std::size_t i = 0; i < grants_[g].slots.size(); ++i) {
        if (!holds(grants_[g], i, candidate)) return Failure{&grants_[g], g, i};
      }
    }
    return std::nullopt;
  }

  // The first slot that was waited for leaves few possibilities: some token's reading has freed it.
  std::vector<Candidate> candidates() {
    std::vector<Candidate> all;
    for (const FifoGrants& grants : grants_) {
      for (std::size_t i = 1; i < grants.slots.size(); ++i) {
        const FifoGrants::Grant& slot = grants.slots[i];
        if (!slot.first || *slot.first == slot.since) continue;
        if (++finding_.refused > 1) continue;
        for (std::size_t k = std::min(i, grants.read_dates.size()); k-- > 0;) {
          if (!grants.was_read_by(k, *slot.first)) continue;
          const std::int64_t offset = grants.to_writer(grants.read_dates[k], *slot.first);
          if (offset > kMostEdges) break;
          all.push_back({static_cast<std::int64_t>(i - k), offset});
        }
      }
    }
    return all;
  }

  bool find_depth() {
    const std::vector<Candidate> all = candidates();
    if (finding_.refused == 0) {
      std::size_t most = 0;
      for (const FifoGrants& grants : grants_) most = std::max(most, grants.most_held());
      return lacks(fmt::format(
          "the FIFO is never seen to be full and to take a token again: its depth is at least {}; let the "
          "reader rest until the writer has to wait, and read again",
          most));
    }
    std::vector<Candidate> left;
    Failure last;
    Candidate longest{0, 0};
    for (const Candidate& candidate : all) {
      const std::optional<Failure> where = failure(candidate);
      if (!where) {
        left.push_back(candidate);
      } else if (last.grants == nullptr || where->later_than(last)) {
        last = *where;
        longest = candidate;
      }
    }
    if (left.empty()) return refuse(last, longest);
    if (left.size() > 1) {
      std::string text;
      for (const Candidate& candidate : left) {
        text += fmt::format("{}depth {} with {}", text.empty() ? "" : ", or ", candidate.depth,
                            edges(candidate.read_to_write));
      }
      return lacks(fmt::format(
          "depth and read_to_write cannot be told apart: {}; let the reader rest for {} cycles while "
          "the FIFO is full, then read one token and rest again",
          text, left.back().read_to_write + 1));
    }
    description_.depth = left.front().depth;
    description_.read_to_write = left.front().read_to_write;
    return true;
  }

  bool refuse(const Failure& last, const Candidate& longest) {
    if (last.grants == nullptr) {
      finding_.reason = fmt::format(
          "a slot is free more than {} after it was read, the most that a stream has", edges(kMostEdges));
      return false;
    }
    const FifoGrants::Grant& slot = last.grants->slots[last.slot];
    const std::string found = slot.first ? fmt::format("in cycle {}", *slot.first) : "no more";
    none(*last.grants,
         fmt::format("when a slot can be written again is not a constant time after a read: depth {} with {} "
                     "holds longest, up to "
                     "token {}, which can be written {}",
                     longest.depth, edges(longest.read_to_write), last.slot, found),
         last.slot, slot.first.value_or(last.grants->last_write_cycle()), false);
    return false;
  }

  std::vector<FifoGrants> grants_;
  FifoDescription description_;
  FifoFinding finding_;
};

}  // namespace

FifoKind FifoDescription::kind() const {
  if (two_clocks) return write_to_read >= 2 && read_to_write >= 2 ? FifoKind::kAsynchronous : FifoKind::kFree;
  for (const FifoKind kind : {FifoKind::kRegistered, FifoKind::kFirstWordFallThrough, FifoKind::kBlockRam}) {
    const FifoOffsets offsets = offsets_of(kind, {});
    if (offsets.write_to_read == write_to_read && offsets.read_to_write == read_to_write) return kind;
  }
  return FifoKind::kFree;
}

std::vector<std::pair<std::string, std::string>> FifoDescription::keys(const std::string& name) const {
  const std::string stream = "streams." + name + ".";
  std::vector<std::pair<std::string, std::string>> all{
      {stream + "kind", fmt::format("\"{}\"", name_of(kind()))}, {stream + "depth", std::to_string(depth)}};
  if (kind() == FifoKind::kFree || kind() == FifoKind::kAsynchronous) {
    all.emplace_back(stream + "write_to_read", std::to_string(write_to_read));
    all.emplace_back(stream + "read_to_write", std::to_string(read_to_write));
  }
  if (not_ready_cycles > 0) all.emplace_back(stream + "not_ready_cycles", std::to_string(not_ready_cycles));
  return all;
}

FifoFinding describe_fifo(const std::vector<FifoCapture>& captures) { return FifoSearch(captures).find(); }

}  // namespace parallax

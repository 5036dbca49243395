// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <systemc>
#include <utility>
#include <vector>

namespace parallax {

/// How long things took. Sum and largest are exact, the distribution to 1/64 of a value; its size does not
/// grow with the number of values.
class LatencyHistogram {
 public:
  void add(const sc_core::sc_time& latency) {
    const std::uint64_t value = latency.value();
    const std::size_t bin = bin_of(value);
    if (bin >= bins_.size()) bins_.resize(bin + 1);
    ++bins_[bin];
    ++count_;
    sum_ += latency;
    largest_ = std::max(largest_, latency);
  }
  LatencyHistogram& operator+=(const LatencyHistogram& other) {
    bins_.resize(std::max(bins_.size(), other.bins_.size()));
    for (std::size_t bin = 0; bin < other.bins_.size(); ++bin) bins_[bin] += other.bins_[bin];
    count_ += other.count_;
    sum_ += other.sum_;
    largest_ = std::max(largest_, other.largest_);
    return *this;
  }
  std::uint64_t count() const { return count_; }
  const sc_core::sc_time& sum() const { return sum_; }
  const sc_core::sc_time& largest() const { return largest_; }
  /// Zero without values.
  sc_core::sc_time mean() const { return count_ == 0 ? sum_ : sum_ / static_cast<double>(count_); }
  /// That `share` (0 to 1) of the values are at most this, which is up to 1/64 too large. Zero without
  /// values.
  sc_core::sc_time percentile(double share) const {
    const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
    std::uint64_t seen = 0;
    for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
      seen += bins_[bin];
      if (seen > 0 && seen >= wanted) {
        return std::min(largest_, sc_core::sc_time::from_value(last_of(bin)));
      }
    }
    return sc_core::SC_ZERO_TIME;
  }

  /// How many values lay in each bin that holds some, by the largest value that belongs into it.
  std::vector<std::pair<sc_core::sc_time, std::uint64_t>> counts() const {
    std::vector<std::pair<sc_core::sc_time, std::uint64_t>> all;
    for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
      if (bins_[bin] > 0) all.emplace_back(sc_core::sc_time::from_value(last_of(bin)), bins_[bin]);
    }
    return all;
  }

 private:
  static constexpr unsigned kBits =
      6;  // values below 2^kBits have a bin each, then so do as many parts an octave
  static constexpr std::uint64_t kParts = 1u << kBits;

  static std::size_t bin_of(std::uint64_t value) {
    if (value < kParts) return value;
    const unsigned shift = 63U - static_cast<unsigned>(__builtin_clzll(value)) - kBits;
    return shift * kParts + (value >> shift);
  }
  /// Largest value of a bin.
  static std::uint64_t last_of(std::size_t bin) {
    if (bin < kParts) return bin;
    const auto shift = static_cast<unsigned>(bin / kParts - 1);
    return ((bin - shift * kParts + 1) << shift) - 1;
  }

  std::vector<std::uint64_t> bins_;
  std::uint64_t count_ = 0;
  sc_core::sc_time sum_;
  sc_core::sc_time largest_;
};

}  // namespace parallax

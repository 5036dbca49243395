// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "traces/trace_sink.hpp"

namespace parallax {

/// Collects text for a file, so that it is written in large pieces.
class TextBuffer {
 public:
  explicit TextBuffer(ByteSink sink) : sink_(std::move(sink)) { text_.reserve(kSize + kRoom); }

  void add(std::string_view text) { text_.append(text); }
  void add(char c) { text_.push_back(c); }
  void add(std::int64_t number) {
    const fmt::format_int digits(number);
    text_.append(digits.data(), digits.size());
  }
  /// To be called between events.
  void write_if_full() {
    if (text_.size() >= kSize) write();
  }
  void write() {
    sink_(text_);
    text_.clear();
  }

 private:
  static constexpr std::size_t kSize = 1 << 16;
  static constexpr std::size_t kRoom = 1 << 12;  // for an event

  ByteSink sink_;
  std::string text_;
};

}  // namespace parallax

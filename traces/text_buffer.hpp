// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include "traces/trace_sink.hpp"

namespace parallax {

/// Appends to `at`, where there is room, and returns where that ends.
inline char* put(char* at, std::string_view text) {
  std::memcpy(at, text.data(), text.size());
  return at + text.size();
}
constexpr std::size_t kDigits = 20;  // of a number at most
inline char* put(char* at, std::int64_t number) {
  // Most numbers are counts, and most of these are small.
  if (number >= 0 && number < 10) {
    *at = static_cast<char>('0' + number);
    return at + 1;
  }
  return std::to_chars(at, at + kDigits, number).ptr;
}

/// Collects text, or other bytes, for a file, so that it is written in large pieces.
class TextBuffer {
 public:
  explicit TextBuffer(ByteSink sink) : sink_(std::move(sink)), text_(std::make_unique<char[]>(kSize)) {}

  void add(std::string_view text) {
    if (text.size() > kSize - size_) {
      write();
      if (text.size() > kSize) return sink_(text);
    }
    std::memcpy(text_.get() + size_, text.data(), text.size());
    size_ += text.size();
  }
  void add(char c) {
    if (size_ == kSize) write();
    text_[size_++] = c;
  }
  void add(std::int64_t number) { added_until(put(room(kDigits), number)); }
  /// For who writes bytes by himself: where `most` fit, and, when they are there, where they end.
  char* room(std::size_t most) {
    if (kSize - size_ < most) write();
    return text_.get() + size_;
  }
  void added_until(const char* end) { size_ = end - text_.get(); }
  void write() {
    if (size_ > 0) sink_({text_.get(), std::exchange(size_, 0)});
  }

 private:
  static constexpr std::size_t kSize = 1 << 16;

  ByteSink sink_;
  std::unique_ptr<char[]> text_;
  std::size_t size_ = 0;
};

}  // namespace parallax

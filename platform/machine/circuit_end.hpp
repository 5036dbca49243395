// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "modules/token_formats.hpp"
#include "platform/machine/token_shape.hpp"
#include "tlm/stream.hpp"
#include "tlm/token_run.hpp"

namespace parallax {

/// An end of a stream at a circuit: tokens as they lie on its wires, and their dates.
class CircuitEnd {
 public:
  virtual ~CircuitEnd() = default;

  const std::string& port() const { return port_; }
  bool is_input() const { return is_input_; }  ///< of the circuit
  const TokenShape& shape() const { return shape_; }
  StreamBase& stream() const { return stream_; }
  /// Of whoever stands at this end.
  virtual void attach(const std::string& module, Actor* actor) = 0;

  /// The bits of the next token to read, or nothing: the token has no value, as in frames without images, or
  /// none yet.
  virtual bool front(std::vector<std::uint64_t>& bits) = 0;
  /// It was read; `comes_late`: its value comes later, and is for nobody then.
  virtual void pop(bool comes_late) = 0;
  /// Hands over the next token that is written.
  virtual void send(const std::vector<std::uint64_t>& bits) = 0;
  /// What comes here from now on is lost.
  virtual void ignore() = 0;

 protected:
  CircuitEnd(std::string port, bool is_input, TokenShape shape, StreamBase& stream)
      : port_(std::move(port)), is_input_(is_input), shape_(std::move(shape)), stream_(stream) {}

 private:
  const std::string port_;
  const bool is_input_;
  const TokenShape shape_;
  StreamBase& stream_;
};

/// What stands in a slot with whatever ports are connected to it, in place of ports of its own: those called
/// "in_..." are inputs.
class CircuitEnds {
 public:
  virtual ~CircuitEnds() = default;
  virtual void add(std::unique_ptr<CircuitEnd> end) = 0;
};

/// Of a stream of values of type T, one field after the other onto the wires.
template <class T>
class ValueEnd final : public CircuitEnd {
 public:
  ValueEnd(const std::string& port, bool is_input, const TokenShape& of, Stream<T>& stream)
      : CircuitEnd(port, is_input, of, stream), values_stream_(stream), runs_(shape().runs) {
    if (!is_input) return;
    stream.on_row(0, [this](const T* row, std::size_t length) {
      const std::size_t read = std::min(late_, length);
      late_ -= read;
      values_.insert(values_.end(), row + read, row + length);
    });
  }

  void attach(const std::string& module, Actor* actor) override {
    if (is_input()) {
      values_stream_.attach_reader(module, actor);
    } else {
      values_stream_.attach_writer(module, actor);
    }
  }

  bool front(std::vector<std::uint64_t>& bits) override {
    const std::size_t size = token_size();
    if (values_.size() < size) return false;
    token_.assign(values_.begin(), values_.begin() + static_cast<std::ptrdiff_t>(size));
    pack_values(shape().format, token_.data(), size, bits);
    return true;
  }

  void pop(bool comes_late) override {
    const std::size_t size = std::min(token_size(), values_.size());
    if (comes_late) late_ += token_size() - size;
    values_.erase(values_.begin(), values_.begin() + static_cast<std::ptrdiff_t>(size));
    if (!shape().runs.empty()) runs_.next();
  }

  void send(const std::vector<std::uint64_t>& bits) override {
    token_.resize(token_size());
    unpack_values(shape().format, bits, token_.data(), token_.size());
    if (!shape().runs.empty()) runs_.next();
    values_stream_.send_row(token_.data(), token_.size());
  }

  void ignore() override {
    if (is_input()) values_stream_.on_row(0, [](const T*, std::size_t) {});
  }

 private:
  std::size_t token_size() const {
    return shape().runs.empty() ? shape().format.all().size() / kWiredFields<T> : runs_.size();
  }

  Stream<T>& values_stream_;
  PlaceInRuns runs_;
  std::deque<T> values_;  // that are not read
  std::size_t late_ = 0;  // values that were read before they came
  std::vector<T> token_;
};

}  // namespace parallax

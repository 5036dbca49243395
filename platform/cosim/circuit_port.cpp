// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_port.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace parallax {
namespace {

void set_if_there(const PinBits& pin, std::uint64_t value) {
  if (pin) pin.set(value);
}

}  // namespace

std::string CircuitPort::place(std::uint64_t token) const {
  return fmt::format("token {} of frame {}", token % stream.frame_tokens, token / stream.frame_tokens);
}

std::uint64_t CircuitPort::column(std::uint64_t token) const {
  const TokenShape& shape = stream.shape;
  return token % shape.row_tokens / shape.tokens_per_pixel * shape.pixels_per_token;
}

CircuitInput::CircuitInput(const CircuitPort& port, std::uint64_t seed)
    : port_(port),
      pass_tokens_(port.pass_tokens()),
      pass_flush_(port.pass_flush()),
      stalls_(port.options.stall, seed) {}

bool CircuitInput::offer(Cycles cycle, std::uint64_t paced) {
  const bool there = flush_ > 0 || (stream().read_date_known() && stream().readable_at() <= cycle);
  if (there && !offered_) offered_ = paced >= next_ && !stalls_.next();
  if (!offered_ || loaded_) return false;
  load();
  return true;
}

void CircuitInput::load() {
  loaded_ = true;
  const bool zeros = flush_ > 0;
  const TokenFormat& format = port_.stream.shape.format;
  comes_late_ = false;
  if (zeros || !port_.has_value(tokens_)) {
    bits_.assign((format.width().size() + 63) / 64, 0);
  } else if (!end_->front(bits_)) {
    comes_late_ = true;
    port_.model.words.read(tokens_, bits_);
  }
  const std::vector<PortPins::Data>& data = port_.pins.data;
  if (data.size() == 1) {
    data[0].pin.set(bits_);
  } else {
    FieldUnpacker fields(format, bits_);
    for (const PortPins::Data& each : data) each.pin.set(static_cast<std::uint64_t>(fields.next()));
  }
  const std::uint64_t token = tokens_ % pass_tokens_;
  const std::uint64_t row_tokens = port_.stream.shape.row_tokens;
  const bool rows = row_tokens > 0;
  set_if_there(port_.pins.first, !zeros && token == 0 ? 1 : 0);
  set_if_there(port_.pins.last, !zeros && rows && token % row_tokens == row_tokens - 1 ? 1 : 0);
  set_if_there(port_.pins.row, rows ? token / row_tokens : 0);
  if (port_.pins.column) port_.pins.column.set(rows ? port_.column(token) : token);
  set_if_there(port_.pins.group, token % port_.stream.shape.tokens_per_pixel);
}

bool CircuitInput::take(Cycles cycle, std::uint64_t paced, bool stands) {
  const PinBits& ready = port_.pins.ready;
  const bool wanted = !stands && (!ready || ready.any());
  if (!offered_) {
    if (ready && wanted) starved_ += Cycles(1);
    return false;
  }
  if (!wanted || !presented_) return false;
  offered_ = loaded_ = false;
  if (flush_ > 0) {
    --flush_;
  } else {
    end_->pop(comes_late_);
    stream().mark_read(cycle, starved_);
    starved_ = Cycles(0);
    if (++tokens_ % pass_tokens_ == 0) flush_ = pass_flush_;
  }
  const CircuitOptions& options = port_.options;
  std::uint64_t gap = port_.stream.shape.row_tokens > 0 && !in_row() ? options.row_gap : 0;
  if (position() == 0) gap = std::max(gap, options.frame_gap);
  gap_end_ = paced + 1 + gap;
  next_ = std::max(gap_end_, paced + options.interval);
  return true;
}

// Tokens of this pass that were taken, with the zeros behind them.
std::uint64_t CircuitInput::position() const {
  return flush_ > 0 ? pass_tokens_ + pass_flush_ - flush_ : tokens_ % pass_tokens_;
}

// Whether some of a row's tokens were taken, and not all; zeros are further rows.
bool CircuitInput::in_row() const {
  const std::uint64_t row_tokens = port_.stream.shape.row_tokens;
  return row_tokens > 0 ? position() % row_tokens != 0 : position() != 0;
}

bool CircuitInput::shows_none(std::uint64_t paced) const {
  const PortPins& pins = port_.pins;
  return !offered_ && ((pins.line_valid && !in_row()) || (pins.frame_valid && position() == 0) ||
                       (pins.valid && paced < gap_end_));
}

void CircuitInput::present(bool all) {
  presented_ = all;
  set_if_there(port_.pins.valid, all ? 1 : 0);
  set_if_there(port_.pins.line_valid, all || in_row() ? 1 : 0);
  set_if_there(port_.pins.frame_valid, all || position() != 0 ? 1 : 0);
}

std::string CircuitInput::wait() const {
  if (offered_ && !presented_) {
    return fmt::format("{} has {}, and waits for the token that comes with it", port_.stream.name,
                       port_.place(tokens_));
  }
  return fmt::format(
      offered_ ? "{} offers {}, and the circuit is not ready" : "{} has no token ({} comes next)",
      port_.stream.name, port_.place(tokens_));
}

CircuitOutput::CircuitOutput(const CircuitPort& port, std::uint64_t seed)
    : port_(port),
      pass_tokens_(port.pass_tokens()),
      stalls_(port.options.stall, seed),
      dump_{TokenWords(port.stream.shape.format.width().size()), {}},
      skip_(port.options.skip),
      framing_(port.stage, port.stream, port.pins) {
  dump_.words.reserve(port.model.words.size());
  dump_.cycles.reserve(port.model.cycles.size());
}

bool CircuitOutput::dates_known() const {
  return std::all_of(ends_.begin(), ends_.end(),
                     [](const CircuitEnd* end) { return end->stream().write_date_known(); });
}

void CircuitOutput::make_ready(Cycles cycle) {
  ready_ = !stalls_.next();
  for (const CircuitEnd* end : ends_) {
    const StreamBase& stream = end->stream();
    ready_ = ready_ && stream.write_date_known() && stream.writable_at() <= cycle;
  }
}

void CircuitOutput::present(bool all) {
  ready_ = all;
  set_if_there(port_.pins.ready, all ? 1 : 0);
}

// A token that is offered stays until it is taken.
void CircuitOutput::look(Cycles cycle, bool always) {
  const PortPins& pins = port_.pins;
  valid_ = pins.valid ? pins.valid.any() : always;
  if (!pins.ready || !pins.valid || !breach_.empty()) return;
  if (held_ && !valid_) {
    breach_ = fmt::format("{}: valid goes from 1 to 0 before token {} was taken, in cycle {}",
                          port_.stream.name, tokens_, cycle.count());
  }
  if (!valid_ || (!held_ && ready_)) return;
  read();
  const auto changed = [&](const std::string& what) {
    breach_ = fmt::format("{}: {} before token {} was taken, in cycle {}", port_.stream.name, what, tokens_,
                          cycle.count());
  };
  if (held_ && bits_ != before_) changed("the data change");
  for (const auto& [mark, before] :
       {std::pair{pins.first, &first_before_}, std::pair{pins.last, &last_before_}}) {
    const bool value = mark && mark.any();
    if (held_ && value != *before && breach_.empty()) changed(mark.name() + " changes");
    *before = value;
  }
  before_.swap(bits_);
}

void CircuitOutput::read() {
  const std::vector<PortPins::Data>& data = port_.pins.data;
  if (data.size() == 1) {
    data[0].pin.read(bits_);
    return;
  }
  FieldPacker fields(port_.stream.shape.format, bits_);
  for (const PortPins::Data& each : data) {
    each.pin.read(value_);
    const std::size_t width = each.field.width;
    const bool negative = width < 64 && each.field.is_signed && (value_[0] >> (width - 1) & 1u) != 0;
    fields.next(static_cast<std::int64_t>(negative ? value_[0] | ~std::uint64_t{0} << width : value_[0]));
  }
}

bool CircuitOutput::put(Cycles cycle, bool stands, std::uint64_t frames) {
  if (!valid_) return false;
  if (!ready_ || stands) {
    blocked_ += Cycles(1);
    held_ = port_.pins.ready && !ready_;
    return false;
  }
  held_ = false;
  if (frames > 0 && !owes(frames) && flushed_ < port_.pass_flush()) {
    ++flushed_;
    drop();
    return true;
  }
  if (skip_ > 0) {
    --skip_;
    return true;
  }
  if (!owes(frames) && breach_.empty()) {
    breach_ =
        frames == 0
            ? fmt::format("{}: a token before one has gone in, in cycle {}", port_.stream.name, cycle.count())
            : fmt::format("{}: a token more than the {} of frame {}, in cycle {}", port_.stream.name,
                          port_.stream.frame_tokens, frames - 1, cycle.count());
  }
  framing_.look(tokens_, cycle);
  read();
  const bool has_value = port_.has_value(tokens_);
  if (has_value) {
    dump_.words.append(bits_);
    dump_.cycles.push_back(cycle.count());
    if (!differs_) {
      differs_ = dump_.words.size() > port_.model.words.size() ||
                 !dump_.words.same(dump_.words.size() - 1, port_.model.words, dump_.words.size() - 1);
    }
    const std::optional<std::int64_t>& bound = port_.options.bound;
    if (bound && tokens_ < port_.model.cycles.size())
      late_ = late_ || cycle.count() - port_.model.cycles[tokens_] > *bound;
  }
  for (CircuitEnd* end : ends_) {
    if (has_value) end->send(bits_);
    end->stream().mark_written(cycle, blocked_);
  }
  blocked_ = Cycles(0);
  flushed_ = 0;
  if (++tokens_ % pass_tokens_ == 0) skip_ = port_.options.skip;
  return true;
}

std::uint64_t CircuitOutput::lost_by_skip() const {
  const std::uint64_t skip = port_.options.skip;
  const std::size_t expected = port_.model.words.size();
  if (port_.pass_flush() >= skip || dump_.words.size() >= expected) return 0;
  const std::uint64_t missing = expected - dump_.words.size();
  return missing % skip == 0 ? missing : 0;
}

std::string CircuitOutput::wait() const {
  const std::string what = port_.place(tokens_);
  if (valid_ && ready_)
    return fmt::format("at {} the circuit offers {}, and there is no edge", port_.stream.name, what);
  return fmt::format("at {} {} {}", port_.stream.name,
                     valid_ ? "there is no room for" : "the circuit does not offer", what);
}

}  // namespace parallax

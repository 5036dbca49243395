// SPDX-License-Identifier: Apache-2.0
#include "traces/trace_window.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr double kLongest = 1e18;  // ps: 11 days, within what the kernel counts

std::optional<std::int64_t> whole(const std::string& text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<Picoseconds> date(const std::string& text) {
  static constexpr std::array<std::pair<const char*, double>, 5> kUnits{
      {{"ps", 1}, {"ns", 1e3}, {"us", 1e6}, {"ms", 1e9}, {"s", 1e12}}};
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  const std::string unit(end, text.data() + text.size());
  for (const auto& [name, picoseconds] : kUnits) {
    if (unit != name) continue;
    if (!(value >= 0 && value * picoseconds <= kLongest)) return std::nullopt;
    return Picoseconds(std::llround(value * picoseconds));
  }
  return std::nullopt;
}

// Whether a position is before a bound that names one.
bool before(const TracePosition& position, const TraceBound& bound) {
  if (position.frame != bound.frame) return position.frame < bound.frame;
  return bound.row && position.row < *bound.row;
}

// What belongs to no frame is in no window of frames.
bool after(const TracePosition& position, const TraceBound& bound) {
  if (position.frame < 0) return true;
  if (position.frame != bound.frame) return position.frame > bound.frame;
  return bound.row && position.row > *bound.row;
}

void check_bound(const char* option, const TraceBound& bound, std::int64_t frames, std::int32_t rows) {
  if (bound.time) return;
  if (bound.frame >= frames) {
    throw UserError(fmt::format("{}: frame {} is outside the run, which simulates {} (--timing-frames)",
                                option, bound.frame + 1,
                                frames == 1 ? "frame 1 only" : fmt::format("frames 1 to {}", frames)));
  }
  if (bound.row && *bound.row >= rows) {
    throw UserError(
        fmt::format("{}: row {} is outside the image, whose rows are 0 to {}", option, *bound.row, rows - 1));
  }
}

}  // namespace

TraceBound read_trace_bound(const std::string& option, const std::string& text) {
  TraceBound bound;
  const std::size_t colon = text.find(':');
  if (const auto frame = whole(text.substr(0, colon)); frame && *frame >= 1) {
    bound.frame = *frame - 1;
    if (colon == std::string::npos) return bound;
    const auto row = whole(text.substr(colon + 1));
    if (row && *row >= 0 && *row < 1'000'000) {
      bound.row = static_cast<std::int32_t>(*row);
      return bound;
    }
  } else if (const auto time = date(text)) {
    bound.time = time;
    return bound;
  }
  throw UserError(
      fmt::format("{} {}: must be a frame (8, counted from 1), a row of a frame (8:120, rows counted from 0) "
                  "or a time (12.5ms; ps, ns, us, ms, s)",
                  option, text));
}

void TraceWindow::check(std::int64_t frames, std::int32_t rows) const {
  if (from) check_bound("--trace-from", *from, frames, rows);
  if (to) check_bound("--trace-to", *to, frames, rows);
  if (!from || !to || from->time.has_value() != to->time.has_value()) return;
  const bool empty = from->time ? *from->time >= *to->time
                                : from->frame > to->frame || (from->frame == to->frame &&
                                                              from->row.value_or(0) > to->row.value_or(rows));
  if (empty) throw UserError("--trace-to is before --trace-from");
}

bool TraceWindow::contains(const TracePosition& position, Picoseconds begin, Picoseconds end) const {
  const auto over_before = [&](Picoseconds time) { return begin == end ? begin < time : end <= time; };
  if (from && (from->time ? over_before(*from->time) : before(position, *from))) return false;
  return !to || (to->time ? begin < *to->time : !after(position, *to));
}

}  // namespace parallax

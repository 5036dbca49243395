// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/vcd_tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "platform/config/nearest_name.hpp"
#include "platform/cosim/signal_bits.hpp"
#include "platform/cosim/vcd_waves.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// Bits of a signal that lie beside each other.
struct SignalBits {
  const VcdWaves::Signal* signal = nullptr;  // null: there is none
  std::size_t low = 0;
  std::size_t width = 0;

  // Of the digits of a value of the signal, the highest first; missing ones are 0, or x and z go on.
  std::string of(const std::string& digits) const {
    if (width == signal->width || digits.empty()) return digits;
    const char above = digits[0] == '1' ? '0' : digits[0];
    std::string bits(width, above);
    for (std::size_t i = 0; i < width && low + i < digits.size(); ++i)
      bits[width - 1 - i] = digits[digits.size() - 1 - (low + i)];
    return bits;
  }
};

// The signals of a stream among the waves.
class StreamSignals {
 public:
  StreamSignals(const VcdWaves& waves, const std::string& path, const VectorStream& stream,
                const DumpSignals& wanted)
      : waves_(waves), path_(path), stream_(stream) {
    data = find("data", wanted.data, names("data"), true);
    valid = find("valid", wanted.valid, names("valid"), true);
    ready = find("ready", wanted.ready, names("ready"), false);
    clock = find("clock", wanted.clock, {"clk", "clock", "aclk"}, true);
  }

  SignalBits data, valid, ready, clock;

 private:
  std::vector<std::string> names(const std::string& what) const {
    std::vector<std::string> all;
    for (const char* const before : {"_", "_t"}) {
      all.push_back(stream_.port + before + what);
      all.push_back(stream_.name + before + what);
    }
    if (what == "data") {
      all.push_back(stream_.port);
      all.push_back(stream_.name);
    }
    return all;
  }

  SignalBits find(const char* what, const std::string& asked, std::vector<std::string> candidates,
                  bool needed) const {
    if (!asked.empty()) candidates = {asked};
    for (const std::string& name : candidates) {
      const auto bits = read_named_bits(name);
      if (!bits)
        throw UserError(fmt::format("--signals {}={}: a signal is NAME, NAME[BIT] or NAME[HIGH:LOW]", what,
                                    excerpt(name)));
      const VcdWaves::Signal* const found = waves_.find(bits->name);
      if (found == nullptr) continue;
      if (!bits->range) return {found, 0, found->width};
      const auto [high, low] = *bits->range;
      const std::size_t a = found->place(high), b = found->place(low);
      if (std::max(a, b) >= found->width) {
        throw UserError(fmt::format("{}: --signals {}={}: {} has the bits [{}:{}]", path_, what,
                                    excerpt(name), found->name, found->left, found->right));
      }
      return {found, std::min(a, b), std::max(a, b) - std::min(a, b) + 1};
    }
    if (!needed && asked.empty()) return {};
    std::vector<std::string> all;
    for (const VcdWaves::Signal& signal : waves_.signals()) all.push_back(signal.name);
    if (all.empty()) throw UserError(fmt::format("{}: no signals in this VCD", path_));
    throw UserError(fmt::format(
        "{}: no signal {} for {} of {}; the nearest is {}; --signals {}=NAME names another one", path_,
        candidates.front(), what, stream_.name, nearest_name(candidates.front(), all), what));
  }

  const VcdWaves& waves_;
  const std::string& path_;
  const VectorStream& stream_;
};

}  // namespace

Dump tokens_of_vcd(const std::string& text, const std::string& path, const VectorStream& stream,
                   const DumpSignals& wanted) {
  VcdWaves waves(text, path);
  const StreamSignals signals(waves, path, stream, wanted);
  const std::size_t width = stream.shape.format.width().size();
  SignalBits bits = signals.data;
  if (bits.width != width) {
    if (bits.width != bits.signal->width || !is_padded_tdata(bits.signal->name, bits.width, width)) {
      throw UserError(fmt::format("{}: {} has {} bits, {} has {}", path, bits.signal->name, bits.width,
                                  stream.name, width));
    }
    bits.width = width;
  }
  Dump dump{TokenWords(width), {}};
  std::vector<const VcdWaves::Signal*> watched{signals.clock.signal, signals.data.signal,
                                               signals.valid.signal};
  if (signals.ready.signal != nullptr) watched.push_back(signals.ready.signal);
  const bool has_ready = signals.ready.signal != nullptr;
  std::string data, valid, ready = has_ready ? "" : "1", clock;
  std::int64_t cycle = 0;
  std::uint64_t valid_cycles = 0, ready_cycles = 0;
  waves.read(watched, [&](std::int64_t, const VcdWaves::Changes& changes) {
    const std::string edge = changes[0] != nullptr ? signals.clock.of(*changes[0]) : clock;
    if (edge == "1" && clock == "0") {
      valid_cycles += valid == "1";
      ready_cycles += ready == "1";
      // Before the first token it may be in reset, or not have begun.
      const bool is_known = (valid == "0" || valid == "1") && (ready == "0" || ready == "1");
      if (!is_known && dump.words.size() > 0) {
        const bool is_ready = valid == "0" || valid == "1";
        throw waves.fault(fmt::format("{} is unknown in cycle {}",
                                      (is_ready ? signals.ready : signals.valid).signal->name, cycle));
      }
      if (valid == "1" && ready == "1") {
        if (const std::string wrong = dump.words.append_binary(data); !wrong.empty())
          throw waves.fault(wrong);
        dump.cycles.push_back(cycle);
      }
      ++cycle;
    }
    clock = edge;
    if (changes[1] != nullptr) data = bits.of(*changes[1]);
    if (changes[2] != nullptr) valid = signals.valid.of(*changes[2]);
    if (has_ready && changes[3] != nullptr) ready = signals.ready.of(*changes[3]);
  });
  if (dump.words.size() > 0) return dump;
  if (cycle == 0) {
    throw UserError(fmt::format("{}: {} never goes from 0 to 1; --signals clock=NAME names another clock",
                                path, signals.clock.signal->name));
  }
  throw UserError(
      fmt::format("{}: no token of {}: at {} edges of {}, {} was 1 at {}{}", path, stream.name, cycle,
                  signals.clock.signal->name, signals.valid.signal->name, valid_cycles,
                  has_ready ? fmt::format(", {} at {}", signals.ready.signal->name, ready_cycles) : ""));
}

}  // namespace parallax

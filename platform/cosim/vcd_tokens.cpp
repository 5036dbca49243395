// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/vcd_tokens.hpp"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "platform/config/nearest_name.hpp"
#include "platform/cosim/vcd_waves.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// The signals of a stream among the waves.
class StreamSignals {
 public:
  StreamSignals(const VcdWaves& waves, const std::string& path, const VectorStream& stream,
                const DumpSignals& wanted)
      : waves_(waves), path_(path), stream_(stream) {
    data = find("data", wanted.data, names("_data"), true);
    valid = find("valid", wanted.valid, names("_valid"), true);
    ready = find("ready", wanted.ready, names("_ready"), false);
    clock = find("clock", wanted.clock, {"clk", "clock", "aclk"}, true);
  }

  const VcdWaves::Signal* data = nullptr;
  const VcdWaves::Signal* valid = nullptr;
  const VcdWaves::Signal* ready = nullptr;  // null: there is none
  const VcdWaves::Signal* clock = nullptr;

 private:
  std::vector<std::string> names(const char* ending) const {
    std::vector<std::string> all{stream_.port + ending, stream_.name + ending};
    if (std::string_view(ending) == "_data") {
      all.push_back(stream_.port);
      all.push_back(stream_.name);
    }
    return all;
  }

  const VcdWaves::Signal* find(const char* what, const std::string& asked,
                               std::vector<std::string> candidates, bool needed) const {
    if (!asked.empty()) candidates = {asked};
    for (const std::string& name : candidates) {
      if (const VcdWaves::Signal* const found = waves_.find(name)) return found;
    }
    if (!needed && asked.empty()) return nullptr;
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
  if (signals.data->width != width) {
    throw UserError(fmt::format("{}: {} has {} bits, {} has {}", path, signals.data->name,
                                signals.data->width, stream.name, width));
  }
  Dump dump{TokenWords(width), {}};
  std::vector<const VcdWaves::Signal*> watched{signals.clock, signals.data, signals.valid};
  if (signals.ready != nullptr) watched.push_back(signals.ready);
  std::string data, valid, ready, clock;
  std::int64_t cycle = 0;
  waves.read(watched, [&](std::int64_t, const VcdWaves::Changes& changes) {
    const std::string* const edge = changes[0];
    if (edge != nullptr && *edge == "1" && clock == "0") {
      if (valid == "1" && (signals.ready == nullptr || ready == "1")) {
        if (const std::string wrong = dump.words.append_binary(data); !wrong.empty())
          throw waves.fault(wrong);
        dump.cycles.push_back(cycle);
      }
      ++cycle;
    }
    if (edge != nullptr) clock = *edge;
    if (changes[1] != nullptr) data = *changes[1];
    if (changes[2] != nullptr) valid = *changes[2];
    if (changes.size() > 3 && changes[3] != nullptr) ready = *changes[3];
  });
  return dump;
}

}  // namespace parallax

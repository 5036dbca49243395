// SPDX-License-Identifier: Apache-2.0
// Taps on every stream of the machine: each value that is sent meets its token's date, and none is left over.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>

#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"
#include "tlm/tap.hpp"

namespace parallax::test {
namespace machine_taps_test {

constexpr int kWidth = 67;
constexpr int kHeight = 24;
constexpr std::int64_t kFrames = 2;

/// Keeps what is sent over a stream beside what its tap tells.
class Watched {
 public:
  virtual ~Watched() = default;
  virtual std::string faults() const = 0;
};

template <class T>
class WatchedStream final : public Watched, private RowListener<T> {
 public:
  WatchedStream(Stream<T>& stream, const TapConfig& config, bool values)
      : values_(values), tap_(stream, config, [this](const TappedToken<T>& token) { take(token); }) {
    stream.add_row_listener(*this);
  }
  std::string faults() const override {
    std::string text;
    const StreamStatistics& statistics = tap_.stream().statistics();
    if (tokens_ != statistics.written) text += fmt::format("{} of {} tokens ", tokens_, statistics.written);
    if (values_ == sent_.empty()) text += fmt::format("{} values were sent ", sent_.size());
    if (told_.size() != sent_.size() || !std::equal(told_.begin(), told_.end(), sent_.begin(), same)) {
      text += fmt::format("{} values told, {} sent, or others ", told_.size(), sent_.size());
    }
    if (!in_order_) text += "tokens in disorder ";
    return text.empty() ? text : fmt::format("{}: {}\n", tap_.stream().basename(), text);
  }

 private:
  static bool same(const T& a, const T& b) {
    return std::equal(reinterpret_cast<const char*>(&a), reinterpret_cast<const char*>(&a + 1),
                      reinterpret_cast<const char*>(&b));
  }
  void row(const StreamBase&, const T* values, std::size_t size) override {
    sent_.insert(sent_.end(), values, values + size);
  }
  void take(const TappedToken<T>& token) {
    in_order_ = in_order_ && token.number == tokens_ && token.date > last_;
    ++tokens_;
    last_ = token.date;
    told_.insert(told_.end(), token.values, token.values + token.size);
  }

  const bool values_;
  std::vector<T> sent_, told_;
  std::uint64_t tokens_ = 0;
  Cycles last_{-1};
  bool in_order_ = true;
  Tap<T> tap_;
};

template <class T>
std::unique_ptr<Watched> watch_as(StreamBase& stream, const TapConfig& config, bool values) {
  auto* typed = dynamic_cast<Stream<T>*>(&stream);
  return typed == nullptr ? nullptr : std::make_unique<WatchedStream<T>>(*typed, config, values);
}

// Values of a token, where there are several.
TapConfig cut(const Machine& machine, const StreamBase& stream) {
  const MachineConfig& config = machine.config();
  const std::string name = stream.basename();
  const auto bytes = [](const DmaPortConfig& port) { return static_cast<std::size_t>(port.burst_bytes); };
  const std::size_t image = std::size_t{kWidth} * kHeight;
  const std::size_t output = OutputPacking::row_bytes(kWidth, config.link.output_left()) * kHeight;
  TapConfig tap;
  if (name.rfind("costs_", 0) == 0) {
    tap.values_per_token = static_cast<std::size_t>(config.matching.parallelism);
  } else if (name == "map_words") {
    tap.values_per_token = static_cast<std::size_t>(config.dma.map.data_bits / 8);
    tap.values_per_piece = machine.map().bytes.size();
  } else if (name == "map_bursts") {
    tap.values_per_token = bytes(config.dma.map);
    tap.values_per_piece = machine.map().bytes.size();
  } else if (name == "output_bursts" || name == "link_bursts") {
    tap.values_per_token = bytes(name == "link_bursts" ? config.dma.link : config.dma.output);
    tap.values_per_piece = output;
  } else if (name.find("left_bursts") != std::string::npos ||
             name.find("right_bursts") != std::string::npos) {
    tap.values_per_token = bytes(name.rfind("camera_", 0) == 0 ? config.dma.camera
                                 : name == "left_bursts"       ? config.dma.left
                                                               : config.dma.right);
    tap.values_per_piece = image;
  }
  return tap;
}

std::string faults(const std::vector<std::string>& assignments, bool images) {
  return in_child([&] {
    const MachineConfig config = preset(assignments);
    const EncodedMap map = encode(lens_map(kWidth, kHeight, config.rectification.range));
    MachineInput input;
    input.width = kWidth;
    input.height = kHeight;
    input.map = &map;
    input.frames = kFrames;
    input.timing_only = !images;
    input.expose = [images](std::int64_t frame) {
      if (!images || frame >= kFrames) return StereoFrame{};
      std::mt19937 random(static_cast<unsigned>(frame));
      const auto image = [&random] {
        auto pixels = std::make_shared<std::vector<Gray>>(std::size_t{kWidth} * kHeight);
        for (Gray& pixel : *pixels) pixel = static_cast<Gray>(random() % 256);
        return SensorImage(pixels);
      };
      const SensorImage left = image();
      return StereoFrame{left, image()};
    };
    input.deliver = [](const FrameResult&) {};
    const Machine machine("machine", config, input);
    std::vector<std::unique_ptr<Watched>> all;
    std::string text;
    for (StreamBase* stream : machine.dataflow().streams()) {
      const TapConfig tap = cut(machine, *stream);
      std::unique_ptr<Watched> watched;
      const auto attempt = [&](auto value) {
        if (!watched) watched = watch_as<decltype(value)>(*stream, tap, images);
      };
      attempt(std::uint8_t{});
      attempt(OffsetPair{});
      attempt(CensusCode{});
      attempt(Cost{});
      attempt(Disparity{});
      if (!watched) text += fmt::format("{}: a token of another type\n", stream->basename());
      all.push_back(std::move(watched));
    }
    sc_core::sc_start();
    if (!machine.finished()) return "stuck:\n" + describe(machine.dataflow().waits());
    for (const std::unique_ptr<Watched>& watched : all) {
      if (watched) text += watched->faults();
    }
    return text;
  });
}

TEST(MachineTaps, EveryValueMeetsItsDate) {
  EXPECT_EQ(faults({"rectification.window=9", "matching.parallelism=16"}, true), "");
}

TEST(MachineTaps, DatesComeWithoutValuesToo) { EXPECT_EQ(faults({"rectification.window=9"}, false), ""); }

}  // namespace machine_taps_test
}  // namespace parallax::test

// SPDX-License-Identifier: Apache-2.0
#include "modules/matching.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "modules/hamming_row.hpp"
#include "modules/path_costs.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr int kMaxDisparities = 256;
constexpr int kMaxPenalty = 255;
constexpr int kMaxCostWeight = 4;  // a weighted cost of 63 bits fits in a byte

int bits_for(int largest) {
  int bits = 1;
  while (largest >> bits) ++bits;
  return bits;
}

int path_count(unsigned paths) {
  int count = 0;
  for (; paths != 0; paths &= paths - 1) ++count;
  return count;
}

void check(const char* key, int value, int low, int high) {
  if (value < low || value > high) {
    throw UserError(fmt::format("matching.{} = {}: must be within {}..{}", key, value, low, high));
  }
}

std::size_t product(int a, int b) { return static_cast<std::size_t>(a) * static_cast<std::size_t>(b); }

/// The northern and horizontal paths of `paths` as delay lines; `turned`: the paths opposite to the southern
/// ones, for a frame that is read backwards.
std::vector<Path> make_paths(const MatchingConfig& config, int width, bool turned) {
  struct Entry {
    unsigned bit;
    Path::Direction direction;
  };
  const std::vector<Entry> first = {
      {kPathW, {-1, 0}}, {kPathNW, {-1, 1}}, {kPathN, {0, 1}}, {kPathNE, {1, 1}}};
  const std::vector<Entry> second = {{kPathSE, {-1, 1}}, {kPathS, {0, 1}}, {kPathSW, {1, 1}}};
  std::vector<Path> paths;
  for (const Entry& entry : turned ? second : first) {
    if (config.paths & entry.bit) paths.emplace_back(entry.direction, config, width);
  }
  return paths;
}

}  // namespace

void MatchingConfig::validate() const {
  check("parallelism", parallelism, 1, kMaxDisparities);
  check("iterations", iterations, 1, kMaxDisparities);
  check("disparity_offset", disparity_offset, 0, kMaxDisparities - 1);
  if (disparity_offset + iterations * parallelism > kMaxDisparities) {
    throw UserError(
        fmt::format("matching.disparity_offset + matching.iterations x matching.parallelism = {} + {} x {} = "
                    "{}: must be at most {}",
                    disparity_offset, iterations, parallelism, disparity_offset + iterations * parallelism,
                    kMaxDisparities));
  }
  check("recurrence_latency", recurrence_latency, 1, 1000);
  check("cost_weight", cost_weight, 1, kMaxCostWeight);
  check("p1", p1, 0, kMaxPenalty);
  check("p2", p2, 0, kMaxPenalty);
  if (p1 >= p2) throw UserError(fmt::format("matching.p1 = {}: must be below matching.p2 = {}", p1, p2));
  if (paths == 0 || paths > kEightPaths) {
    throw UserError(
        fmt::format("matching.paths = {:#x}: must name one to eight of w, nw, n, ne, e, sw, s, se", paths));
  }
}

struct Matching::State {
  State(const MatchingConfig& matching, int columns, int rows, int bits)
      : config(matching),
        width(columns),
        height(rows),
        count(matching.range().count),
        hamming(matching, columns, bits),
        first_pass(make_paths(matching, columns, false)),
        second_pass(make_paths(matching, columns, true)),
        costs(product(columns, count)),
        sums(product(columns, count)) {
    if (config.paths & kPathE) {
      MatchingConfig restarting = config;
      restarting.path_start = PathStart::kCost;
      east.emplace(Path::Direction{-1, 0}, restarting, width);
    }
    if (!second_pass.empty()) {
      left_codes.resize(product(width, height));
      right_codes.resize(product(width, height));
      frame_sums.resize(product(width, height) * static_cast<std::size_t>(count));
    }
  }

  void match(const CensusCode* left, const CensusCode* right, Cost* out) {
    hamming.compute(left, right, costs.data());
    std::fill_n(out, product(width, count), Cost{0});
    for (int x = 0; x < width; ++x) {
      for (Path& path : first_pass) path.advance(x, row, costs.data() + x * count, out + x * count);
    }
    if (!east) return;
    for (int i = 0; i < width; ++i) {
      const int x = width - 1 - i;
      east->advance(i, row, costs.data() + x * count, out + x * count);
    }
  }

  /// The southern paths: the frame turned by 180 degrees, added to the sums of the first pass.
  void sweep_back() {
    for (int i = 0; i < height; ++i) {
      const std::size_t first = product(height - 1 - i, width);
      hamming.compute(left_codes.data() + first, right_codes.data() + first, costs.data());
      for (int j = 0; j < width; ++j) {
        const int x = width - 1 - j;
        Cost* out = frame_sums.data() + first * static_cast<std::size_t>(count) + x * count;
        for (Path& path : second_pass) path.advance(j, i, costs.data() + x * count, out);
      }
    }
  }

  MatchingConfig config;
  int width;
  int height;
  int count;
  int row = 0;
  HammingRow hamming;
  std::vector<Path> first_pass;
  std::vector<Path> second_pass;
  std::optional<Path> east;  ///< runs through the row turned round
  std::vector<std::uint8_t> costs;
  std::vector<Cost> sums;

  // The frame store; empty without southern paths.
  std::vector<CensusCode> left_codes;
  std::vector<CensusCode> right_codes;
  std::vector<Cost> frame_sums;
};

Matching::Matching(const MatchingConfig& config, int width, int height, int code_bits)
    : config_(config), width_(width), height_(height), code_bits_(code_bits) {
  config.validate();
}

Matching::~Matching() = default;

void Matching::push(const CensusCode* left, const CensusCode* right, const RowSink<Cost>& emit) {
  if (state_ == nullptr) state_ = std::make_unique<State>(config_, width_, height_, code_bits_);
  State& s = *state_;
  const std::size_t first = product(s.row, s.width);
  if (one_pass()) {
    s.match(left, right, s.sums.data());
    emit(s.sums.data());
  } else {
    std::copy_n(left, s.width, s.left_codes.data() + first);
    std::copy_n(right, s.width, s.right_codes.data() + first);
    s.match(left, right, s.frame_sums.data() + first * static_cast<std::size_t>(s.count));
  }
  if (++s.row < s.height) return;
  s.row = 0;
  if (one_pass()) return;
  s.sweep_back();
  for (int y = 0; y < s.height; ++y)
    emit(s.frame_sums.data() + product(y, s.width) * static_cast<std::size_t>(s.count));
}

int Matching::cost_bits() const {
  return bits_for(path_count(config_.paths) * (largest_cost() + kMaxPenalty));
}

int Matching::look_ahead_rows() const { return one_pass() ? 0 : height_ - 1; }

// A second pass begins when the first one is over.
int Matching::look_ahead_pixels() const {
  if (!one_pass()) return width_;
  return config_.paths & kPathE ? width_ - 1 : 0;
}

std::int64_t Matching::path_pixel_bits() const {
  const int path_bits = bits_for(largest_cost() + kMaxPenalty);
  return std::int64_t{path_bits} * (config_.range().count + 1);  // with the minimum
}

std::int64_t Matching::storage_bits() const {
  const std::int64_t width = width_;
  const int count = config_.range().count;
  const auto in_row = [this](unsigned paths) { return path_count(config_.paths & paths); };
  std::int64_t pixels = path_count(config_.paths & (kPathW | kPathE));
  if (config_.path_storage == PathStorage::kOnChip) {
    // The second pass runs after the first one: both share the lines.
    pixels += width * std::max(in_row(kPathNW | kPathN | kPathNE), in_row(kSouthernPaths));
  } else {
    // What comes back for the pixel ahead waits until it is straight above, and then behind.
    pixels += std::max(in_row(kPathN) + 2 * in_row(kPathNW), in_row(kPathS) + 2 * in_row(kPathSE));
  }
  std::int64_t bits = path_pixel_bits() * pixels;
  bits += std::int64_t{code_bits_} * config_.range().last();
  if (config_.paths & kPathE) {
    bits += width * count * (bits_for(largest_cost()) + cost_bits());
  }
  return bits;
}

MatchingStore Matching::store() const {
  MatchingStore store;
  if (config_.path_storage == PathStorage::kMemory) {
    store.first_pass_row = path_pixel_bits() * path_count(config_.paths & (kPathNW | kPathN | kPathNE));
    store.second_pass_row = path_pixel_bits() * path_count(config_.paths & kSouthernPaths);
  }
  if (!one_pass()) {
    const int first_paths = path_count(config_.paths & ~kSouthernPaths);
    const int sum_bits = first_paths == 0 ? 0 : bits_for(first_paths * (largest_cost() + kMaxPenalty));
    store.frame = std::int64_t{config_.range().count} * sum_bits + 2 * code_bits_;
  }
  return store;
}

}  // namespace parallax

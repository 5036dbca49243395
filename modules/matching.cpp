// SPDX-License-Identifier: Apache-2.0
#include "modules/matching.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

#include "modules/area.hpp"
#include "modules/bit_packer.hpp"
#include "modules/cost_row.hpp"
#include "modules/path_costs.hpp"
#include "modules/token_formats.hpp"

namespace parallax {
namespace {

constexpr int kCodePiece = 32;  // bits of a code that are packed at once
const MatchingTaps kNoTaps;
constexpr int kRowLag = 2;  // columns that a row is behind the one above

// Of a single path, the place of its bit.
std::size_t path_number(unsigned path) {
  std::size_t number = 0;
  while (path >> number != 1) ++number;
  return number;
}

int path_count(unsigned paths) {
  int count = 0;
  for (; paths != 0; paths &= paths - 1) ++count;
  return count;
}

std::size_t count_of(const MatchingConfig& config) { return config.range().count; }

// A path cost at most, whatever the penalties.
int largest_path_cost(const MatchingConfig& config, int code_bits) {
  const int needed = config.largest_cost(code_bits) + MatchingConfig::kMaxPenalty;
  return config.path_bits == 0 ? needed : std::min(needed, (1 << config.path_bits) - 1);
}

// Of sums over some of the paths, and of those of the first pass if there is a second one.
int sum_bits(const MatchingConfig& config, int code_bits, unsigned paths) {
  return bits_for(path_count(paths) * largest_path_cost(config, code_bits));
}
int first_sum_bits(const MatchingConfig& config, int code_bits) {
  const unsigned paths = config.paths & ~kSouthernPaths;
  return paths == 0 ? 0 : sum_bits(config, code_bits, paths);
}

void shift_down(Cost* sums, std::size_t count, int shift) {
  if (shift == 0) return;
  for (std::size_t i = 0; i < count; ++i) sums[i] = static_cast<Cost>(sums[i] >> shift);
}

/// The northern and horizontal paths of `paths` as delay lines; `turned`: the paths opposite to the southern
/// ones, for a frame that is read backwards.
std::vector<Path> make_paths(const MatchingConfig& config, int width, bool turned, const MatchingTaps& taps) {
  std::vector<Path> paths;
  for (const PathBit bit :
       turned ? std::vector{kPathSE, kPathS, kPathSW} : std::vector{kPathW, kPathNW, kPathN, kPathNE}) {
    if ((config.paths & bit) != 0) paths.emplace_back(bit, config, width, taps.any());
  }
  return paths;
}

}  // namespace

struct Matching::State {
  State(const MatchingConfig& matching, int columns, int rows, int bits, const MatchingTaps& opened)
      : config(matching),
        taps(opened),
        tapped(opened.any()),
        width(columns),
        height(rows),
        code_bits(bits),
        count(matching.range().count),
        cost_row(matching, columns, bits),
        before(cost_row.reach()),
        first_pass(make_paths(matching, columns, false, opened)),
        second_pass(make_paths(matching, columns, true, opened)),
        costs(area(columns, count)),
        sums(area(columns, count)) {
    if (config.paths & kPathE) east.emplace(kPathE, config, width, tapped);
    if (!second_pass.empty()) {
      left_codes.resize(area(width, height));
      right_codes.resize(area(width, height));
      frame_sums.resize(area(width, height) * count);
    }
  }

  void match(const CensusCode* left, const CensusCode* right, Cost* out) {
    if (row == 0) std::fill(before.begin(), before.end(), CensusCode{0});
    cost_row.compute(left, right, before.data(), costs.data());
    remember(right);
    std::fill_n(out, area(width, count), Cost{0});
    for (int x = 0; x < width; ++x) {
      for (Path& path : first_pass) path.advance(x, row, costs.data() + x * count, out + x * count);
    }
    if (tapped) {
      if (taps.pixel_costs) taps.pixel_costs(std::vector<Cost>(costs.begin(), costs.end()).data());
      for (Path& path : first_pass) tap(path, row);
    }
    if (!east) return;
    for (int i = 0; i < width; ++i) {
      const int x = width - 1 - i;
      east->advance(i, row, costs.data() + x * count, out + x * count);
    }
    if (tapped) tap(*east, row);
  }

  /// Hands over row `y` of a path, pixels in raster order of its pass.
  void tap(Path& path, int y) const {
    const MatchingTaps::Take& take = taps.paths[path_number(path.bit())];
    if (!take) return;
    std::vector<Cost> path_costs;
    path_costs.reserve(area(width, count));
    for (int x = 0; x < width; ++x) {
      const PathCosts here = path.at(x, y);
      path_costs.insert(path_costs.end(), here.costs, here.costs + count);
    }
    take(path_costs.data());
  }

  /// Moves `before` on to the next row.
  void remember(const CensusCode* right) {
    const auto fresh = std::min(static_cast<std::ptrdiff_t>(before.size()), std::ptrdiff_t{width});
    std::move(before.begin() + fresh, before.end(), before.begin());
    std::copy_n(right + width - fresh, fresh, before.end() - fresh);
  }
  /// The same from the frame store, for the row that begins at pixel `first`.
  void recall(std::size_t first) {
    const std::size_t there = std::min(before.size(), first);
    std::fill(before.begin(), before.end(), CensusCode{0});
    std::copy_n(right_codes.begin() + (first - there), there, before.end() - there);
  }

  /// Hands over row `y` of the path costs that the next row needs, pixels in raster order of the pass.
  void keep_row(std::vector<Path>& pass, int y, const MatchingKeeper::Take& take) const {
    if (!take || y + 1 == height) return;
    const int bits = path_cost_bits(config, code_bits);
    BitPacker packer;
    for (int x = 0; x < width; ++x) {
      for (Path& path : pass) {
        if (!path.from_above()) continue;
        const PathCosts here = path.at(x, y);
        for (int k = 0; k < count; ++k) packer.field(here.costs[k], bits);
        packer.field(*here.minimum, bits);
      }
      packer.end_token();
    }
    const std::vector<std::uint8_t> records = packer.take();
    if (!records.empty()) take(records.data(), records.size());
  }

  /// Hands over what the second pass needs of the row at hand.
  void keep_frame_row(const MatchingKeeper::Take& take) const {
    if (!take) return;
    const int sum_bits = first_sum_bits(config, code_bits);
    BitPacker packer;
    for (std::size_t pixel = area(row, width); pixel < area(row + 1, width); ++pixel) {
      const Cost* pixel_sums = frame_sums.data() + pixel * count;
      for (int k = 0; k < count && sum_bits > 0; ++k) packer.field(pixel_sums[k], sum_bits);
      for (const CensusCode code : {left_codes[pixel], right_codes[pixel]}) {
        for (int low = 0; low < code_bits; low += kCodePiece) {
          const int bits = std::min(kCodePiece, code_bits - low);
          packer.field(code >> low & ((CensusCode{1} << bits) - 1), bits);
        }
      }
      packer.end_token();
    }
    const std::vector<std::uint8_t> records = packer.take();
    take(records.data(), records.size());
  }

  /// The southern paths: the frame turned by 180 degrees, added to the sums of the first pass.
  void sweep_back(const MatchingKeeper::Take& take) {
    for (int i = 0; i < height; ++i) {
      const std::size_t first = area(height - 1 - i, width);
      recall(first);
      cost_row.compute(left_codes.data() + first, right_codes.data() + first, before.data(), costs.data());
      for (int j = 0; j < width; ++j) {
        const int x = width - 1 - j;
        Cost* out = frame_sums.data() + first * count + x * count;
        for (Path& path : second_pass) path.advance(j, i, costs.data() + x * count, out);
      }
      if (tapped) {
        for (Path& path : second_pass) tap(path, i);
      }
      keep_row(second_pass, i, take);
    }
  }

  MatchingConfig config;
  const MatchingTaps& taps;
  bool tapped;  ///< some is open
  int width;
  int height;
  int code_bits;
  int count;
  int row = 0;
  CostRow cost_row;
  std::vector<CensusCode> before;  ///< right codes before the row, as far as the costs need them
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
    : config_(config), width_(width), height_(height), code_bits_(code_bits), taps_(&kNoTaps) {
  config.validate();
  if (config.cost == MatchingCost::kAbsoluteDifference && code_bits != kGrayBits) {
    throw std::logic_error("grey values have 8 bits");
  }
}

Matching::~Matching() = default;

void Matching::open(const MatchingTaps& taps) {
  if (state_ != nullptr) throw std::logic_error("taps are opened before the first row");
  taps_ = &taps;
}

void Matching::push(const CensusCode* left, const CensusCode* right, const RowSink<Cost>& emit,
                    const MatchingKeeper& keeper) {
  if (state_ == nullptr) state_ = std::make_unique<State>(config_, width_, height_, code_bits_, *taps_);
  State& s = *state_;
  const std::size_t first = area(s.row, s.width);
  if (one_pass()) {
    s.match(left, right, s.sums.data());
    shift_down(s.sums.data(), s.sums.size(), config_.sum_shift);
    emit(s.sums.data());
  } else {
    std::copy_n(left, s.width, s.left_codes.data() + first);
    std::copy_n(right, s.width, s.right_codes.data() + first);
    s.match(left, right, s.frame_sums.data() + first * s.count);
    s.keep_frame_row(keeper.frame);
  }
  s.keep_row(s.first_pass, s.row, keeper.row);
  if (++s.row < s.height) return;
  s.row = 0;
  if (one_pass()) return;
  s.sweep_back(keeper.row);
  shift_down(s.frame_sums.data(), s.frame_sums.size(), config_.sum_shift);
  for (int y = 0; y < s.height; ++y) emit(s.frame_sums.data() + area(y, s.width) * s.count);
}

int summed_cost_bits(const MatchingConfig& config, int code_bits) {
  return bits_for(path_count(config.paths) * largest_path_cost(config, code_bits) >> config.sum_shift);
}

int path_cost_bits(const MatchingConfig& config, int code_bits) {
  return config.path_bits == 0 ? bits_for(largest_path_cost(config, code_bits)) : config.path_bits;
}

int pixel_cost_bits(const MatchingConfig& config, int code_bits) {
  return bits_for(config.largest_cost(code_bits));
}

ScanOrder path_order(PathBit path) {
  if ((path & kSouthernPaths) != 0) return ScanOrder::kTurned;
  return path == kPathE ? ScanOrder::kRightToLeft : ScanOrder::kRaster;
}

// With parallel rows the last one of them has to come in before the first column is worked on, and its last
// pixel goes out as many rows after that of the first.
int Matching::look_ahead_rows() const { return one_pass() ? 2 * (config_.parallel_rows - 1) : height_ - 1; }

// A second pass begins when the first one is over.
int Matching::look_ahead_pixels() const {
  if (!one_pass()) return width_;
  return kRowLag * (config_.parallel_rows - 1) + (config_.paths & kPathE ? width_ - 1 : 0);
}

std::int64_t Matching::path_pixel_bits() const {
  return path_record_format(1, count_of(config_), path_cost_bits(config_, code_bits_)).width().count();
}

std::int64_t Matching::storage_bits() const {
  const std::int64_t width = width_;
  const int count = config_.range().count;
  const auto in_row = [this](unsigned paths) { return path_count(config_.paths & paths); };
  const std::int64_t at_once = config_.parallel_rows;
  std::int64_t pixels = at_once * path_count(config_.paths & (kPathW | kPathE));
  pixels += (at_once - 1) * kRowLag * std::max(in_row(kPathNW | kPathN | kPathNE), in_row(kSouthernPaths));
  if (config_.path_storage == PathStorage::kOnChip) {
    // The second pass runs after the first one: both share the lines.
    pixels += width * std::max(in_row(kPathNW | kPathN | kPathNE), in_row(kSouthernPaths));
  } else {
    // What comes back for the pixel ahead waits until it is straight above, and then behind.
    pixels += std::max(in_row(kPathN) + 2 * in_row(kPathNW), in_row(kPathS) + 2 * in_row(kPathSE));
  }
  std::int64_t bits = path_pixel_bits() * pixels;
  bits += at_once * code_bits_ * config_.range().last();
  bits += (at_once - 1) * width * (2 * code_bits_ + kDisparityBits);
  if (config_.paths & kPathE) {
    bits += at_once * width * count *
            (pixel_cost_bits(config_, code_bits_) + sum_bits(config_, code_bits_, config_.paths));
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
    store.frame = frame_record_format(count_of(config_), first_sum_bits(config_, code_bits_), code_bits_)
                      .width()
                      .count();
  }
  return store;
}

}  // namespace parallax

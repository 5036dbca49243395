// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "modules/matching_taps.hpp"
#include "modules/pixel.hpp"
#include "modules/row_sink.hpp"
#include "modules/scan_order.hpp"
#include "modules/winner.hpp"

namespace parallax {

/// Paths of semi-global matching, each named for where the predecessor lies. A set of paths is a sum of bits.
enum PathBit : unsigned {
  kPathW = 1U << 0,
  kPathNW = 1U << 1,
  kPathN = 1U << 2,
  kPathNE = 1U << 3,
  kPathE = 1U << 4,   ///< needs one row of costs held
  kPathSW = 1U << 5,  ///< the southern paths need a second pass over the frame, bottom up
  kPathS = 1U << 6,
  kPathSE = 1U << 7,
};
inline constexpr unsigned kFourPaths = kPathW | kPathNW | kPathN | kPathNE;
inline constexpr unsigned kSouthernPaths = kPathSW | kPathS | kPathSE;
inline constexpr unsigned kEightPaths = 0xFF;

/// What is compared of two pixels.
enum class MatchingCost {
  kHamming,             ///< census codes: the bits in which they differ, each `cost_weight`
  kAbsoluteDifference,  ///< grey values, 8 bit: their absolute difference, 0..255
};

/// Cost of comparing with a right pixel left of the image.
enum class OutsideCost {
  kMaximum,    ///< the largest there is: all bits differ, or 255
  kReplicate,  ///< as the leftmost right pixel of the row
  kZeroCode,   ///< as a right pixel with code (or grey value) 0
  kDelayLine,  ///< as the right pixel d positions before in raster order, at the end of a row above, as in a
               ///< circuit whose window of right pixels is a plain delay; 0 before the frame's first pixel
  kValue,      ///< `outside_value`
};

/// Predecessor of a pixel whose predecessor along the path is outside the image. Where there is none, L = C;
/// a predecessor whose costs are all equal (a cleared register, say) gives the same.
enum class PathStart {
  kCost,       ///< none
  kClamp,      ///< diagonal paths: the pixel straight above (below, for southern paths); others: none
  kCarry,      ///< path W: the last pixel of the row above, as in a circuit that never clears its register;
               ///< others: none
  kDelayLine,  ///< paths W, NW, N, NE: the pixel 1, W+1, W, W-1 positions before in raster order, wherever
               ///< that is (none before the frame's first pixel, or at distance 0), as in a circuit whose
               ///< line buffer is a plain delay; southern paths: the same in the image turned by 180 degrees;
               ///< E: none
  kFirstColumn,  ///< all paths start together, by one signal, in the first column, where no path has a
                 ///< predecessor, not even N and NE whose pixel is in the image; in all other columns as
                 ///< kDelayLine (before the frame's first pixel: cleared registers, as good as none);
                 ///< southern paths and E: the same in the image turned by 180 degrees, so in the last column
};

/// What becomes of a path cost that does not fit in `path_bits`.
enum class PathOverflow {
  kSaturate,  ///< the largest value that fits
  kWrap,      ///< its upper bits are lost
};

/// Where the path costs of the previous row lie, which the northern paths need, and in a second pass the
/// southern ones.
enum class PathStorage {
  kOnChip,
  kMemory,  ///< in external memory, written and read back row by row
};

/// When the minimum over all disparities of a pixel, m of L_r(q, .) below, is taken.
enum class RecurrenceOrder {
  kPlain,         ///< from the updated costs: all of them come before it
  kMinimumFirst,  ///< before the update: m' = min(min_k(t(k) + C(k)), min_k C(k) + m + P2), t without m
};

struct MatchingConfig {
  static constexpr int kMaxPenalty = 255;  ///< of p1 and p2

  /// Rows that the circuit works on at once, each p comparisons wide and two columns behind the row above, as
  /// path NE needs; 1..64. Of the stage's time and storage, not of its values; own choice.
  int parallel_rows = 1;
  int parallelism = 32;  ///< p, comparisons per iteration, 1..256; S (paper)
  int iterations = 4;  ///< n_i per pixel, 1..256; 4 for 128 disparities, 8 for 256 (D); offset + range <= 256
  int disparity_offset = 0;                    ///< o_d, px, 0..255; offset + range <= 256; S
  MatchingCost cost = MatchingCost::kHamming;  ///< I, as the census transform (CensusConfig)
  /// Weight of a differing census bit against p1 and p2, 1..4; not of grey values. Own choice: the device's
  /// penalties are known, the unit they count in is not.
  int cost_weight = 1;
  int p1 = 8;   ///< penalty for a change of one disparity, 0..255, p1 < p2; S (device default)
  int p2 = 42;  ///< penalty for a larger change, 0..255; S (device default)
  unsigned paths = kFourPaths;  ///< set of PathBit, at least one; I: one pass over the image
  /// Cycles until the minimum over all disparities of a pixel is there, which the next pixel needs; 1..1000.
  /// Plain: from the start of the pixel's last iteration until the next pixel's first one may start; with the
  /// minimum first, from the start of its first iteration. Of the stage's time, not of its values. 1 (D): the
  /// published rates leave room for no more.
  int recurrence_latency = 1;
  RecurrenceOrder recurrence_order = RecurrenceOrder::kPlain;  ///< not of the values; own choice
  PathStorage path_storage = PathStorage::kOnChip;  ///< of the stage's time, not of its values; own choice
  OutsideCost outside_cost =
      OutsideCost::kReplicate;  ///< own choice: fewest false matches at the left border
  int outside_value = 255;      ///< with OutsideCost::kValue, without a weight, 0..255; own choice
  PathStart path_start = PathStart::kCost;  ///< own choice
  /// Bits of a path cost, 1..16; 0: as many as it may need. 0: own choice.
  int path_bits = 0;
  PathOverflow path_overflow = PathOverflow::kSaturate;  ///< own choice
  int sum_shift = 0;  ///< bits that a sum of path costs is shifted down by, 0..11; own choice

  DisparityRange range() const { return {disparity_offset, iterations * parallelism}; }
  int weight() const { return cost == MatchingCost::kHamming ? cost_weight : 1; }
  /// Of two pixels of so many bits, wherever they lie; at most 255.
  int largest_cost(int code_bits) const;
  /// Of a token of so many pixels.
  CostGroups groups(int pixels) const {
    return {static_cast<std::uint32_t>(pixels * iterations / parallel_rows), parallel_rows};
  }
  /// Throws UserError unless tokens of so many pixels go through the circuit in whole groups of costs, and in
  /// whole columns of its parallel rows or the other way round; and for parallel rows whose paths go on over
  /// the ends of rows, or through the memory.
  void validate_tokens(int pixels) const;
  /// Throws UserError unless the cost is one of what comes in: census codes, or grey values.
  void validate_census(bool census) const;
  void validate() const;
};

/// What the matcher keeps in external memory, in bits a pixel; 0: nothing.
struct MatchingStore {
  std::int64_t first_pass_row = 0;   ///< path costs with their minima, for the row below
  std::int64_t second_pass_row = 0;  ///< the same of the southern paths, for the row above
  std::int64_t frame = 0;  ///< sums of the first pass and both images' codes, from one pass to the other
};

/// Takes what the matcher keeps outside, as it goes through its schedule: a row at a time, of whole records
/// (token_formats.hpp), a record a pixel. What has no taker is not packed.
struct MatchingKeeper {
  using Take = std::function<void(const std::uint8_t* records, std::size_t bytes)>;
  Take row;    ///< path costs of a row with their minima; of all rows of a pass but the last
  Take frame;  ///< sums of the first pass and codes of a row
};

/// Bits of an output value, whatever the penalties are: they are set while the circuit runs.
int summed_cost_bits(const MatchingConfig& config, int code_bits);
/// Bits of a path cost, likewise, and of a matching cost C.
int path_cost_bits(const MatchingConfig& config, int code_bits);
int pixel_cost_bits(const MatchingConfig& config, int code_bits);

/// In which order the circuit comes by the costs of a path, and MatchingTaps: the northern ones and w in
/// raster order, e from right to left, the southern ones turned, in the second pass.
ScanOrder path_order(PathBit path);

/// Semi-global matching: census codes or grey values of a rectified pair to summed path costs.
///
/// With D = range().count and d = o_d + k, k = 0..D-1:
///   C(x, y, k)   = cost_weight * number of bits in which left(x, y) and right(x - d, y) differ, or (without
///                  a weight) |left(x, y) - right(x - d, y)| (MatchingCost); OutsideCost when x - d < 0.
///   L_r(p, k)    = C(p, k) + min(L_r(q, k), L_r(q, k-1) + P1, L_r(q, k+1) + P1, m + P2) - m,
///                  q = predecessor of p along path r, m = min_k L_r(q, k), terms with k-1 < 0 or k+1 >= D
///                  left out; L_r(p, k) = C(p, k) where p has no predecessor (PathStart). With b = path_bits
///                  > 0 the result is brought to b bits (PathOverflow): min(L_r, 2^b - 1) or L_r mod 2^b goes
///                  into the sum, and into m and the terms of the next pixel, which are added without loss.
///   output(p, k) = floor(sum over the paths of L_r(p, k) / 2^sum_shift).
/// L_r <= largest C + P2 <= 510, so that the sum of eight paths fits in 12 bits.
///
/// Without southern paths nothing larger than some rows is held, from the first row on. With them the
/// hardware writes the sums of the first pass and both images' codes to memory (`store`) and reads them back
/// bottom up; this kernel holds the same frame store, and emits the whole frame, top to
/// bottom, with the last row.
class Matching {
 public:
  /// `code_bits` (1..63): meaningful bits of a code; 8 of a grey value.
  Matching(const MatchingConfig& config, int width, int height, int code_bits);
  ~Matching();

  /// Before the first row. `taps` must outlive the kernel.
  void open(const MatchingTaps& taps);

  /// One row of `width` codes or grey values of each image; emits rows of width * range().count costs.
  void push(const CensusCode* left, const CensusCode* right, const RowSink<Cost>& emit,
            const MatchingKeeper& keeper = {});

  int look_ahead_rows() const;
  int look_ahead_pixels() const;

  /// Path costs of one row per northern path, with their minima (of at most two pixels where rows lie in
  /// external memory); of one pixel for the horizontal path; the window of right codes; for path E, a row of
  /// costs and of sums. With parallel rows what belongs to a pixel or a window is there for each; the path
  /// costs of two columns lie between two rows; and the codes that wait for their row's turn are held, as are
  /// the disparities until the rows above are out, each of all rows but one.
  std::int64_t storage_bits() const;

  MatchingStore store() const;

 private:
  struct State;

  std::int64_t path_pixel_bits() const;  // of one path
  bool one_pass() const { return (config_.paths & kSouthernPaths) == 0; }

  MatchingConfig config_;
  int width_;
  int height_;
  int code_bits_;
  const MatchingTaps* taps_;
  std::unique_ptr<State>
      state_;  // made with the first row: a machine of which only the time is asked has none
};

}  // namespace parallax

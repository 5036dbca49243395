// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tlm/error.hpp"

namespace parallax {

/// The waves of a simulation: a value change dump (IEEE 1800, clause 21.7).
class VcdWaves {
 public:
  struct Signal {
    std::string name;  ///< with its scopes, "bench.dut.out_left_data"
    /// Of the whole of it, or, where the simulator wrote it bit by bit, of each bit, the highest first.
    std::vector<std::string> ids;
    std::size_t width = 0;  ///< bits
    /// The index of the highest and of the lowest bit, as declared: [15:0], [0:15]; 0 of a signal of one bit.
    std::size_t left = 0;
    std::size_t right = 0;
    /// How far above the lowest bit the one of this index lies; below `width` if there is one.
    std::size_t place(std::size_t index) const { return left >= right ? index - right : right - index; }
  };
  /// Of each signal that is watched the value it changes to, as binary digits; null where it does not change.
  using Changes = std::vector<const std::string*>;

  /// Reads the declarations. Both must outlive it. Throws UserError, with file and line, when they are
  /// damaged.
  VcdWaves(const std::string& text, const std::string& path);

  const std::vector<Signal>& signals() const { return signals_; }
  /// The signal of this name, which may lack the outer scopes; of several the outermost one. Null when there
  /// is none. Throws UserError when there are others as deep.
  const Signal* find(const std::string& name) const;

  /// Goes through what the dates change, once. What one date changes is there after it: an edge of a clock
  /// sees what was there before. `time` is in units of the dump. Throws UserError when the text is damaged.
  void read(const std::vector<const Signal*>& watched,
            const std::function<void(std::int64_t time, const Changes& changes)>& at_date);

  /// With the file and the line that is being read.
  UserError fault(const std::string& what) const;

 private:
  std::string_view next();  // word; empty at the end
  void skip_to_end();
  void read_head();
  void read_variable(const std::vector<std::string>& scopes);
  void join_bits();
  std::int64_t time_of(std::string_view word) const;

  std::string_view text_;
  const std::string& path_;
  std::size_t at_ = 0;
  std::vector<Signal> signals_;
};

}  // namespace parallax

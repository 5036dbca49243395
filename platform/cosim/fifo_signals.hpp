// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace parallax {

/// Which signals of a simulation, or ports of a module, are those of a FIFO. Empty: not said.
struct FifoSignals {
  std::string write_valid, write_ready;  ///< a token is written where both are 1
  std::string full;                      ///< in place of write_ready: 0 where that is 1
  std::string read_valid, read_ready;    ///< a token is read where both are 1
  std::string empty;                     ///< in place of read_valid: 0 where that is 1
  std::string clock;                     ///< of both sides
  std::string write_clock, read_clock;   ///< in place of it
  std::string reset, reset_n;            ///< 1, or 0, in reset; at most one of them

  struct Role {
    const char* name;  ///< as --signals has it
    std::string FifoSignals::*signal;
    std::vector<std::string> usual;  ///< names by which it is looked for, the likeliest first
  };
  static const std::vector<Role>& roles();

  /// From "write_valid=s_axis_tvalid", "clock=clk" and so on. Throws UserError, naming `option`, at what is
  /// no role or has no name, and where two say the same.
  static FifoSignals from(const std::vector<std::string>& words, const char* option);
};

}  // namespace parallax

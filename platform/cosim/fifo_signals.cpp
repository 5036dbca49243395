// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/fifo_signals.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tlm/error.hpp"

namespace parallax {

const std::vector<FifoSignals::Role>& FifoSignals::roles() {
  static const std::vector<Role> all{
      {"write_valid",
       &FifoSignals::write_valid,
       {"write_valid", "s_axis_tvalid", "in_valid", "wr_valid", "wr_en"}},
      {"write_ready", &FifoSignals::write_ready, {"write_ready", "s_axis_tready", "in_ready", "wr_ready"}},
      {"full", &FifoSignals::full, {"full", "wr_full"}},
      {"read_valid", &FifoSignals::read_valid, {"read_valid", "m_axis_tvalid", "out_valid", "rd_valid"}},
      {"read_ready",
       &FifoSignals::read_ready,
       {"read_ready", "m_axis_tready", "out_ready", "rd_ready", "rd_en"}},
      {"empty", &FifoSignals::empty, {"empty", "rd_empty"}},
      {"clock", &FifoSignals::clock, {"clk", "clock", "aclk"}},
      {"write_clock",
       &FifoSignals::write_clock,
       {"write_clk", "s_axis_aclk", "s_axis_clk", "s_clk", "in_clk", "wr_clk"}},
      {"read_clock",
       &FifoSignals::read_clock,
       {"read_clk", "m_axis_aclk", "m_axis_clk", "m_clk", "out_clk", "rd_clk"}},
      {"reset", &FifoSignals::reset, {"rst", "reset", "srst", "areset"}},
      {"reset_n", &FifoSignals::reset_n, {"rst_n", "reset_n", "resetn", "aresetn", "s_axis_aresetn"}}};
  return all;
}

FifoSignals FifoSignals::from(const std::vector<std::string>& words, const char* option) {
  FifoSignals signals;
  for (const std::string& word : words) {
    const std::size_t equals = std::min(word.find('='), word.size());
    const auto role = std::find_if(roles().begin(), roles().end(),
                                   [&](const Role& each) { return each.name == word.substr(0, equals); });
    if (role == roles().end() || equals + 1 >= word.size()) {
      std::vector<std::string> names;
      for (const Role& each : roles()) names.emplace_back(each.name);
      throw UserError(fmt::format("{}: '{}' is not ROLE=NAME with one of the roles {}", option, excerpt(word),
                                  fmt::join(names, ", ")));
    }
    signals.*role->signal = word.substr(equals + 1);
  }
  const auto exclude = [&](const std::string& one, const std::string& other, const char* names) {
    if (!one.empty() && !other.empty())
      throw UserError(fmt::format("{}: {} say the same, give one", option, names));
  };
  exclude(signals.write_ready, signals.full, "write_ready and full");
  exclude(signals.read_valid, signals.empty, "read_valid and empty");
  exclude(signals.reset, signals.reset_n, "reset and reset_n");
  exclude(signals.clock, signals.write_clock + signals.read_clock, "clock, and write_clock and read_clock,");
  if (signals.write_clock.empty() != signals.read_clock.empty()) {
    throw UserError(fmt::format(
        "{}: of write_clock and read_clock one is missing; a FIFO with one clock has clock=NAME", option));
  }
  return signals;
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/pin_names.hpp"

namespace parallax {

const std::map<std::string, PinNames>& pin_endings() {
  static const std::map<std::string, PinNames> all{
      {"data", {"data", "tdata", ""}},
      {"valid", {"valid", "tvalid", "vld", "en"}},
      {"ready", {"ready", "tready", "rdy"}},
      {"first", {"first", "sof", "tuser", "user"}},
      {"last", {"last", "eol", "tlast"}},
      {"keep", {"keep", "tkeep", "tstrb"}},
      {"row", {"row", "y"}},
      {"column", {"column", "col", "x"}},
      {"line_valid", {"line_valid", "lval", "href"}},
      {"frame_valid", {"frame_valid", "fval"}},
      {"group", {"group", "iteration"}},
  };
  return all;
}

const PinNames& clock_names() {
  static const PinNames all{"clk", "clock", "aclk", "clk_i", "i_clk", "ap_clk", "sysclk"};
  return all;
}

const PinNames& reset_names() {
  static const PinNames all{"rst", "reset", "rst_i", "i_rst", "reset_i", "areset", "ap_rst", "arst"};
  return all;
}

const PinNames& low_reset_names() {
  static const PinNames all{"rst_n", "reset_n", "rstn",   "resetn",  "aresetn", "rst_ni",
                            "nrst",  "nreset",  "arst_n", "i_rst_n", "ap_rst_n"};
  return all;
}

const PinNames& enable_names() {
  static const PinNames all{"ce", "clken", "clk_en", "clock_enable", "aclken", "en", "enable", "clk_ena"};
  return all;
}

const SharedNames& shared_names(const std::string& role) {
  static const std::map<std::string, SharedNames> all{
      {"valid",
       {{"in_valid", "valid_in", "i_valid", "valid_i", "s_axis_tvalid", "din_valid", "de", "valid"},
        {"out_valid", "valid_out", "o_valid", "valid_o", "m_axis_tvalid", "dout_valid", "valid"}}},
      {"ready",
       {{"in_ready", "i_ready", "ready_o", "s_axis_tready", "din_ready", "ready"},
        {"out_ready", "o_ready", "ready_i", "m_axis_tready", "dout_ready", "ready"}}},
      {"first",
       {{"in_first", "in_sof", "sof_in", "i_sof", "sof", "s_axis_tuser"},
        {"out_first", "out_sof", "sof_out", "o_sof", "sof", "m_axis_tuser"}}},
      {"last",
       {{"in_last", "in_eol", "eol_in", "i_eol", "eol", "s_axis_tlast"},
        {"out_last", "out_eol", "eol_out", "o_eol", "eol", "m_axis_tlast"}}},
      {"line_valid", {{"in_line_valid", "line_valid", "in_lval", "lval_in", "lval", "in_href", "href"}, {}}},
      {"frame_valid", {{"in_frame_valid", "frame_valid", "in_fval", "fval_in", "fval"}, {}}},
      {"row", {{"in_row", "in_y", "row", "y"}, {}}},
      {"column", {{"in_column", "in_col", "in_x", "column", "col", "x"}, {}}},
  };
  return all.at(role);
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/fifo_bench.hpp"

#include <fmt/format.h>

#include "platform/cosim/template_text.hpp"

namespace parallax {
namespace {

constexpr const char* kFifoBenchText =
    R"(// Test bench of the FIFO @module@: random stalls on both sides, and the waves that parallax fifo reads.
//   $ iverilog -g2012 -o sim fifo_bench.sv @module@.v && vvp sim && parallax fifo fifo_bench.vcd
//   $ verilator --binary --timing --trace -Wno-fatal --top-module fifo_bench fifo_bench.sv @module@.v && obj_dir/Vfifo_bench
// parallax fifo knows the names of these waves: --signals, as it names the module's ports, is left out there.
// +seed=N: other stalls. +phase=N: cycles until a side stalls in another way, at most (256): more than the FIFO is
// deep. +cycles=N: of the write clock after reset (20000).@periods_text@
`timescale 1ps / 1ps
`default_nettype none

module fifo_bench;
  integer seed = 1;
  integer phase = 256;
  integer cycles = 20000;
  integer cycle = 0;
@clocks@  reg rst = 1'b@reset@;

  // Not from the first moment on: an always @* of the FIFO waits for a change.
  reg write_want;
  reg read_want;
  initial begin
    #1 write_want = 1'b0;
    read_want = 1'b0;
  end
  wire @write_grant@;
  wire @read_grant@;
@enables@
  function automatic [31:0] shuffled(input [31:0] x);
    reg [31:0] y;
    begin
      y = x ^ (x << 13);
      y = y ^ (y >> 17);
      shuffled = y ^ (y << 5);
    end
  endfunction

  // In how many of 256 cycles a side wants a token: now never, now seldom, now always.
  function automatic [8:0] rate_of(input [2:0] draw);
    case (draw)
      3'd0: rate_of = 9'd0;
      3'd1: rate_of = 9'd4;
      3'd2: rate_of = 9'd16;
      3'd3: rate_of = 9'd64;
      3'd4: rate_of = 9'd128;
      3'd5: rate_of = 9'd224;
      default: rate_of = 9'd256;
    endcase
  endfunction

  reg [31:0] write_random;
  reg [31:0] write_left = 32'd0;
  reg [8:0] write_rate = 9'd0;
  always @(posedge @write_clock@) begin
    cycle <= cycle + 1;
    if (cycle >= 16) rst <= 1'b0;
    if (cycle >= cycles + 16) $finish;
    write_random <= shuffled(write_random);
    if (write_left == 32'd0) begin
      write_left <= (write_random >> 8) % phase;
      write_rate <= rate_of(write_random[2:0]);
    end else begin
      write_left <= write_left - 32'd1;
    end
    // What is offered stays until it is taken.
    if (rst) write_want <= 1'b0;
    else if (!write_want || @write_moves@) write_want <= {1'b0, write_random[31:24]} < write_rate;
  end

  reg [31:0] read_random;
  reg [31:0] read_left = 32'd0;
  reg [8:0] read_rate = 9'd0;
  always @(posedge @read_clock@) begin
    read_random <= shuffled(read_random);
    if (read_left == 32'd0) begin
      read_left <= (read_random >> 8) % phase;
      read_rate <= rate_of(read_random[2:0]);
    end else begin
      read_left <= read_left - 32'd1;
    end
    read_want <= !rst && {1'b0, read_random[31:24]} < read_rate;
  end

  @module@ @parameters@dut (
@ports@
  );

  integer ignored;
  initial begin
    ignored = $value$plusargs("seed=%d", seed);
    ignored = $value$plusargs("phase=%d", phase);
    ignored = $value$plusargs("cycles=%d", cycles);
    if (phase < 1) phase = 1;
@periods@    write_random = shuffled(32'h2545F491 ^ (seed << 8));
    read_random = shuffled(32'h6C078965 ^ (seed << 8));
    $dumpfile("fifo_bench.vcd");
    $dumpvars(1, fifo_bench);
  end
endmodule
)";

std::string bindings(const FifoModule::Bindings& all, const char* indent) {
  std::string text;
  for (const auto& [name, value] : all)
    text += fmt::format("{}{}.{}({})", text.empty() ? "" : ",\n", indent, name, value);
  return text;
}

const std::string& or_else(const std::string& given, const std::string& usual) {
  return given.empty() ? usual : given;
}

}  // namespace

std::string fifo_bench(const FifoModule& module) {
  const FifoSignals& ports = module.ports;
  const bool two_clocks = !ports.write_clock.empty();
  const bool by_full = !ports.full.empty();
  const bool by_empty = !ports.empty.empty();
  FifoModule::Bindings all;
  if (two_clocks) {
    all.emplace_back(ports.write_clock, "write_clk");
    all.emplace_back(ports.read_clock, "read_clk");
  } else {
    all.emplace_back(or_else(ports.clock, "clk"), "clk");
  }
  if (module.has_reset) {
    all.emplace_back(ports.reset_n.empty() ? or_else(ports.reset, "rst") : ports.reset_n,
                     ports.reset_n.empty() ? "rst" : "!rst");
  }
  all.emplace_back(or_else(ports.write_valid, "s_axis_tvalid"), by_full ? "wr_en" : "write_valid");
  all.emplace_back(by_full ? ports.full : or_else(ports.write_ready, "s_axis_tready"),
                   by_full ? "full" : "write_ready");
  all.emplace_back(by_empty ? ports.empty : or_else(ports.read_valid, "m_axis_tvalid"),
                   by_empty ? "empty" : "read_valid");
  all.emplace_back(or_else(ports.read_ready, "m_axis_tready"), by_empty ? "rd_en" : "read_ready");
  all.insert(all.end(), module.connections.begin(), module.connections.end());
  const std::string enables =
      std::string(by_full ? "  wire wr_en = write_want && full === 1'b0;\n"
                          : "  wire write_valid = write_want;\n") +
      (by_empty ? "  wire rd_en = read_want && empty === 1'b0;\n" : "  wire read_ready = read_want;\n");
  return filled(
      kFifoBenchText,
      {{"module", module.name},
       {"periods_text",
        two_clocks ? "\n// +write_period=N, +read_period=N: of the clocks in ps, even (10000 and 7400)."
                   : ""},
       {"clocks", two_clocks ? "  integer write_period = 10000;\n  integer read_period = 7400;\n"
                               "  reg write_clk = 1'b0;\n  reg read_clk = 1'b0;\n"
                               "  always #(write_period / 2) write_clk = ~write_clk;\n"
                               "  always #(read_period / 2) read_clk = ~read_clk;\n"
                             : "  reg clk = 1'b0;\n  always #5000 clk = ~clk;\n"},
       {"reset", module.has_reset ? "1" : "0"},  // without one, cycle 0 is the first
       {"write_grant", by_full ? "full" : "write_ready"},
       {"read_grant", by_empty ? "empty" : "read_valid"},
       {"enables", enables},
       {"write_clock", two_clocks ? "write_clk" : "clk"},
       {"read_clock", two_clocks ? "read_clk" : "clk"},
       {"write_moves", by_full ? "full === 1'b0" : "write_ready === 1'b1"},
       {"parameters",
        module.parameters.empty() ? "" : "#(\n" + bindings(module.parameters, "    ") + "\n  ) "},
       {"ports", bindings(all, "    ")},
       {"periods", two_clocks ? "    ignored = $value$plusargs(\"write_period=%d\", write_period);\n"
                                "    ignored = $value$plusargs(\"read_period=%d\", read_period);\n"
                              : ""}});
}

}  // namespace parallax

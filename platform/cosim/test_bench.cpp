// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/test_bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "platform/cosim/circuit_stub.hpp"
#include "platform/cosim/template_text.hpp"

namespace parallax {
namespace {

std::string digits_of(const std::string& check, std::size_t width) {
  return fmt::format("{}'h{}", width, check);
}

Replacements words_of(const VectorManifest& manifest, const VectorStream& stream) {
  const std::size_t width = stream.shape.format.width().size();
  const bool knows_rows = stream.shape.row_tokens > 0;
  const std::uint64_t pass = std::max<std::uint64_t>(manifest.pass_tokens(stream), 1);
  const std::uint64_t row = knows_rows ? stream.shape.row_tokens : pass;
  return {{"port", stream.port},
          {"stream", stream.name},
          {"file", stream.file},
          {"range", bus_range(stream)},
          {"width", std::to_string(width)},
          {"rotated",
           width == 1 ? stream.port + "_sum"
                      : fmt::format("{{{0}_sum[{1}:0], {0}_sum[{2}]}}", stream.port, width - 2, width - 1)},
          {"check", digits_of(stream.check, width)},
          {"tokens", std::to_string(stream.tokens)},
          {"pass", std::to_string(pass)},
          {"row", std::to_string(row)},
          {"stage", manifest.stage}};
}

constexpr const char* kHead =
    R"(// Test bench of the stage @stage@, written by @program@ with the vectors beside it.
// It feeds the circuit with the inputs of @frames@ frame@s@ of @width@x@height@ px and compares what comes out. Run it in this folder:
//   $ iverilog -g2012 -o sim @stage@_tb.sv @stage@.sv && vvp sim
//   $ verilator --binary --timing -Wno-fatal --top-module @stage@_tb @stage@_tb.sv @stage@.sv && obj_dir/V@stage@_tb
// The circuit is a module @stage@ with the ports of @stage@_stub.sv; -DDUT=NAME takes another module.
// +seed=N: other stalls. +stall=N: each side waits in N of 256 cycles (64; 0: never). +pause=N: now and then for N cycles,
// so that pipelines fill up and run dry (256). +timeout=N: cycles without a token until it gives up (@timeout@).
// +dump: writes what came out, for parallax compare. +vcd: writes waves.
// It ends with a line that begins with PASS, or with FAIL and an exit code that is not 0.
`timescale 1ns / 1ps
`default_nettype none
`ifndef DUT
`define DUT @stage@
`endif

module @stage@_tb;
  // The circuit's inputs have no value before time 1, since an always @* of it waits for a change.
  reg clk = 1'b0;
  reg rst = 1'b1;
  always #5 clk = ~clk;

  integer stall;
  integer pause;
  integer seed;
  integer timeout;
  integer dump;
  integer cycle = 0;
  integer quiet = 0;  // cycles since a token moved
  integer faults = 0;
  integer i;

  function automatic [31:0] shuffled(input [31:0] x);
    reg [31:0] y;
    begin
      y = x ^ (x << 13);
      y = y ^ (y >> 17);
      shuffled = y ^ (y << 5);
    end
  endfunction
)";

constexpr const char* kStalls = R"(
  // @stream@
  reg [31:0] @port@_random;
  integer @port@_pause = 0;  // cycles of it that are left
  wire @port@_goes = @port@_pause == 0 && {24'd0, @port@_random[31:24]} >= stall;
  always @(posedge clk) begin
    @port@_random <= shuffled(@port@_random);
    if (@port@_pause != 0) @port@_pause <= @port@_pause - 1;
    else if (stall != 0 && @port@_random[10:0] == 11'd0) @port@_pause <= pause;
  end
)";

constexpr const char* kInput = R"(  reg @range@ @port@_words [0:@tokens@ - 1];
  reg @range@ @port@_sum;
  reg @range@ @port@_data;
  reg @port@_valid;
  reg @port@_first;
  reg @port@_last;
  initial begin
    #1 @port@_valid = 1'b0;
    @port@_first = 1'b0;
    @port@_last = 1'b0;
  end
  wire @port@_ready;
  integer @port@_next = 0;   // token to be offered
  integer @port@_taken = 0;  // tokens that the circuit has
  always @(posedge clk) begin
    if (!rst) begin
      if (@port@_ready !== 1'b0 && @port@_ready !== 1'b1) begin
        if (faults < 10) $display("@port@_ready is unknown in cycle %0d", cycle);
        faults = faults + 1;
      end
      if (@port@_valid && @port@_ready === 1'b1) @port@_taken <= @port@_taken + 1;
      if (!@port@_valid || @port@_ready === 1'b1) begin
        if (@port@_next < @tokens@ && @port@_goes) begin
          @port@_valid <= 1'b1;
          @port@_data <= @port@_words[@port@_next];
          @port@_first <= @port@_next % @pass@ == 0;
          @port@_last <= @port@_next % @row@ == @row@ - 1;
          @port@_next <= @port@_next + 1;
        end else begin
          @port@_valid <= 1'b0;
          @port@_data <= {@width@{1'bx}};
          @port@_first <= 1'b0;
          @port@_last <= 1'b0;
        end
      end
    end
  end
)";

constexpr const char* kOutput = R"(  reg @range@ @port@_words [0:@tokens@ - 1];
  reg @range@ @port@_sum;
  wire @range@ @port@_data;
  wire @port@_valid;
  reg @port@_ready;
  initial #1 @port@_ready = 1'b0;
  integer @port@_taken = 0;
  integer @port@_wrong = 0;
  integer @port@_file = 0;
  reg @port@_held = 1'b0;  // offered and not taken, in the cycle before
  reg @range@ @port@_offered;
  reg @range@ @port@_expected;
  always @(posedge clk) begin
    if (!rst) begin
      @port@_ready <= @port@_goes;
      if (@port@_valid !== 1'b0 && @port@_valid !== 1'b1) begin
        if (faults < 10) $display("@port@_valid is unknown in cycle %0d", cycle);
        faults = faults + 1;
      end
      if (@port@_held && @port@_valid !== 1'b1) begin
        if (faults < 10) $display("@port@_valid is withdrawn in cycle %0d, before the token was taken", cycle);
        faults = faults + 1;
      end
      if (@port@_held && @port@_valid === 1'b1 && @port@_data !== @port@_offered) begin
        if (faults < 10) $display("@port@_data changes in cycle %0d, before the token was taken", cycle);
        faults = faults + 1;
      end
      @port@_held <= @port@_valid === 1'b1 && !@port@_ready;
      @port@_offered <= @port@_data;
      if (@port@_valid === 1'b1 && @port@_ready) begin
        if (dump != 0) $fdisplay(@port@_file, "%h", @port@_data);
        if (@port@_taken < @tokens@) begin
          @port@_expected = @port@_words[@port@_taken];
          if (@port@_data !== @port@_expected) begin
            if (@port@_wrong == 0) begin
              $display("@stream@: the first difference is @place@, in cycle %0d: expected %h, got %h",
                       @arguments@, cycle, @port@_expected, @port@_data);
            end
            @port@_wrong = @port@_wrong + 1;
          end
        end else if (@port@_taken == @tokens@) begin
          $display("@stream@: more than @tokens@ tokens come out, in cycle %0d", cycle);
        end
        @port@_taken <= @port@_taken + 1;
      end
    end
  end
)";

constexpr const char* kBegin = R"(
  `DUT dut (
    .clk(clk),
    .rst(rst)@connections@
  );

  initial begin
    if (!$value$plusargs("seed=%d", seed)) seed = 1;
    if (!$value$plusargs("stall=%d", stall)) stall = 64;
    if (!$value$plusargs("pause=%d", pause)) pause = 256;
    if (!$value$plusargs("timeout=%d", timeout)) timeout = @timeout@;
    dump = 0;
    if ($test$plusargs("dump")) dump = 1;
    if ($test$plusargs("vcd")) begin
      $dumpfile("@stage@.vcd");
      $dumpvars(0, @stage@_tb);
    end
)";

constexpr const char* kLoad = R"(    @port@_random = shuffled(32'd@salt@ ^ (seed << 8));
    $readmemh("@file@", @port@_words);
    @port@_sum = {@width@{1'b0}};
    for (i = 0; i < @tokens@; i = i + 1) @port@_sum = @rotated@ ^ @port@_words[i];
    if (@port@_sum !== @check@) begin
      $display("FAIL @stage@: @file@ is not here, or not the one that was written with this test bench");
      $fatal(1);
    end
)";

constexpr const char* kDump = R"(    if (dump != 0) @port@_file = $fopen("@stream@.dump", "w");
)";

constexpr const char* kProgress = R"(  end

  always @(posedge clk) begin
    cycle <= cycle + 1;
    if (cycle >= 16) rst <= 1'b0;
    if (rst || @moves@) quiet <= 0;
    else quiet <= quiet + 1;
    if (quiet > @drain@ && @complete@) begin
@verdict@    end
    if (faults >= 1000) begin
      $display("FAIL @stage@: the handshake was broken 1000 times, in cycle %0d", cycle);
      $fatal(1);
    end
    if (quiet > timeout) begin
@stalled@      $display("FAIL @stage@: nothing has moved for %0d cycles, in cycle %0d", quiet, cycle);
      $fatal(1);
    end
  end
endmodule
)";

std::string all(const VectorManifest& manifest, const std::string& text,
                const std::function<bool(const VectorStream&)>& which, const std::string& between = "") {
  std::string out;
  for (const VectorStream& stream : manifest.streams) {
    if (!which(stream)) continue;
    if (!out.empty()) out += between;
    out += filled(text, words_of(manifest, stream));
  }
  return out;
}

bool any(const VectorStream&) { return true; }
bool input(const VectorStream& stream) { return stream.is_input; }
bool output(const VectorStream& stream) { return !stream.is_input; }

// "frame %0d, row %0d, column %0d", and what stands for them.
Replacements place_of(const VectorStream& stream) {
  const std::string taken = stream.port + "_taken";
  if (stream.shape.row_tokens == 0)
    return {{"place", "token %0d of frame %0d"},
            {"arguments",
             fmt::format("{} % {}, {} / {}", taken, stream.frame_tokens, taken, stream.frame_tokens)}};
  const std::uint64_t group = stream.shape.tokens_per_pixel;
  std::string place = "token %0d (frame %0d, row %0d, column %0d";
  std::string arguments = fmt::format(
      "{0}, {0} / {1}, {0} % {1} / {2}, {0} % {2}{3}", taken, stream.frame_tokens, stream.shape.row_tokens,
      group > 1 ? fmt::format(" / {}", group) : fmt::format(" * {}", stream.shape.pixels_per_token));
  if (group > 1) {
    place += ", group %0d";
    arguments += fmt::format(", {} % {}", taken, group);
  }
  return {{"place", place + ")"}, {"arguments", arguments}};
}

std::string outputs(const VectorManifest& manifest) {
  std::string out;
  for (const VectorStream& stream : manifest.streams) {
    if (stream.is_input) continue;
    out += filled(filled(std::string(kStalls) + kOutput, words_of(manifest, stream)), place_of(stream));
  }
  return out;
}

std::string loads(const VectorManifest& manifest) {
  std::string out;
  unsigned salt = 0x2545F491;
  for (const VectorStream& stream : manifest.streams) {
    out += filled(filled(kLoad, words_of(manifest, stream)), {{"salt", std::to_string(salt)}});
    salt = salt * 1664525U + 1013904223U;
  }
  return out;
}

constexpr std::uint64_t kDrain = 2000;  // cycles in which nothing more may come out

}  // namespace

std::string test_bench(const VectorManifest& whole) {
  const VectorManifest manifest = whole.without_taps();
  // A frame's rows are looked ahead at most, all of it before a second pass.
  std::uint64_t frame = 0;
  for (const VectorStream& stream : manifest.streams) frame = std::max(frame, stream.frame_tokens);
  const Replacements facts{{"stage", manifest.stage},
                           {"program", manifest.program},
                           {"frames", std::to_string(manifest.frames)},
                           {"s", manifest.frames == 1 ? "" : "s"},
                           {"width", std::to_string(manifest.width)},
                           {"height", std::to_string(manifest.height)},
                           {"drain", std::to_string(kDrain)},
                           {"timeout", std::to_string(std::max<std::uint64_t>(100000, 4 * frame))}};
  const auto end = filled(
      kProgress,
      {{"moves", all(manifest, "(@port@_valid === 1'b1 && @port@_ready === 1'b1)", any, " || ")},
       {"complete", all(manifest, "@port@_taken >= @tokens@", output, " && ")},
       {"verdict",
        all(manifest,
            "      if (@port@_wrong != 0) $display(\"@stream@: %0d of @tokens@ tokens differ\", "
            "@port@_wrong);\n"
            "      if (@port@_taken > @tokens@) $display(\"@stream@: %0d tokens came out, expected "
            "@tokens@\", "
            "@port@_taken);\n",
            output) +
            all(manifest,
                "      if (@port@_taken != @tokens@) $display(\"@stream@: the circuit took %0d of @tokens@ "
                "tokens\", @port@_taken);\n",
                input) +
            "      if (faults == 0 && " +
            all(manifest, "@port@_wrong == 0 && @port@_taken == @tokens@", output, " && ") + " && " +
            all(manifest, "@port@_taken == @tokens@", input, " && ") +
            ") begin\n        $display(\"PASS @stage@: " +
            all(manifest, "@tokens@ tokens of @stream@", output, ", ") +
            ", in %0d cycles\", cycle - quiet);\n        $finish;\n      end else begin\n"
            "        $display(\"FAIL @stage@: it differs from the model, in %0d cycles\", cycle - quiet);\n"
            "        $fatal(1);\n      end\n"},
       {"stalled",
        all(manifest,
            "      $display(\"@stream@: the circuit took %0d of @tokens@ tokens; @port@_valid is %b, "
            "@port@_ready is %b\", @port@_taken, @port@_valid, @port@_ready);\n",
            input) +
            all(manifest,
                "      $display(\"@stream@: %0d of @tokens@ tokens came out, %0d of them wrong; @port@_valid "
                "is "
                "%b, @port@_ready is %b\", @port@_taken, @port@_wrong, @port@_valid, @port@_ready);\n",
                output)}});
  const auto begin = filled(
      kBegin, {{"connections", all(manifest,
                                   ",\n    .@port@_data(@port@_data),\n    .@port@_valid(@port@_valid),\n"
                                   "    .@port@_first(@port@_first),\n    .@port@_last(@port@_last),\n"
                                   "    .@port@_ready(@port@_ready)",
                                   input) +
                                   all(manifest,
                                       ",\n    .@port@_data(@port@_data),\n"
                                       "    .@port@_valid(@port@_valid),\n    .@port@_ready(@port@_ready)",
                                       output)}});
  return filled(kHead + all(manifest, std::string(kStalls) + kInput, input) + outputs(manifest) + begin +
                    loads(manifest) + all(manifest, kDump, output) + end,
                facts);
}

}  // namespace parallax

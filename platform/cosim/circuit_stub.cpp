// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_stub.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <vector>

namespace parallax {
namespace {

std::string fields_text(const VectorStream& stream) {
  constexpr std::size_t kShown = 8;
  const std::vector<TokenField>& fields = stream.shape.format.all();
  std::string text;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields.size() > kShown && i == kShown / 2) {
      text += "  //   ...\n";
      i = fields.size() - 1;
    }
    text += fmt::format("  //   [{}:{}] {}{}\n", fields[i].low + fields[i].width - 1, fields[i].low,
                        fields[i].name, fields[i].is_signed ? ", signed" : "");
  }
  return text;
}

}  // namespace

std::string bus_range(const VectorStream& stream) {
  return fmt::format("[{}:0]", stream.shape.format.width().count() - 1);
}

std::string circuit_stub(const VectorManifest& whole) {
  const VectorManifest manifest = whole.without_taps();
  std::string text = fmt::format(
      "// The ports of a circuit in the place of the stage {0}, as {0}_tb.sv binds them; nothing is behind "
      "them.\n"
      "// A token is taken in a cycle in which valid and ready are both 1 at the rising edge of clk. rst is "
      "high, and synchronous.\n"
      "// first: the first token of a frame, or of a tile of it; last: the last one of a row. The model: {1} "
      "cycle{2} from one "
      "token to the next, {3} from\n"
      "// reading to writing, {4} tokens of pixels read beyond the one written.\n"
      "`timescale 1ns / 1ps\n`default_nettype none\n\nmodule {0} (\n  input wire clk,\n  input wire rst",
      manifest.stage, manifest.interval, manifest.interval == 1 ? "" : "s", manifest.latency,
      manifest.look_ahead);
  for (const VectorStream& stream : manifest.streams) {
    text += ",\n\n  // " + stream.name;
    for (const std::string& other : stream.also) text += ", " + other;
    text += "\n" + fields_text(stream);
    const char* const forward = stream.is_input ? "input" : "output";
    const char* const backward = stream.is_input ? "output" : "input";
    text += fmt::format("  {} wire {} {}_data,\n  {} wire {}_valid,\n", forward, bus_range(stream),
                        stream.port, forward, stream.port);
    if (stream.is_input)
      text += fmt::format("  input wire {0}_first,\n  input wire {0}_last,\n", stream.port);
    text += fmt::format("  {} wire {}_ready", backward, stream.port);
  }
  text += "\n);\n";
  for (const VectorStream& stream : manifest.streams) {
    if (stream.is_input) {
      text += fmt::format("  assign {}_ready = 1'b0;\n", stream.port);
    } else {
      text += fmt::format("  assign {0}_data = {1}'d0;\n  assign {0}_valid = 1'b0;\n", stream.port,
                          stream.shape.format.width().count());
    }
  }
  return text + "endmodule\n";
}

}  // namespace parallax

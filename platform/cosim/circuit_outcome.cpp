// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "platform/cosim/token_comparison.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

// Of an output stream, in cycles.
struct Dates {
  std::vector<std::int64_t> circuit, model;  // of each frame, from its first to its last token
  std::int64_t latest = 0;                   // most that a token is behind the model's
  std::uint64_t latest_token = 0;
  bool known = false;  // of a token at least

  Dates(const VectorStream& stream, const std::vector<std::int64_t>& got,
        const std::vector<std::int64_t>& expected) {
    const std::size_t both = std::min(got.size(), expected.size());
    known = both > 0;
    for (std::size_t token = 0; token < both; ++token) {
      const std::int64_t later = got[token] - expected[token];
      if (token == 0 || later > latest) {
        latest = later;
        latest_token = token;
      }
    }
    for (std::size_t last = stream.frame_tokens - 1; last < both; last += stream.frame_tokens) {
      const std::size_t first = last + 1 - stream.frame_tokens;
      circuit.push_back(got[last] - got[first] + 1);
      model.push_back(expected[last] - expected[first] + 1);
    }
  }

  bool within(const std::optional<std::int64_t>& bound) const { return !bound || !known || latest <= *bound; }
};

std::string cycles_text(std::int64_t cycles) {
  return grouped(std::to_string(cycles)) + (cycles == 1 ? " cycle" : " cycles");
}

std::string text(const Dates& dates, const std::optional<std::int64_t>& bound) {
  if (dates.circuit.empty()) return {};
  std::string out =
      fmt::format("{:20}{} from the first to the last token of frame 0; the model {}\n", "dates",
                  cycles_text(dates.circuit[0]), grouped(std::to_string(dates.model[0])));
  if (dates.latest > 0) {
    out += fmt::format("{:20}at most {} later than the model, at token {}\n", "", cycles_text(dates.latest),
                       dates.latest_token);
  } else if (dates.latest < 0) {
    out += fmt::format("{:20}each at least {} earlier than the model\n", "", cycles_text(-dates.latest));
  } else {
    out += fmt::format("{:20}never later than the model\n", "");
  }
  if (!dates.within(bound)) out += fmt::format("{:20}more than the bound of {}\n", "", cycles_text(*bound));
  return out;
}

}  // namespace

CircuitOutcome circuit_outcome(const std::string& module, const CircuitStage& circuit,
                               const StageRecord& model, const CircuitOptions& options) {
  CircuitOutcome outcome;
  outcome.fault = circuit.fault();
  outcome.as_model = outcome.fault.empty() && circuit.breach().empty();
  outcome.text = fmt::format("circuit             {} in the place of {}, clocked for {}\n", module,
                             model.manifest.stage, cycles_text(static_cast<std::int64_t>(circuit.cycles())));
  if (!outcome.fault.empty()) outcome.text += fmt::format("given up            {}\n", outcome.fault);
  if (!circuit.breach().empty()) outcome.text += fmt::format("handshake           {}\n", circuit.breach());
  nlohmann::ordered_json streams = nlohmann::ordered_json::array();
  std::size_t output = 0;
  for (std::size_t i = 0; i < model.streams.size(); ++i) {
    const VectorStream& stream = model.manifest.streams[i];
    if (stream.is_input) continue;
    const Dump& dump = circuit.output(output++).dump();
    const TokenComparison values = compare_tokens(model.manifest, stream, model.streams[i].words, dump);
    const Dates dates(stream, dump.cycles, model.streams[i].cycles);
    outcome.as_model = outcome.as_model && values.equal() && dates.within(options.bound);
    outcome.text += text(values) + text(dates, options.bound);
    nlohmann::ordered_json tree = to_json(values);
    tree["frame_cycles"] = dates.circuit;
    tree["model_frame_cycles"] = dates.model;
    if (!dates.circuit.empty()) tree["latest"] = {{"cycles", dates.latest}, {"token", dates.latest_token}};
    streams.push_back(std::move(tree));
  }
  outcome.json = {{"module", module},
                  {"stage", model.manifest.stage},
                  {"cycles", circuit.cycles()},
                  {"as_model", outcome.as_model}};
  if (!outcome.fault.empty()) outcome.json["given_up"] = outcome.fault;
  if (!circuit.breach().empty()) outcome.json["handshake"] = circuit.breach();
  outcome.json["streams"] = std::move(streams);
  return outcome;
}

}  // namespace parallax

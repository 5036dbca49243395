// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_outcome.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "platform/cosim/difference_image.hpp"
#include "platform/cosim/token_comparison.hpp"
#include "platform/cosim/token_dates.hpp"
#include "platform/images/image_codecs.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

std::string bytes_text(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

CircuitOutcome circuit_outcome(const std::string& module, const CircuitStage& circuit,
                               const StageRecord& model, const CircuitOptions& options) {
  CircuitOutcome outcome;
  outcome.fault = circuit.fault();
  outcome.as_model = outcome.fault.empty() && circuit.breach().empty() && circuit.framing_breach().empty();
  outcome.text = fmt::format("circuit             {} in the place of {}, clocked for {}\n", module,
                             model.manifest.stage, cycles_text(static_cast<std::int64_t>(circuit.cycles())));
  if (!outcome.fault.empty()) outcome.text += fmt::format("given up            {}\n", outcome.fault);
  if (!circuit.breach().empty()) outcome.text += fmt::format("handshake           {}\n", circuit.breach());
  if (!circuit.framing_breach().empty())
    outcome.text += fmt::format("framing             {}\n", circuit.framing_breach());
  const std::string prefix = "circuit_" + model.manifest.stage;
  if (const std::optional<PinWaves> waves = circuit.waves()) {
    outcome.files.push_back({prefix + ".vcd", to_vcd(*waves)});
    outcome.files.push_back({prefix + ".pftrace", to_perfetto(*waves)});
  }
  std::vector<std::string> notes = circuit.notes();
  std::string compared;  // streams
  nlohmann::ordered_json streams = nlohmann::ordered_json::array();
  std::size_t output = 0;
  const ModelTokens recorded = [&model](const VectorStream& stream) {
    return &model.streams[static_cast<std::size_t>(&stream - model.manifest.streams.data())].words;
  };
  for (std::size_t i = 0; i < model.streams.size(); ++i) {
    const VectorStream& stream = model.manifest.streams[i];
    if (stream.is_input) continue;
    const Dump& dump = circuit.output(output++).dump();
    const TokenComparison values =
        compare_tokens(model.manifest, stream, model.streams[i].words, dump, recorded);
    const TokenDates dates(stream, dump.cycles, model.streams[i].cycles);
    outcome.as_model = outcome.as_model && values.equal() && dates.within(options.bound);
    compared += text(values) + dates.text(options.bound);
    if (model.manifest.stage == "matching" && !values.equal() && values.patterns.front().name == "none") {
      notes.push_back(fmt::format(
          "{}: parallax vectors --stage matching --taps writes each path's costs, and parallax compare says "
          "which path differs",
          stream.name));
    }
    nlohmann::ordered_json tree = to_json(values);
    dates.add_to(tree);
    if (!values.equal()) {
      const cv::Mat image = difference_image(model.manifest, stream, model.streams[i].words, dump.words);
      if (!image.empty())
        outcome.files.push_back(
            {prefix + "_" + stream.name + ".png", bytes_text(encode_image(".png", image))});
    }
    streams.push_back(std::move(tree));
  }
  for (const std::string& note : notes) outcome.text += fmt::format("note                {}\n", note);
  outcome.text += compared;
  outcome.json = {{"module", module},
                  {"stage", model.manifest.stage},
                  {"cycles", circuit.cycles()},
                  {"as_model", outcome.as_model}};
  if (!outcome.fault.empty()) outcome.json["given_up"] = outcome.fault;
  if (!circuit.breach().empty()) outcome.json["handshake"] = circuit.breach();
  if (!circuit.framing_breach().empty()) outcome.json["framing"] = circuit.framing_breach();
  if (!notes.empty()) outcome.json["notes"] = notes;
  outcome.json["streams"] = std::move(streams);
  return outcome;
}

}  // namespace parallax

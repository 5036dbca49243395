// SPDX-License-Identifier: Apache-2.0
// What a circuit in the place of a stage says of itself.
#include <fmt/format.h>

#include <algorithm>

#include "platform/cosim/circuit_stage.hpp"
#include "platform/cosim/full_fifos.hpp"
#include "platform/cosim/pin_checks.hpp"

namespace parallax {

// Why there is no edge, of ports that cannot wait; empty: there are edges.
std::string CircuitStage::what_stops_clock() const {
  for (const auto& input : inputs_) {
    if (!lacks_token(*input)) continue;
    const auto output = std::find_if(outputs_.begin(), outputs_.end(),
                                     [](const auto& each) { return !each->port().pins.valid; });
    return input->port().pins.valid
               ? fmt::format("{}, which has no valid, needs a token at {} with each edge",
                             (*output)->port().pins.port, input->port().pins.port)
               : fmt::format("{} has no token, and no valid to say so", input->port().pins.port);
  }
  for (const auto& output : outputs_) {
    if (lacks_room(*output))
      return fmt::format("{} has no room, and no ready to say so", output->port().pins.port);
  }
  return {};
}

// What each port waits for.
std::string CircuitStage::waits() const {
  std::string text;
  const auto say = [&text](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  if (const std::string full = full_fifos(dataflow_); !full.empty()) say(full);
  if (const std::string why = what_stops_clock(); !why.empty()) say("its clock stands: " + why);
  for (const auto& input : inputs_) say(input->wait());
  for (const auto& output : outputs_) say(output->wait());
  return text;
}

const std::string& CircuitStage::breach() const {
  static const std::string none;
  for (const auto& output : outputs_) {
    if (!output->breach().empty()) return output->breach();
  }
  return none;
}

std::vector<std::string> CircuitStage::notes() const {
  std::vector<std::string> all = half_handshakes(pins_);
  for (const ReadyProbe& probe : probes_) {
    if (!probe.note().empty()) all.push_back(probe.note());
  }
  for (const auto& output : outputs_) {
    if (const std::uint64_t lost = output->lost_by_skip(); lost > 0) {
      all.push_back(
          fmt::format("{}: {} token{} too few, as --circuit-skip {} drops as many of each frame or tile; "
                      "--circuit-flush {} sends zeros behind it that push its last ones out",
                      output->port().stream.name, lost, lost == 1 ? "" : "s", options_.skip, options_.skip));
    }
    const std::uint64_t dropped = output->dropped();
    if (dropped == 0) continue;
    all.push_back(fmt::format(
        "{}: {} result{} behind the last one of a frame, of {} tokens of zeros behind each; "
        "--circuit-flush says how many",
        output->port().stream.name, dropped, dropped == 1 ? "" : "s", output->port().pass_flush()));
  }
  return all;
}

const std::string& CircuitStage::framing_breach() const {
  static const std::string none;
  for (const auto& output : outputs_) {
    if (!output->framing().breach().empty()) return output->framing().breach();
  }
  return none;
}

}  // namespace parallax

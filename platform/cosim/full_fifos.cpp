// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/full_fifos.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "platform/config/stream_config.hpp"
#include "tlm/stream_base.hpp"

namespace parallax {

std::string full_fifos(const Dataflow& dataflow) {
  const std::vector<std::string>& keys = pipeline_stream_names();
  std::string text;
  for (const Wait& wait : dataflow.deadlock()) {
    if (!wait.on_full) continue;
    const std::string stream = wait.stream->basename();
    const bool has_key = std::find(keys.begin(), keys.end(), stream) != keys.end();
    text += fmt::format("{}{} is full ({} {}) and {} waits for room in it", text.empty() ? "" : "; ", stream,
                        has_key ? fmt::format("streams.{}.depth =", stream) : "depth", wait.stream->depth(),
                        wait.waiter.substr(wait.waiter.rfind('.') + 1));
  }
  return text;
}

}  // namespace parallax

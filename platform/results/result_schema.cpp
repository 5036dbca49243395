// SPDX-License-Identifier: Apache-2.0
#include "platform/results/result_schema.hpp"

#include "platform/config/configuration_hash.hpp"
#include "platform/results/run_metrics.hpp"

namespace parallax {

void add_schema(MetricGroup& root, const MachineConfig& config) {
  const MetricWriter out(root, run_table());
  out.add("schema/version", kResultSchema);
  out.add("schema/configuration", configuration_hash(config));
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/registers/algorithm_parameters.hpp"

#include "platform/registers/run_time_parameters.hpp"

namespace parallax {

AlgorithmParameters algorithm_parameters(const MachineConfig& config) {
  AlgorithmParameters parameters;
  for (const RunTimeParameter& p : run_time_parameters()) parameters.values.push_back(p.member.get(config));
  return parameters;
}

MachineConfig with_parameters(MachineConfig config, const AlgorithmParameters& parameters) {
  std::size_t row = 0;
  for (const RunTimeParameter& p : run_time_parameters()) p.member.set(config, parameters.values.at(row++));
  return config;
}

}  // namespace parallax

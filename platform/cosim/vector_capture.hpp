// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "platform/cosim/vector_manifest.hpp"
#include "platform/machine/machine.hpp"
#include "platform/machine/token_port.hpp"
#include "platform/results/output_folder.hpp"

namespace parallax {

/// What is written beside the tokens at the ports.
struct VectorExtras {
  bool dates = false;  ///< when each token passed
  bool taps = false;   ///< what is taken inside the stage
};

/// Writes down the tokens that pass the ports of a stage, from before the simulation starts on.
class VectorCapture {
 public:
  /// After check_vectors(), and check_taps() if these are wanted. All must outlive the capture.
  VectorCapture(const Machine& machine, const std::string& stage, const VectorExtras& extras,
                OutputFolder& folder);
  ~VectorCapture();

  /// After the simulation, of which `frames` frames had images: completes the files.
  VectorManifest finish(std::int64_t frames);

 private:
  class Lines;
  struct Port;

  const Machine& machine_;
  VectorManifest manifest_;
  std::vector<std::unique_ptr<Port>> ports_;
};

/// A stage of the machine as a manifest has it, with its streams, of which no token has passed yet.
VectorManifest stage_manifest(const Machine& machine, const std::string& stage);

/// Throws UserError when the pipeline has no such stage, naming the nearest, or when its tokens are not known
/// as they lie on wires.
/// `option`: that names it.
void check_vectors(const Pipeline& pipeline, const MachineConfig& config, const std::string& stage,
                   const char* option);
inline void check_vectors(const Machine& machine, const std::string& stage, const char* option) {
  check_vectors(machine.pipeline(), machine.config(), stage, option);
}

/// Throws UserError when nothing can be taken inside the stage, naming one where it can be.
void check_taps(const Machine& machine, const std::string& stage, const char* option);

/// How the files of vectors end, but for the manifest.
inline constexpr std::array kVectorEndings{".memh", ".dates", "_tb.sv", "_stub.sv"};

/// The files of a stage's vectors, with its test bench.
std::set<std::string> vector_file_names(const Machine& machine, const std::string& stage,
                                        const VectorExtras& extras);

}  // namespace parallax

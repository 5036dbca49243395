// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "platform/cosim/pin_list.hpp"
#include "platform/input/circuit_options.hpp"

namespace parallax {

/// Looks at the pins of a circuit that is not compiled yet, which takes most of the time; what is on them
/// means nothing.
using PinCheck = std::function<void(const PinList& pins)>;

/// Has Verilator and the C++ compiler make a library of Verilog sources that parallax_get_circuit() is in.
/// Throws UserError when one of them is missing or refuses the sources, with its first error;
/// and as `check` does.
void build_circuit(const std::vector<std::filesystem::path>& sources, const CircuitOptions& options,
                   const std::filesystem::path& library, const PinCheck& check = {});

/// A circuit's library: the file that the user gave, or one that is built of the sources and goes with this
/// object.
class CircuitFile {
 public:
  /// As build_circuit(); throws UserError when a file is not there, too.
  CircuitFile(const std::vector<std::filesystem::path>& files, const CircuitOptions& options,
              const PinCheck& check = {});
  ~CircuitFile();
  CircuitFile(const CircuitFile&) = delete;
  CircuitFile& operator=(const CircuitFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::filesystem::path folder_;  // that goes with it; empty: none
};

}  // namespace parallax

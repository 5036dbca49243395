// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "tlm/error.hpp"

namespace parallax {
Circuit::Circuit(const std::filesystem::path& library, unsigned seed) {
  // A name without a slash would be looked for among the system's libraries.
  library_ = ::dlopen(std::filesystem::absolute(library).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr) throw UserError(fmt::format("circuit {}", excerpt(::dlerror(), 300)));
  using Entry = decltype(&parallax_get_circuit);
  const auto entry = reinterpret_cast<Entry>(::dlsym(library_, "parallax_get_circuit"));
  if (entry == nullptr) {
    throw UserError(fmt::format("{} is no circuit: it has no function parallax_get_circuit (circuit.h)",
                                excerpt(library.string(), 300)));
  }
  entry_ = entry();
  if (entry_->version != PARALLAX_CIRCUIT_VERSION) {
    throw UserError(fmt::format("{}: a circuit of version {}, this program takes version {}; build it again",
                                excerpt(library.string(), 300), entry_->version,
                                static_cast<int>(PARALLAX_CIRCUIT_VERSION)));
  }
  circuit_ = entry_->make(seed);
  unsigned number = 0;
  const parallax_pin* const pins = entry_->pins(circuit_, &number);
  list_ = {entry_->name, {pins, pins + number}};
}

// The library stays: what it has registered with the process may be asked for when that ends.
Circuit::~Circuit() {
  if (circuit_ != nullptr) entry_->destroy(circuit_);
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstring>

#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr unsigned kWordBits = 64;

}  // namespace

std::size_t pin_bytes(const parallax_pin& pin) {
  for (const unsigned bits : {8u, 16u, 32u, 64u}) {
    if (pin.width <= bits) return bits / 8;
  }
  return (pin.width + 31) / 32 * 4;
}

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
  pins_.assign(pins, pins + number);
}

// The library stays: what it has registered with the process may be asked for when that ends.
Circuit::~Circuit() {
  if (circuit_ != nullptr) entry_->destroy(circuit_);
}

void set_pin(const parallax_pin& pin, std::uint64_t value) {
  if (pin.width < kWordBits) value &= (std::uint64_t{1} << pin.width) - 1;
  const std::size_t bytes = pin_bytes(pin);
  std::memset(pin.at, 0, bytes);
  std::memcpy(pin.at, &value, std::min(bytes, sizeof value));
}

void set_pin(const parallax_pin& pin, const std::vector<std::uint64_t>& words) {
  const std::size_t bytes = pin_bytes(pin);
  std::memcpy(pin.at, words.data(), std::min(bytes, words.size() * sizeof words[0]));
}

bool is_set(const parallax_pin& pin) {
  std::uint64_t value = 0;
  std::memcpy(&value, pin.at, std::min(pin_bytes(pin), sizeof value));
  return value != 0;
}

void read_pin(const parallax_pin& pin, std::vector<std::uint64_t>& words) {
  words.assign((pin.width + kWordBits - 1) / kWordBits, 0);
  std::memcpy(words.data(), pin.at, pin_bytes(pin));
}

}  // namespace parallax

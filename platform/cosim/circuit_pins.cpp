// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_pins.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include "platform/config/nearest_name.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

using Names = std::vector<std::string>;

// What a circuit may call a pin of this kind at a port; "" is the port's name alone.
const Names& endings(const std::string& role) {
  static const std::map<std::string, Names> all{
      {"data", {"data", "tdata", ""}},
      {"valid", {"valid", "tvalid", "vld", "en"}},
      {"ready", {"ready", "tready", "rdy"}},
      {"first", {"first", "sof", "tuser", "user"}},
      {"last", {"last", "eol", "tlast"}},
      {"keep", {"keep", "tkeep", "tstrb"}},
      {"row", {"row", "y"}},
      {"column", {"column", "col", "x"}},
      {"group", {"group", "iteration"}},
  };
  return all.at(role);
}

const Names kClocks{"clk", "clock", "aclk", "clk_i", "i_clk", "ap_clk", "sysclk"};
const Names kResets{"rst", "reset", "rst_i", "i_rst", "reset_i", "areset", "ap_rst", "arst"};
const Names kLowResets{"rst_n", "reset_n", "rstn",   "resetn",  "aresetn", "rst_ni",
                       "nrst",  "nreset",  "arst_n", "i_rst_n", "ap_rst_n"};
const Names kEnables{"ce", "clken", "clk_en", "clock_enable", "aclken", "en", "enable", "clk_ena"};

class Finder {
 public:
  Finder(const Circuit& circuit, const VectorManifest& stage, const CircuitOptions& options)
      : circuit_(circuit), stage_(stage) {
    for (const std::string& word : options.pins) {
      const std::size_t equals = word.find('=');
      if (equals == std::string::npos || equals == 0 || equals + 1 == word.size()) {
        throw UserError(fmt::format(
            "--circuit-pins: '{}' is not ROLE=PIN, as in_left.data=pixel or clock=clk", excerpt(word)));
      }
      named_[word.substr(0, equals)] = word.substr(equals + 1);
    }
  }

  CircuitPins find(const CircuitOptions& options) {
    CircuitPins pins;
    pins.clock = take("clock", kClocks, true, 1);
    pins.reset = take("reset", kResets, true, 1);
    if (pins.reset == nullptr) {
      pins.reset = take("reset_n", kLowResets, true, 1);
      pins.reset_is_low = pins.reset != nullptr;
    }
    for (const VectorStream& stream : stage_.streams) pins.ports.push_back(port(stream));
    pins.enable = take("enable", kEnables, true, 1);
    for (const std::string& word : options.constants) set_constant(word);
    check_names();
    check_rest();
    return pins;
  }

 private:
  const parallax_pin* pin(const std::string& name) const {
    for (const parallax_pin& each : circuit_.pins()) {
      if (name == each.name) return &each;
    }
    return nullptr;
  }

  Names pin_names() const {
    Names names;
    for (const parallax_pin& each : circuit_.pins()) names.emplace_back(each.name);
    return names;
  }

  // What a port may be called: by its name, and the only one of its direction as buses usually are.
  Names prefixes(const VectorStream& stream) const {
    const auto alone = std::count_if(stage_.streams.begin(), stage_.streams.end(), [&](const auto& other) {
                         return other.is_input == stream.is_input;
                       }) == 1;
    Names all{stream.port, stream.name};
    if (!alone) return all;
    const Names usual =
        stream.is_input ? Names{"in", "s_axis", "s", "i", "din"} : Names{"out", "m_axis", "m", "o", "dout"};
    all.insert(all.end(), usual.begin(), usual.end());
    return all;
  }

  static std::string joined(const std::string& prefix, const std::string& ending) {
    return ending.empty() ? prefix : prefix + "_" + ending;
  }

  // The pin that the user names for a role, or the first of these names that there is; of this direction and
  // width (0: any). nullptr: none.
  const parallax_pin* take(const std::string& role, const Names& names, bool is_input, std::size_t width) {
    roles_.push_back(role);
    const parallax_pin* found = nullptr;
    if (const auto named = named_.find(role); named != named_.end()) {
      found = pin(named->second);
      if (found == nullptr) {
        throw UserError(fmt::format("--circuit-pins {}={}: circuit {} has no such pin; the nearest is {}",
                                    excerpt(role), excerpt(named->second), circuit_.name(),
                                    nearest_name(named->second, pin_names())));
      }
    } else {
      for (std::size_t i = 0; i < names.size() && found == nullptr; ++i) {
        found = pin(names[i]);
        // A name that serves several roles is whatever is not taken yet.
        if (found != nullptr && taken_.count(found) > 0) found = nullptr;
      }
    }
    if (found == nullptr) return nullptr;
    if ((found->is_input != 0) != is_input) {
      throw UserError(fmt::format("circuit {}: pin {} is an {}put; as {} it must be an {}put",
                                  circuit_.name(), found->name, is_input ? "out" : "in", role,
                                  is_input ? "in" : "out"));
    }
    if (width != 0 && found->width != width) {
      throw UserError(fmt::format("circuit {}: pin {} has {} bit{}; as {} it must have {}", circuit_.name(),
                                  found->name, found->width, found->width == 1 ? "" : "s", role, width));
    }
    taken_.insert(found);
    return found;
  }

  const parallax_pin* take_at(const VectorStream& stream, const std::string& role, bool is_input,
                              std::size_t width) {
    Names names;
    for (const std::string& prefix : prefixes(stream)) {
      for (const std::string& ending : endings(role)) names.push_back(joined(prefix, ending));
    }
    if (role == "data" && names.size() > 6)  // the only port of its direction
      names.push_back(stream.is_input ? "data_in" : "data_out");
    return take(stream.port + "." + role, names, is_input, width);
  }

  PortPins port(const VectorStream& stream) {
    PortPins pins;
    pins.port = stream.port;
    pins.is_input = stream.is_input;
    const std::size_t width = stream.shape.format.width().size();
    if (const parallax_pin* const whole = take_at(stream, "data", stream.is_input, width)) {
      pins.data.push_back({{"", 0, width, false}, whole});
    } else {
      pins.data = of_fields(stream);
    }
    pins.valid = take_at(stream, "valid", stream.is_input, 1);
    pins.ready = take_at(stream, "ready", !stream.is_input, 1);
    if (!stream.is_input) return pins;
    pins.first = take_at(stream, "first", true, 1);
    pins.last = take_at(stream, "last", true, 1);
    pins.keep = take_at(stream, "keep", true, 0);
    const TokenShape& shape = stream.shape;
    const bool rows = shape.row_tokens > 0;
    pins.row = counter_at(stream, "row", rows ? static_cast<std::uint64_t>(stage_.height) - 1 : 0);
    pins.column = counter_at(
        stream, "column", (rows ? static_cast<std::uint64_t>(stage_.tile_width) : stream.frame_tokens) - 1);
    pins.group = counter_at(stream, "group", shape.tokens_per_pixel - 1);
    return pins;
  }

  // What is counted on a pin, up to `most`.
  const parallax_pin* counter_at(const VectorStream& stream, const std::string& role, std::uint64_t most) {
    const parallax_pin* const found = take_at(stream, role, true, 0);
    if (found != nullptr && found->width < 64 && most >> found->width != 0) {
      throw UserError(fmt::format("circuit {}: pin {} has {} bit{}; as {}.{} it must hold {}",
                                  circuit_.name(), found->name, found->width, found->width == 1 ? "" : "s",
                                  stream.port, role, most));
    }
    return found;
  }

  std::vector<PortPins::Data> of_fields(const VectorStream& stream) {
    std::vector<PortPins::Data> all;
    const auto& fields = stream.shape.format.all();
    for (const TokenField& field : fields) {
      Names names;
      for (const std::string& prefix : prefixes(stream)) names.push_back(prefix + "_" + field.name);
      const parallax_pin* const found =
          take(stream.port + "." + field.name, names, stream.is_input, field.width);
      if (found == nullptr) break;
      all.push_back({field, found});
    }
    if (all.size() == fields.size()) return all;
    throw UserError(fmt::format(
        "circuit {} has no pin for the {} {} of {} ({} bits), such as {}_data; it has {}: --circuit-pins "
        "{}.data=PIN names it",
        circuit_.name(), stream.is_input ? "input" : "output", stream.port, stage_.stage,
        stream.shape.format.width().count(), stream.port,
        excerpt(fmt::format("{}", fmt::join(pin_names(), ", ")), 400), stream.port));
  }

  void set_constant(const std::string& word) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    std::string digits = equals == std::string::npos ? "" : word.substr(equals + 1);
    const int base = digits.rfind("0x", 0) == 0 ? 16 : 10;
    if (base == 16) digits.erase(0, 2);
    std::uint64_t value = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
    if (name.empty() || digits.empty() || read.ec != std::errc() ||
        read.ptr != digits.data() + digits.size()) {
      throw UserError(
          fmt::format("--circuit-set: '{}' is not PIN=VALUE, decimal or 0x, as threshold=12", excerpt(word)));
    }
    const parallax_pin* const found = pin(name);
    if (found == nullptr || found->is_input == 0) {
      throw UserError(fmt::format("--circuit-set {}: circuit {} has no such input; the nearest pin is {}",
                                  excerpt(word), circuit_.name(), nearest_name(name, pin_names())));
    }
    if (found->width < 64 && value >> found->width != 0) {
      throw UserError(fmt::format("--circuit-set {}: pin {} has {} bits, which do not hold it", excerpt(word),
                                  found->name, found->width));
    }
    taken_.insert(found);
    set_pin(*found, value);
  }

  void check_names() const {
    for (const auto& [role, name] : named_) {
      if (std::find(roles_.begin(), roles_.end(), role) == roles_.end()) {
        throw UserError(fmt::format("--circuit-pins {}={}: {} has no such role; the nearest is {}",
                                    excerpt(role), excerpt(name), stage_.stage, nearest_name(role, roles_)));
      }
    }
  }

  // An input that nobody drives would be 0 for ever, and the user would not know.
  void check_rest() const {
    for (const parallax_pin& each : circuit_.pins()) {
      if (each.is_input == 0 || taken_.count(&each) > 0) continue;
      throw UserError(fmt::format(
          "circuit {}: nothing drives the input {} of {} bit{}; --circuit-pins ROLE={} says what it is, "
          "--circuit-set {}=VALUE what it is to be",
          circuit_.name(), each.name, each.width, each.width == 1 ? "" : "s", each.name, each.name));
    }
  }

  const Circuit& circuit_;
  const VectorManifest& stage_;
  std::map<std::string, std::string> named_;  // pins by roles
  std::set<const parallax_pin*> taken_;
  Names roles_;
};

}  // namespace

CircuitPins find_pins(const Circuit& circuit, const VectorManifest& stage, const CircuitOptions& options) {
  CircuitPins pins = Finder(circuit, stage, options).find(options);
  for (const PortPins& port : pins.ports) {
    if (pins.clock == nullptr && (port.valid != nullptr || port.ready != nullptr)) {
      throw UserError(
          fmt::format("circuit {} has no clock, such as clk, but a handshake at {}; --circuit-pins clock=PIN "
                      "names it",
                      circuit.name(), port.port));
    }
  }
  return pins;
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/circuit_pins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

#include "platform/cosim/missing_pins.hpp"
#include "platform/cosim/nearest_or_all.hpp"
#include "platform/cosim/pin_checks.hpp"
#include "platform/cosim/pin_lookup.hpp"
#include "platform/cosim/pin_names.hpp"
#include "platform/cosim/signal_bits.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

using Names = PinNames;

class Finder {
 public:
  Finder(const PinList& circuit, const VectorManifest& stage, const CircuitOptions& options)
      : circuit_(circuit), stage_(stage), lookup_(circuit) {
    for (const std::string& word : options.pins) {
      const std::size_t equals = word.find('=');
      if (equals == std::string::npos || equals == 0) {
        throw UserError(fmt::format(
            "--circuit-pins: '{}' is not ROLE=PIN, as in_left.data=pixel or clock=clk", excerpt(word)));
      }
      const std::string role = full_role(word.substr(0, equals));
      if (!named_.emplace(role, word.substr(equals + 1)).second)
        throw UserError(fmt::format("--circuit-pins: {} is given twice", excerpt(role)));
    }
  }

  CircuitPins find(const CircuitOptions& options) {
    CircuitPins pins;
    // First, so that no pin which the user sets is found to be something else by its name.
    for (const std::string& word : options.constants) set_constant(word);
    if (const PinBits clock = take("clock", clock_names(), true, 1)) {
      if (clock.pin().width != 1) throw wrong_width(clock, "clock", 1);
      pins.clock = &clock.pin();
    }
    pins.reset = take("reset", reset_names(), true, 1);
    if (!pins.reset) {
      pins.reset = take("reset_n", low_reset_names(), true, 1);
      pins.reset_is_low = static_cast<bool>(pins.reset);
    }
    for (const VectorStream& stream : stage_.streams) pins.ports.push_back(port(stream));
    for (const bool is_input : {true, false}) share(pins.ports, is_input);
    pins.enable = take("enable", enable_names(), true, 1);
    check_names();
    check_missing(circuit_.name, stage_.stage, missing_, lookup_);
    return pins;
  }

 private:
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

  // A port and what a pin is there may be called as the circuit calls them: "in.vld" is in_left.valid where
  // that is the only input.
  std::string full_role(const std::string& role) const {
    const std::size_t dot = role.find('.');
    if (dot == std::string::npos) return role;
    const std::string port = role.substr(0, dot);
    std::string kind = role.substr(dot + 1);
    const auto is_in = [](const Names& names, const std::string& name) {
      return !name.empty() && std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const auto& [name, all] : pin_endings()) {
      if (is_in(all, kind)) kind = name;
    }
    for (const VectorStream& stream : stage_.streams) {
      if (is_in(prefixes(stream), port)) return stream.port + "." + kind;
    }
    return role;
  }

  static std::string joined(const std::string& prefix, const std::string& ending) {
    return ending.empty() ? prefix : prefix + "_" + ending;
  }

  static std::string bits_text(const PinBits& bits) {
    return fmt::format("{} bit{}", bits.width(), bits.width() == 1 ? "" : "s");
  }

  UserError wrong_width(const PinBits& bits, const std::string& role, std::size_t width) const {
    return UserError(fmt::format("circuit {}: pin {} has {}; as {} it must have {}{}", circuit_.name,
                                 bits.name(), bits_text(bits), role, width, equal_fields(bits, role)));
  }

  // Of a token of several equal fields, which a circuit may have padded or in another order.
  std::string equal_fields(const PinBits& bits, const std::string& role) const {
    for (const VectorStream& stream : stage_.streams) {
      const std::vector<TokenField>& fields = stream.shape.format.all();
      if (role != stream.port + ".data" || fields.size() < 2) continue;
      const std::size_t width = fields[0].width;
      if (std::any_of(fields.begin(), fields.end(),
                      [width](const TokenField& field) { return field.width != width; }))
        continue;
      const std::size_t apart = std::max(bits.width() / fields.size(), width);
      return fmt::format(
          ": {} x {}, {} lowest; fields that lie otherwise: --circuit-pins {}.{}={}[{}:{}] ...",
          fields.size(), width, fields[0].name, stream.port, fields[1].name, bits.pin().name,
          bits.low() + apart + width - 1, bits.low() + apart);
    }
    return {};
  }

  // Whether the user says that no pin has this role.
  bool is_given_up(const std::string& role) const {
    const auto named = named_.find(role);
    return named != named_.end() && named->second.empty();
  }

  // The pin that the user names for a role, or the first of these names that there is; of this direction and
  // width (0: any). None: there is none.
  PinBits take(const std::string& role, const Names& names, bool is_input, std::size_t width) {
    roles_.push_back(role);
    PinBits found;
    if (is_given_up(role)) return found;
    if (const auto named = named_.find(role); named != named_.end()) {
      found = lookup_.named(named->second, fmt::format("--circuit-pins {}={}", role, excerpt(named->second)));
    } else if (const parallax_pin* const pin = lookup_.find(names)) {
      found = PinBits(*pin);
    }
    if (!found) return found;
    if ((found.pin().is_input != 0) != is_input) {
      throw UserError(fmt::format("circuit {}: pin {} is an {}put; as {} it must be an {}put", circuit_.name,
                                  found.pin().name, is_input ? "out" : "in", role, is_input ? "in" : "out"));
    }
    lookup_.take(found, role);
    if (width == 0 || found.width() == width) return found;
    if (found.width() != found.pin().width || !is_padded_tdata(found.pin().name, found.width(), width))
      throw wrong_width(found, role, width);
    return PinBits(found.pin(), 0, width);
  }

  Names names_at(const VectorStream& stream, const std::string& role) const {
    Names names;
    for (const std::string& prefix : prefixes(stream)) {
      for (const std::string& ending : pin_endings().at(role)) names.push_back(joined(prefix, ending));
    }
    return names;
  }

  PinBits take_at(const VectorStream& stream, const std::string& role, bool is_input, std::size_t width) {
    Names names = names_at(stream, role);
    if (role == "data" && names.size() > 6)  // the only port of its direction
      names.push_back(stream.is_input ? "data_in" : "data_out");
    return take(stream.port + "." + role, names, is_input, width);
  }

  // Whether the user says where fields of a token lie, and not where all of it does.
  bool names_fields(const VectorStream& stream) const {
    const auto names = [&](const std::string& field) { return named_.count(stream.port + "." + field) > 0; };
    const std::vector<TokenField>& fields = stream.shape.format.all();
    return !names("data") && std::any_of(fields.begin(), fields.end(),
                                         [&](const TokenField& field) { return names(field.name); });
  }

  PortPins port(const VectorStream& stream) {
    PortPins pins;
    pins.port = stream.port;
    pins.is_input = stream.is_input;
    const std::size_t width = stream.shape.format.width().size();
    if (names_fields(stream)) {
      roles_.push_back(stream.port + ".data");
      pins.data = of_fields(stream);
    } else if (const PinBits whole = take_at(stream, "data", stream.is_input, width)) {
      pins.data.push_back({{"", 0, width, false}, whole});
    } else {
      pins.data = of_fields(stream);
    }
    pins.valid = take_at(stream, "valid", stream.is_input, 1);
    pins.ready = take_at(stream, "ready", !stream.is_input, 1);
    if (!stream.is_input) {
      pins.first = mark_at(stream, "first");
      pins.last = mark_at(stream, "last");
      return pins;
    }
    pins.first = take_at(stream, "first", true, 1);
    pins.last = take_at(stream, "last", true, 1);
    pins.keep = take_at(stream, "keep", true, 0);
    pins.row = counter_at(stream, "row");
    pins.column = counter_at(stream, "column");
    pins.group = counter_at(stream, "group");
    pins.line_valid = take_at(stream, "line_valid", true, 1);
    pins.frame_valid = take_at(stream, "frame_valid", true, 1);
    return pins;
  }

  // What is beside an output's data. Nothing needs it: a pin of such a name that is something else is left.
  PinBits mark_at(const VectorStream& stream, const std::string& role) {
    if (named_.count(stream.port + "." + role) > 0) return take_at(stream, role, false, 1);
    roles_.push_back(stream.port + "." + role);
    return mark_of(lookup_.find(names_at(stream, role), false), roles_.back());
  }

  // A tuser may be wider: its lowest bit is the start of frame.
  PinBits mark_of(const parallax_pin* pin, const std::string& role) {
    if (pin == nullptr || (pin->width > 1 && !ends_with(pin->name, "user"))) return {};
    const PinBits mark(*pin, 0, 1);
    lookup_.take(mark, role);
    return mark;
  }

  // The largest number that stands on the pin.
  std::uint64_t most_on(const VectorStream& stream, const std::string& role) const {
    const TokenShape& shape = stream.shape;
    const bool rows = shape.row_tokens > 0;
    if (!rows && stream.frame_tokens == 0) return 0;  // not known before the model has run
    if (role == "group") return shape.tokens_per_pixel - 1;
    if (role == "row") return rows ? static_cast<std::uint64_t>(stage_.height) - 1 : 0;
    return (rows ? static_cast<std::uint64_t>(stage_.tile_width) : stream.frame_tokens) - 1;
  }

  void check_counter(const PinBits& bits, const VectorStream& stream, const std::string& role) const {
    const std::uint64_t most = most_on(stream, role);
    if (!bits || bits.width() >= 64 || most >> bits.width() == 0) return;
    throw UserError(fmt::format("circuit {}: pin {} has {}; as {}.{} it must hold {}", circuit_.name,
                                bits.name(), bits_text(bits), stream.port, role, most));
  }

  PinBits counter_at(const VectorStream& stream, const std::string& role) {
    const PinBits found = take_at(stream, role, true, 0);
    check_counter(found, stream, role);
    return found;
  }

  // One pin for all ports of a direction, where none has one of its own. What stands beside the data is
  // shared only where tokens pass together, so that it is of all of them.
  void share(std::vector<PortPins>& ports, bool is_input) {
    const auto share_one = [&](const char* role, PinBits PortPins::*of, bool pin_is_input) {
      const bool any = std::any_of(ports.begin(), ports.end(), [&](const PortPins& port) {
        return port.is_input == is_input && static_cast<bool>(port.*of);
      });
      if (any) return;
      const SharedNames& names = shared_names(role);
      const parallax_pin* const pin =
          lookup_.find(is_input ? names.of_inputs : names.of_outputs, pin_is_input);
      const bool counts = of == &PortPins::row || of == &PortPins::column;
      if (pin == nullptr || (!counts && pin->width != 1)) return;
      for (std::size_t i = 0; i < ports.size(); ++i) {
        if (ports[i].is_input != is_input || is_given_up(ports[i].port + "." + role)) continue;
        ports[i].*of = PinBits(*pin);
        if (counts) check_counter(ports[i].*of, stage_.streams[i], role);
        lookup_.take(PinBits(*pin), ports[i].port + "." + role);
      }
    };
    share_one("valid", &PortPins::valid, is_input);
    share_one("ready", &PortPins::ready, !is_input);
    if (!pass_together(ports, is_input)) return;
    share_one("first", &PortPins::first, is_input);
    share_one("last", &PortPins::last, is_input);
    if (!is_input) return;
    share_one("line_valid", &PortPins::line_valid, true);
    share_one("frame_valid", &PortPins::frame_valid, true);
    share_one("row", &PortPins::row, true);
    share_one("column", &PortPins::column, true);
  }

  // Whether tokens pass at all ports of a direction in the same cycle: there is one, they share a handshake,
  // or have none.
  static bool pass_together(const std::vector<PortPins>& ports, bool is_input) {
    const PortPins* first = nullptr;
    for (const PortPins& port : ports) {
      if (port.is_input != is_input) continue;
      if (first == nullptr) first = &port;
      const bool without = !first->valid && !first->ready && !port.valid && !port.ready;
      if (first != &port && !without && !first->joined_with(port)) return false;
    }
    return true;
  }

  std::vector<PortPins::Data> of_fields(const VectorStream& stream) {
    std::vector<PortPins::Data> all;
    std::vector<MissingPin> without;
    const auto& fields = stream.shape.format.all();
    for (const TokenField& field : fields) {
      Names names;
      for (const std::string& prefix : prefixes(stream)) names.push_back(prefix + "_" + field.name);
      const PinBits found = take(stream.port + "." + field.name, names, stream.is_input, field.width);
      if (found) {
        all.push_back({field, found});
      } else {
        without.push_back({stream.port + "." + field.name, field.width, stream.is_input});
      }
    }
    if (all.empty()) {
      missing_.push_back({stream.port + ".data", stream.shape.format.width().size(), stream.is_input});
    } else {
      missing_.insert(missing_.end(), without.begin(), without.end());
    }
    return all;
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
    const PinBits found = lookup_.named(name, "--circuit-set " + excerpt(word));
    if (found.pin().is_input == 0) {
      throw UserError(fmt::format("--circuit-set {}: pin {} of circuit {} is an output", excerpt(word),
                                  found.pin().name, circuit_.name));
    }
    if (found.width() < 64 && value >> found.width() != 0) {
      throw UserError(fmt::format("--circuit-set {}: pin {} has {}, which do not hold it", excerpt(word),
                                  name, bits_text(found)));
    }
    lookup_.take(found, "--circuit-set " + excerpt(word));
    found.set(value);
  }

  void check_names() const {
    for (const auto& [role, name] : named_) {
      if (std::find(roles_.begin(), roles_.end(), role) == roles_.end()) {
        throw UserError(fmt::format("--circuit-pins {}={}: {} has no such role; {}", excerpt(role),
                                    excerpt(name), stage_.stage, nearest_or_all(role, roles_)));
      }
    }
  }

  const PinList& circuit_;
  const VectorManifest& stage_;
  PinLookup lookup_;
  std::vector<MissingPin> missing_;
  std::map<std::string, std::string> named_;  // pins by roles
  Names roles_;
};

}  // namespace

CircuitPins find_pins(const PinList& circuit, const VectorManifest& stage, const CircuitOptions& options) {
  CircuitPins pins = Finder(circuit, stage, options).find(options);
  check_pins(circuit, pins, stage, options);
  return pins;
}

}  // namespace parallax

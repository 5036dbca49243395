// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/vcd_waves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>
#include <unordered_map>

namespace parallax {
namespace {

constexpr const char* kBlanks = " \t\r\n";

bool is_named(const std::string& full, const std::string& name) {
  if (full == name) return true;
  return full.size() > name.size() + 1 && full[full.size() - name.size() - 1] == '.' &&
         full.compare(full.size() - name.size(), name.size(), name) == 0;
}

// "[15:0]", "[0:15]", "[3]"; where there is none, or one that is not as wide, the lowest bit is bit 0.
void read_range(const std::string& text, VcdWaves::Signal& signal) {
  std::size_t left = 0, right = 0;
  const char* const end = text.data() + text.size();
  if (text.empty() || text.front() != '[') return;
  auto read = std::from_chars(text.data() + 1, end, left);
  right = left;
  if (read.ec == std::errc() && read.ptr != end && *read.ptr == ':')
    read = std::from_chars(read.ptr + 1, end, right);
  if (read.ec != std::errc() || read.ptr == end || *read.ptr != ']') return;
  if (std::max(left, right) - std::min(left, right) + 1 != signal.width) return;
  signal.left = left;
  signal.right = right;
}

}  // namespace

VcdWaves::VcdWaves(const std::string& text, const std::string& path) : text_(text), path_(path) {
  read_head();
}

const VcdWaves::Signal* VcdWaves::find(const std::string& name) const {
  const auto depth = [](const Signal& signal) {
    return std::count(signal.name.begin(), signal.name.end(), '.');
  };
  const Signal *best = nullptr, *other = nullptr;
  for (const Signal& signal : signals_) {
    if (!is_named(signal.name, name)) continue;
    if (best == nullptr || depth(signal) < depth(*best)) {
      best = &signal;
      other = nullptr;
    } else if (depth(signal) == depth(*best) && signal.ids != best->ids) {
      other = &signal;
    }
  }
  if (other != nullptr) {
    throw UserError(fmt::format("{}: {} may be {} or {}: say so much of the name that it is one", path_, name,
                                best->name, other->name));
  }
  return best;
}

UserError VcdWaves::fault(const std::string& what) const {
  const auto line = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n') + 1;
  return UserError(fmt::format("{}, line {}: {}", path_, line, what));
}

std::string_view VcdWaves::next() {
  const std::size_t begin = text_.find_first_not_of(kBlanks, at_);
  if (begin == std::string_view::npos) {
    at_ = text_.size();
    return {};
  }
  at_ = std::min(text_.find_first_of(kBlanks, begin), text_.size());
  return text_.substr(begin, at_ - begin);
}

void VcdWaves::skip_to_end() {
  for (std::string_view word = next(); word != "$end"; word = next()) {
    if (word.empty()) throw fault("the file ends within a command, without $end");
  }
}

void VcdWaves::read_head() {
  std::vector<std::string> scopes;
  for (;;) {
    const std::string_view word = next();
    if (word.empty()) throw fault("the file ends before $enddefinitions");
    if (word == "$enddefinitions") {
      skip_to_end();
      return join_bits();
    }
    if (word == "$scope") {
      next();  // its kind
      scopes.emplace_back(next());
      skip_to_end();
    } else if (word == "$upscope") {
      if (!scopes.empty()) scopes.pop_back();
      skip_to_end();
    } else if (word == "$var") {
      read_variable(scopes);
    } else if (word.front() == '$') {
      skip_to_end();
    } else {
      throw fault(fmt::format("'{}' where a command such as $var is expected", excerpt(word)));
    }
  }
}

void VcdWaves::read_variable(const std::vector<std::string>& scopes) {
  if (next() == "port")
    throw fault("an extended VCD of $dumpports, which is not read; $dumpvars makes a VCD");
  const std::string width(next());
  const std::string id(next());
  const std::string name(next());
  std::string_view more = next();
  const bool is_number = !width.empty() && width.size() < 8 &&
                         std::all_of(width.begin(), width.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!is_number || name.empty()) throw fault("a $var without width, identifier and name");
  std::string full;
  for (const std::string& scope : scopes) full += scope + ".";
  Signal signal{full, {id}, std::stoul(width)};
  // Some write the range behind the name without a blank.
  std::string range(more.substr(0, more.find(']') + 1));
  const std::size_t bracket = name.find('[');
  if (bracket != std::string::npos) range = name.substr(bracket);
  signal.name += name.substr(0, bracket);
  signal.left = std::max<std::size_t>(signal.width, 1) - 1;
  read_range(range, signal);
  signals_.push_back(std::move(signal));
  while (more != "$end") {
    if (more.empty()) throw fault("the file ends within a command, without $end");
    more = next();
  }
}

// Some simulators write the bits of a bus as signals of one bit, "data [3]", one behind the other.
void VcdWaves::join_bits() {
  std::map<std::string, std::map<std::size_t, std::string>> buses;  // bits by their index
  for (const Signal& signal : signals_) {
    if (signal.width == 1) buses[signal.name].emplace(signal.left, signal.ids.front());
  }
  const auto bits_of = [&](const Signal& signal) -> const std::map<std::size_t, std::string>* {
    const auto bus = buses.find(signal.name);
    if (signal.width != 1 || bus == buses.end() || bus->second.size() < 2) return nullptr;
    const auto& bits = bus->second;
    return bits.rbegin()->first - bits.begin()->first + 1 == bits.size() ? &bits : nullptr;
  };
  std::vector<Signal> joined;
  for (Signal& signal : signals_) {
    const auto* const bits = bits_of(signal);
    if (bits == nullptr) {
      joined.push_back(std::move(signal));
    } else if (signal.left == bits->rbegin()->first) {
      Signal bus{signal.name, {}, bits->size(), bits->rbegin()->first, bits->begin()->first};
      for (auto bit = bits->rbegin(); bit != bits->rend(); ++bit) bus.ids.push_back(bit->second);
      joined.push_back(std::move(bus));
    }
  }
  signals_ = std::move(joined);
}

std::int64_t VcdWaves::time_of(std::string_view word) const {
  std::int64_t time = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data() + 1, end, time);
  if (error != std::errc() || stop != end) throw fault(fmt::format("'{}' is no date", excerpt(word)));
  return time;
}

void VcdWaves::read(const std::vector<const Signal*>& watched,
                    const std::function<void(std::int64_t, const Changes&)>& at_date) {
  struct WatchedBits {
    std::size_t of = 0;   // signal of those watched
    std::size_t bit = 0;  // the highest is 0; of a signal that has one identifier: all of it
  };
  std::unordered_map<std::string_view, std::vector<WatchedBits>>
      parts;  // of each identifier, which several share
  for (const Signal& signal : signals_) {
    for (const std::string& id : signal.ids) parts[id];
  }
  std::vector<std::string> values(watched.size());
  for (std::size_t i = 0; i < watched.size(); ++i) {
    const std::vector<std::string>& ids = watched[i]->ids;
    if (ids.size() > 1) values[i].assign(ids.size(), 'x');
    for (std::size_t bit = 0; bit < ids.size(); ++bit) parts[ids[bit]].push_back({i, bit});
  }
  bool any = false;
  Changes changes(watched.size());
  const auto change = [&](std::string_view id, std::string_view value) {
    const auto found = parts.find(id);
    if (found == parts.end()) throw fault(fmt::format("'{}' is no signal's identifier", excerpt(id)));
    for (const WatchedBits& part : found->second) {
      std::string& digits = values[part.of];
      if (watched[part.of]->ids.size() > 1) {
        digits[part.bit] = value.empty() ? 'x' : value.back();
      } else {
        digits = value;
      }
      changes[part.of] = &digits;
      any = true;
    }
  };
  std::int64_t now = std::numeric_limits<std::int64_t>::min();
  const auto commit = [&] {
    if (!any) return;
    at_date(now, changes);
    std::fill(changes.begin(), changes.end(), nullptr);
    any = false;
  };
  for (std::string_view word = next(); !word.empty(); word = next()) {
    switch (word.front()) {
      case '#': {
        commit();
        const std::int64_t time = time_of(word);
        if (time < now) throw fault(fmt::format("date {} is before {}", time, now));
        now = time;
        break;
      }
      case '$':  // $dumpvars and the like, whose values stand between
        if (word == "$comment") skip_to_end();
        break;
      case 'b':
      case 'B': {
        const std::string_view id = next();
        if (id.empty()) throw fault("the file ends within a value");
        change(id, word.substr(1));
        break;
      }
      case 'r':
      case 'R':
      case 's':
      case 'S':
        next();
        break;
      default: {
        const std::string_view id = word.substr(1);
        if (id.empty()) throw fault(fmt::format("'{}' is no change of a value", excerpt(word)));
        change(id, word.substr(0, 1));
      }
    }
  }
  commit();
}

}  // namespace parallax

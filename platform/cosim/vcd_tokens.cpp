// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/vcd_tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "platform/config/nearest_name.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

struct Signal {
  std::string name;  ///< with its scopes, "bench.dut.out_left_data"
  std::string id;
  std::size_t width = 0;
};

// Words separated by blanks, and where they stand.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  /// Empty at the end.
  std::string_view next() {
    const std::size_t begin = text_.find_first_not_of(" \t\r\n", at_);
    if (begin == std::string_view::npos) {
      at_ = text_.size();
      return {};
    }
    at_ = std::min(text_.find_first_of(" \t\r\n", begin), text_.size());
    return text_.substr(begin, at_ - begin);
  }
  std::size_t line() const {
    return static_cast<std::size_t>(
               std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n')) +
           1;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

class VcdReader {
 public:
  VcdReader(const std::string& text, const std::string& path, const VectorStream& stream,
            const DumpSignals& wanted)
      : scanner_(text), path_(path), stream_(stream), wanted_(wanted) {}

  Dump read() {
    read_head();
    data_ = find("data", wanted_.data, names("_data"), true);
    valid_ = find("valid", wanted_.valid, names("_valid"), true);
    ready_ = find("ready", wanted_.ready, names("_ready"), false);
    clock_ = find("clock", wanted_.clock, {"clk", "clock", "aclk"}, true);
    const std::size_t width = stream_.shape.format.width().size();
    if (data_->width != width) {
      throw UserError(fmt::format("{}: {} has {} bits, {} has {}", path_, data_->name, data_->width,
                                  stream_.name, width));
    }
    Dump dump{TokenWords(width), {}};
    read_waves(dump);
    return dump;
  }

 private:
  UserError fault(const std::string& what) const {
    return UserError(fmt::format("{}, line {}: {}", path_, scanner_.line(), what));
  }

  std::vector<std::string> names(const char* ending) const {
    std::vector<std::string> all{stream_.port + ending, stream_.name + ending};
    if (std::string_view(ending) == "_data") {
      all.push_back(stream_.port);
      all.push_back(stream_.name);
    }
    return all;
  }

  void skip_to_end() {
    for (std::string_view word = scanner_.next(); word != "$end"; word = scanner_.next()) {
      if (word.empty()) throw fault("the file ends within a command, without $end");
    }
  }

  void read_head() {
    std::vector<std::string> scopes;
    for (;;) {
      const std::string_view word = scanner_.next();
      if (word.empty()) throw fault("the file ends before $enddefinitions");
      if (word == "$enddefinitions") return skip_to_end();
      if (word == "$scope") {
        scanner_.next();  // its kind
        scopes.emplace_back(scanner_.next());
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

  void read_variable(const std::vector<std::string>& scopes) {
    scanner_.next();  // its kind
    const std::string width(scanner_.next());
    const std::string id(scanner_.next());
    const std::string name(scanner_.next());
    const bool is_number =
        !width.empty() && width.size() < 8 &&
        std::all_of(width.begin(), width.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!is_number || name.empty()) throw fault("a $var without width, identifier and name");
    std::string full;
    for (const std::string& scope : scopes) full += scope + ".";
    // Some write the range behind the name without a blank.
    signals_.push_back({full + name.substr(0, name.find('[')), id, std::stoul(width)});
    skip_to_end();
  }

  static bool ends_with(const std::string& name, const std::string& wanted) {
    if (name == wanted) return true;
    return name.size() > wanted.size() + 1 && name[name.size() - wanted.size() - 1] == '.' &&
           name.compare(name.size() - wanted.size(), wanted.size(), wanted) == 0;
  }

  // Of several of a name the outermost one, which comes first of those as deep.
  const Signal* find(const char* what, const std::string& asked, std::vector<std::string> candidates,
                     bool needed) const {
    if (!asked.empty()) candidates = {asked};
    const auto depth = [](const Signal& signal) {
      return std::count(signal.name.begin(), signal.name.end(), '.');
    };
    for (const std::string& name : candidates) {
      const Signal* best = nullptr;
      for (const Signal& signal : signals_) {
        if (ends_with(signal.name, name) && (best == nullptr || depth(signal) < depth(*best))) best = &signal;
      }
      if (best != nullptr) return best;
    }
    if (!needed && asked.empty()) return nullptr;
    std::vector<std::string> all;
    for (const Signal& signal : signals_) all.push_back(signal.name);
    if (all.empty()) throw UserError(fmt::format("{}: no signals in this VCD", path_));
    throw UserError(fmt::format(
        "{}: no signal {} for {} of {}; the nearest is {}; --signals {}=NAME names another one", path_,
        candidates.front(), what, stream_.name, nearest_name(candidates.front(), all), what));
  }

  // What one date changes is there after it: an edge of the clock sees what was there before.
  void read_waves(Dump& dump) {
    std::unordered_map<std::string_view, std::string> changes;
    std::string data, valid, ready, clock;
    std::int64_t cycle = 0;
    const auto commit = [&] {
      const auto changed = [&](const Signal* signal) -> const std::string* {
        if (signal == nullptr) return nullptr;
        const auto found = changes.find(signal->id);
        return found == changes.end() ? nullptr : &found->second;
      };
      const std::string* const edge = changed(clock_);
      if (edge != nullptr && *edge == "1" && clock == "0") {
        if (valid == "1" && (ready_ == nullptr || ready == "1")) {
          if (const std::string wrong = dump.words.append_binary(data); !wrong.empty()) throw fault(wrong);
          dump.cycles.push_back(cycle);
        }
        ++cycle;
      }
      if (edge != nullptr) clock = *edge;
      if (const std::string* const value = changed(data_)) data = *value;
      if (const std::string* const value = changed(valid_)) valid = *value;
      if (const std::string* const value = changed(ready_)) ready = *value;
      changes.clear();
    };
    const auto is_ours = [&](std::string_view id) {
      return id == data_->id || id == valid_->id || id == clock_->id ||
             (ready_ != nullptr && id == ready_->id);
    };
    for (std::string_view word = scanner_.next(); !word.empty(); word = scanner_.next()) {
      switch (word.front()) {
        case '#':
          commit();
          break;
        case '$':  // $dumpvars and the like, whose values stand between
          if (word == "$comment") skip_to_end();
          break;
        case 'b':
        case 'B': {
          const std::string_view id = scanner_.next();
          if (id.empty()) throw fault("the file ends within a value");
          if (is_ours(id)) changes[id] = std::string(word.substr(1));
          break;
        }
        case 'r':
        case 'R':
        case 's':
        case 'S':
          scanner_.next();
          break;
        default: {
          const std::string_view id = word.substr(1);
          if (id.empty()) throw fault(fmt::format("'{}' is no change of a value", excerpt(word)));
          if (is_ours(id)) changes[id] = std::string(word.substr(0, 1));
        }
      }
    }
    commit();
  }

  Scanner scanner_;
  const std::string& path_;
  const VectorStream& stream_;
  const DumpSignals& wanted_;
  std::vector<Signal> signals_;
  const Signal* data_ = nullptr;
  const Signal* valid_ = nullptr;
  const Signal* ready_ = nullptr;
  const Signal* clock_ = nullptr;
};

}  // namespace

Dump tokens_of_vcd(const std::string& text, const std::string& path, const VectorStream& stream,
                   const DumpSignals& signals) {
  return VcdReader(text, path, stream, signals).read();
}

}  // namespace parallax

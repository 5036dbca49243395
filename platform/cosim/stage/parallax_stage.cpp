// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/stage/parallax_stage.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "platform/cosim/stage/stage_process.hpp"

namespace parallax {
namespace {

using Words = std::vector<std::uint32_t>;

// Tokens that are sent together; the more, the fewer switches between the two programs.
constexpr std::size_t kSendBytes = 1u << 14;
// A circuit that is ahead of the model's rows has it asked after 1, 2, 4, ... tokens, and at most so many.
constexpr std::size_t kMostWaiting = 1024;

struct CircuitToken {
  Words bits;
  Words unknown;
};

struct Port {
  std::string name, stream;
  bool is_input = false;
  std::size_t width = 0;                          // bits
  std::uint64_t row_tokens = 0, pass_tokens = 0;  // 0: none
  std::deque<Words> model;                        // that nobody has taken yet
  std::deque<CircuitToken> circuit;               // for which the model has none yet
  std::uint64_t taken = 0;                        // of the model's
  bool is_checked = false;
  std::size_t patience = 1;  // tokens of the circuit, before the model is asked

  std::size_t words() const { return (width + 31) / 32; }
  std::uint32_t mask(std::size_t word) const {
    const std::size_t bits = width - 32 * word;
    return bits >= 32 ? ~std::uint32_t{0} : (std::uint32_t{1} << bits) - 1;
  }
};

void append_hex(std::string& text, const Port& port, const std::uint32_t* words) {
  for (std::size_t digit = (port.width + 3) / 4; digit-- > 0;)
    text += "0123456789abcdef"[words[digit / 8] >> (digit % 8 * 4) & 15u];
}

// As the simulator prints it: x where a bit of the digit is unknown.
std::string hex(const Port& port, const CircuitToken& token) {
  std::string text;
  append_hex(text, port, token.bits.data());
  for (std::size_t digit = 0; digit < text.size(); ++digit) {
    if ((token.unknown[digit / 8] >> (digit % 8 * 4) & 15u) != 0) text[text.size() - 1 - digit] = 'x';
  }
  return text;
}

Words words_of(const Port& port, const std::string& digits) {
  Words words(port.words());
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const char c = digits[digits.size() - 1 - i];
    words.at(i / 8) |= static_cast<std::uint32_t>(c <= '9' ? c - '0' : c - 'a' + 10) << (i % 8 * 4);
  }
  return words;
}

class StageModel {
 public:
  StageModel(const std::string& stage, const std::string& options) {
    guarded([&] { open(stage, options); });
  }

  const std::string& message() const { return message_; }

  // Does it, unless the handle has failed, or does so now.
  template <class Action>
  bool guarded(const Action& action) {
    if (!message_.empty()) return false;
    try {
      action();
    } catch (const std::exception& error) {
      message_ = error.what();
    }
    return message_.empty();
  }

  int width(const std::string& port) { return static_cast<int>(find(port).width); }

  void push(const std::string& name, const std::uint32_t* token) {
    Port& port = find(name);
    if (!port.is_input) throw std::runtime_error(name + " is an output, which takes no token");
    const std::size_t last = port.words() - 1;
    if ((token[last] & ~port.mask(last)) != 0)
      throw std::runtime_error(name + " takes tokens of " + std::to_string(port.width) + " bits");
    // Tokens of one port may share a line.
    if (last_pushed_ != &port) asked_ += '\n' + port.name;
    last_pushed_ = &port;
    asked_ += ' ';
    append_hex(asked_, port, token);
    if (asked_.size() >= kSendBytes) send();
  }

  bool pop(const std::string& name, std::uint32_t* token) {
    Port& port = output(name);
    if (port.model.empty()) ask(port);
    if (port.model.empty()) return false;
    std::copy(port.model.front().begin(), port.model.front().end(), token);
    port.model.pop_front();
    ++port.taken;
    return true;
  }

  void check(const std::string& name, const parallax_logic* token) {
    Port& port = output(name);
    CircuitToken got;
    for (std::size_t word = 0; word < port.words(); ++word) {
      got.bits.push_back(token[word].aval & port.mask(word));
      got.unknown.push_back(token[word].bval & port.mask(word));
    }
    port.is_checked = true;
    port.circuit.push_back(std::move(got));
    if (port.model.empty() && port.circuit.size() >= port.patience) {
      ask(port);
      port.patience = port.model.empty() ? std::min(2 * port.patience, kMostWaiting) : 1;
    }
    compare(port);
  }

  void finish() {
    for (Port& port : ports_) {
      if (!port.is_checked) continue;
      ask(port);
      compare(port);
      if (!port.circuit.empty())
        throw std::runtime_error(port.name + ": the circuit has given " + tokens(port.circuit.size()) +
                                 " more than the model, which has made " + std::to_string(port.taken));
      if (!port.model.empty())
        throw std::runtime_error(port.name + ": the circuit has given " + tokens(port.taken) +
                                 ", the model " + std::to_string(port.model.size()) + " more");
    }
  }

 private:
  static std::string tokens(std::uint64_t number) {
    return std::to_string(number) + (number == 1 ? " token" : " tokens");
  }

  void open(const std::string& stage, const std::string& options) {
    std::vector<std::string> arguments{"stage", stage};
    std::istringstream words(options);
    for (std::string word; words >> word;) arguments.push_back(word);
    process_.start(arguments);
    for (std::string line; line = process_.line(), !line.empty();) {
      std::istringstream fields(line);
      Port port;
      std::string direction;
      if (!(fields >> direction >> port.name >> port.stream >> port.width >> port.row_tokens >>
            port.pass_tokens) ||
          (direction != "in" && direction != "out")) {
        continue;  // a note
      }
      port.is_input = direction == "in";
      if (port.width > 32 * PARALLAX_STAGE_WORDS)
        throw std::runtime_error(port.name + " has tokens of " + std::to_string(port.width) + " bits; " +
                                 std::to_string(32 * PARALLAX_STAGE_WORDS) + " is the most here");
      ports_.push_back(port);
    }
  }

  Port& find(const std::string& name) {
    std::string names;
    for (Port& port : ports_) {
      if (name == port.name || name == port.stream) return port;
      names += (names.empty() ? "" : ", ") + port.name;
    }
    throw std::runtime_error("the stage has no port " + name + ": it has " + names);
  }
  Port& output(const std::string& name) {
    Port& port = find(name);
    if (port.is_input) throw std::runtime_error(name + " is an input, which gives no token");
    return port;
  }

  void send() {
    const std::string lines = asked_ + '\n';
    asked_.clear();
    last_pushed_ = nullptr;
    process_.send(lines);
  }

  void ask(Port& port) {
    asked_ += '\n' + port.name;
    send();
    std::istringstream answer(process_.answer());
    for (std::string digits; answer >> digits;) port.model.push_back(words_of(port, digits));
  }

  static std::string place(const Port& port) {
    std::string text = "token " + std::to_string(port.taken);
    if (port.pass_tokens == 0 || port.row_tokens == 0) return text;
    const std::uint64_t of_pass = port.taken % port.pass_tokens;
    return text + " (pass " + std::to_string(port.taken / port.pass_tokens) + ", row " +
           std::to_string(of_pass / port.row_tokens) + ", token " +
           std::to_string(of_pass % port.row_tokens) + " of the row)";
  }

  void compare(Port& port) {
    while (!port.circuit.empty() && !port.model.empty()) {
      const CircuitToken& got = port.circuit.front();
      const bool is_known =
          std::all_of(got.unknown.begin(), got.unknown.end(), [](std::uint32_t bits) { return bits == 0; });
      if (!is_known || got.bits != port.model.front()) {
        std::string expected;
        append_hex(expected, port, port.model.front().data());
        throw std::runtime_error(port.name + ": the first difference is " + place(port) + ": expected " +
                                 expected + ", got " + hex(port, got));
      }
      port.circuit.pop_front();
      port.model.pop_front();
      ++port.taken;
    }
  }

  StageProcess process_;
  std::vector<Port> ports_;
  std::string asked_;  // lines that are not sent yet, each behind its line's end
  const Port* last_pushed_ = nullptr;
  std::string message_;
};

StageModel& of(void* stage) { return *static_cast<StageModel*>(stage); }

}  // namespace
}  // namespace parallax

using parallax::of;

void* parallax_stage_open(const char* stage, const char* options) {
  try {
    return new parallax::StageModel(stage, options);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

const char* parallax_stage_message(const void* stage) {
  return stage == nullptr ? "there is no handle"
                          : static_cast<const parallax::StageModel*>(stage)->message().c_str();
}

int parallax_stage_width(void* stage, const char* port) {
  int width = 0;
  if (stage != nullptr) of(stage).guarded([&] { width = of(stage).width(port); });
  return width;
}

int parallax_stage_push(void* stage, const char* port, const uint32_t* token) {
  return stage != nullptr && of(stage).guarded([&] { of(stage).push(port, token); }) ? 1 : 0;
}

int parallax_stage_pop(void* stage, const char* port, uint32_t* token) {
  bool there = false;
  if (stage != nullptr) of(stage).guarded([&] { there = of(stage).pop(port, token); });
  return there ? 1 : 0;
}

int parallax_stage_check(void* stage, const char* port, const struct parallax_logic* token) {
  return stage != nullptr && of(stage).guarded([&] { of(stage).check(port, token); }) ? 1 : 0;
}

int parallax_stage_finish(void* stage) {
  return stage != nullptr && of(stage).guarded([&] { of(stage).finish(); }) ? 1 : 0;
}

void parallax_stage_close(void* stage) { delete static_cast<parallax::StageModel*>(stage); }

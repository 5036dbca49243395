// SPDX-License-Identifier: Apache-2.0
// One Verilated circuit with the ports of a stub of parallax vectors, between registered FIFOs whose other
// ends stall at random: every date of every FIFO, and every value that comes out.
#pragma once

#include <fmt/format.h>
#include <verilated.h>

#include <cstdint>
#include <functional>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "tests/timing/graph.hpp"

namespace parallax::test {

/// Tokens as words of 32 bits, lowest first.
using BusWords = std::vector<std::uint32_t>;

/// Lines of hexadecimal digits.
inline std::vector<BusWords> tokens_of(const std::string& memh) {
  std::vector<BusWords> all;
  std::istringstream lines(memh);
  for (std::string line; lines >> line;) {
    BusWords words;
    for (std::size_t end = line.size(); end > 0;) {
      const std::size_t begin = end < 8 ? 0 : end - 8;
      words.push_back(static_cast<std::uint32_t>(std::stoul(line.substr(begin, end - begin), nullptr, 16)));
      end = begin;
    }
    all.push_back(std::move(words));
  }
  return all;
}

template <class Bus>
std::uint32_t word_of(const Bus& bus, std::size_t i) {
  if constexpr (std::is_integral_v<Bus>) {
    return static_cast<std::uint32_t>(std::uint64_t{bus} >> (32 * i));
  } else {
    return bus[i];
  }
}

template <class Bus>
void set_words(Bus& bus, const BusWords& words) {
  if constexpr (std::is_integral_v<Bus>) {
    bus = static_cast<Bus>(words.size() > 1 ? words[0] | std::uint64_t{words[1]} << 32 : words[0]);
  } else {
    for (std::size_t i = 0; i < words.size(); ++i) bus[i] = words[i];
  }
}

/// A port with the FIFO at it. What is written at t can be read at t + 1, a place freed at t can be written
/// at t + 1.
struct CircuitPort {
  std::function<void(const BusWords&)> offer;  ///< of an input
  std::function<bool(const BusWords&)> has;    ///< of an output
  CData* valid = nullptr;
  CData* ready = nullptr;
  std::vector<BusWords> tokens{};       ///< what goes in, or should come out
  std::vector<std::uint32_t> stalls{};  ///< before each token, at the FIFO's other end
  EdgeDates dates{};
  std::int64_t end_ready = 0;  ///< first cycle in which the other end moves a token
};

template <class Bus>
CircuitPort circuit_input(Bus& data, CData& valid, CData& ready) {
  CircuitPort port;
  port.offer = [&data](const BusWords& words) { set_words(data, words); };
  port.valid = &valid;
  port.ready = &ready;
  return port;
}

template <class Bus>
CircuitPort circuit_output(const Bus& data, CData& valid, CData& ready) {
  CircuitPort port;
  port.has = [&data](const BusWords& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (word_of(data, i) != words[i]) return false;
    }
    return true;
  };
  port.valid = &valid;
  port.ready = &ready;
  return port;
}

/// Runs until nothing moves. Returns what is wrong with the values; the dates are in the ports.
template <class Top>
std::string run_circuit(Top& top, std::vector<CircuitPort>& ports, std::uint32_t depth) {
  constexpr std::int64_t kQuiet = 2000;  // longer than any stall, and any way through the circuit
  std::string wrong;
  for (CircuitPort& port : ports) port.end_ready = port.stalls.at(0);
  std::int64_t last_move = 0;
  for (std::int64_t cycle = 0; cycle - last_move < kQuiet; ++cycle) {
    for (CircuitPort& port : ports) {
      const std::size_t held = port.dates.written.size() - port.dates.read.size();
      if (port.offer) {
        *port.valid = held > 0 ? 1 : 0;
        if (held > 0) port.offer(port.tokens[port.dates.read.size()]);
      } else {
        *port.ready = held < depth ? 1 : 0;
      }
    }
    top.clk = 0;
    top.eval();  // what is agreed on before the edge happens at it
    for (CircuitPort& port : ports) {
      std::vector<std::int64_t>& at_end = port.offer ? port.dates.written : port.dates.read;
      std::vector<std::int64_t>& at_circuit = port.offer ? port.dates.read : port.dates.written;
      const std::size_t held = port.dates.written.size() - port.dates.read.size();
      const bool end_can = port.offer ? held < depth : held > 0;
      const bool end_moves = end_can && at_end.size() < port.tokens.size() && cycle >= port.end_ready;
      if (*port.valid && *port.ready) {
        if (!port.offer &&
            (at_circuit.size() >= port.tokens.size() || !port.has(port.tokens[at_circuit.size()]))) {
          if (wrong.empty()) wrong = fmt::format("token {} is wrong\n", at_circuit.size());
        }
        at_circuit.push_back(cycle);
        last_move = cycle;
      }
      if (end_moves) {
        at_end.push_back(cycle);
        if (at_end.size() < port.tokens.size()) port.end_ready = cycle + 1 + port.stalls[at_end.size()];
        last_move = cycle;
      }
    }
    top.clk = 1;
    top.eval();
  }
  return wrong;
}

}  // namespace parallax::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <string>
#include <vector>

namespace parallax::test {

/// Changes of bytes as damage and malice make them, the same ones for the same seed.
class Mutation {
 public:
  explicit Mutation(unsigned seed) : random_(seed) {}

  std::string operator()(std::string bytes, const std::vector<std::string>& seeds) {
    for (int changes = 1 + below(3); changes > 0; --changes) bytes = change(std::move(bytes), seeds);
    return bytes;
  }

 private:
  int below(std::size_t number) { return number == 0 ? 0 : static_cast<int>(random_() % number); }
  std::size_t at(const std::string& bytes) { return static_cast<std::size_t>(below(bytes.size())); }

  std::string change(std::string bytes, const std::vector<std::string>& seeds) {
    if (bytes.empty()) return std::string(1, static_cast<char>(below(256)));
    static const std::vector<std::string> tokens{"99999999999999999999999",
                                                 "-1",
                                                 "0",
                                                 "1e999",
                                                 "nan",
                                                 "-9223372036854775808",
                                                 "4294967296",
                                                 "",
                                                 "[",
                                                 "{",
                                                 "\"",
                                                 "\n",
                                                 "\xFF\xFE",
                                                 std::string(1, '\0'),
                                                 "null",
                                                 "true",
                                                 "...",
                                                 "1.0e-320",
                                                 "\xE2\x80\xA8",
                                                 "a.b.c",
                                                 "=",
                                                 "../",
                                                 "%s%n"};
    const std::size_t place = at(bytes);
    switch (below(9)) {
      case 0:
        bytes[place] = static_cast<char>(bytes[place] ^ (1 << below(8)));
        return bytes;
      case 1:
        bytes[place] = static_cast<char>(below(256));
        return bytes;
      case 2:
        return bytes.substr(0, place);
      case 3:
        return bytes.erase(place, static_cast<std::size_t>(1 + below(16)));
      case 4:
        return bytes.insert(place, tokens[static_cast<std::size_t>(below(tokens.size()))]);
      case 5:
        return number(std::move(bytes), place, tokens[static_cast<std::size_t>(below(8))]);
      case 6: {  // another seed's end
        const std::string& other = seeds[static_cast<std::size_t>(below(seeds.size()))];
        return bytes.substr(0, place) + other.substr(at(other));
      }
      case 7:  // a piece of it twice
        return bytes.insert(place, bytes.substr(at(bytes), static_cast<std::size_t>(1 + below(64))));
      default: {  // four bytes, as a number of a binary format
        for (std::size_t i = place; i < std::min(place + 4, bytes.size()); ++i)
          bytes[i] = below(2) == 0 ? '\xFF' : '\0';
        return bytes;
      }
    }
  }

  // The first number from `place` on is another one.
  static std::string number(std::string bytes, std::size_t place, const std::string& other) {
    const std::size_t begin = bytes.find_first_of("0123456789", place);
    if (begin == std::string::npos) return bytes;
    const std::size_t end = std::min(bytes.find_first_not_of("0123456789.", begin), bytes.size());
    return bytes.replace(begin, end - begin, other);
  }

  std::minstd_rand random_;
};

}  // namespace parallax::test

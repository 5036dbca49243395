// SPDX-License-Identifier: Apache-2.0
#include "platform/config/nearest_key.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "platform/config/nearest_name.hpp"

namespace parallax {
namespace {

using Words = std::vector<std::string>;

constexpr std::size_t kLongestPath = 200;  // beyond it nothing is near, and comparing takes its time
constexpr double kLikeSection = 0.6;

// What people write for what the keys call otherwise.
const std::vector<std::vector<std::string_view>> kSameMeaning = {
    {"matching", "matcher", "sgm", "stereo"},
    {"noise", "median", "smoothing", "denoise"},
    {"gap", "hole", "fill"},
    {"camera", "sensor"},
    {"dram", "ddr"},
    {"link", "ethernet", "network"},
    {"p1", "p2", "penalty"},
    {"paths", "directions"},
    {"iterations", "passes", "repetitions"},
    {"iterations", "disparities", "range"},
    {"parallelism", "lanes", "unroll"},
    {"cost", "metric", "distance"},
    {"window", "size", "radius", "kernel"},
    {"kind", "type", "mode", "method", "curve", "model"},
    {"hz", "frequency", "clock", "mhz"},
    {"rate", "fps"},
    {"factor", "ratio"},
    {"threshold", "tolerance", "sensitivity"},
    {"bytes", "bandwidth"},
    {"cycle", "bandwidth"},
    {"enabled", "on", "off", "use", "disable"},
    {"latency", "delay"},
    {"border", "padding", "edge", "mask"},
    {"kind", "median", "mean"},
    {"width", "columns"},
    {"height", "rows"},
    {"bits", "precision"},
    {"overflow", "saturation"},
};

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// "core_hz", "left.burst_bytes", "penalty1": a number behind a word is one of its own.
Words words_of(const std::string& text) {
  constexpr std::size_t kWord = 3;
  Words words(1);
  for (const char c : text) {
    const bool between = c == '_' || c == '.' || c == '-';
    const std::string& last = words.back();
    if ((between && !last.empty()) || (is_digit(c) && last.size() >= kWord && !is_digit(last.back()))) {
      words.emplace_back();
    }
    if (!between) words.back() += c;
  }
  words.erase(std::remove(words.begin() + 1, words.end(), std::string("of")), words.end());
  if (words.back().empty() && words.size() > 1) words.pop_back();
  return words;
}

bool same_meaning(const std::string& a, const std::string& b) {
  return std::any_of(kSameMeaning.begin(), kSameMeaning.end(), [&](const auto& group) {
    const auto has = [&group](const std::string& word) {
      return std::find(group.begin(), group.end(), word) != group.end();
    };
    return has(a) && has(b);
  });
}

/// 0: nothing in common; 1: equal.
double likeness(const std::string& a, const std::string& b) {
  if (a == b) return 1;
  const std::string& longer = a.size() < b.size() ? b : a;
  const std::string& shorter = a.size() < b.size() ? a : b;
  if (shorter.size() > 1 && longer.compare(0, shorter.size(), shorter) == 0) return 0.85;
  if (shorter.size() > 2 && longer.find(shorter) != std::string::npos) return 0.8;
  if (shorter.size() == 1 && longer.size() == 2 && longer.back() == shorter.back()) return 0.8;  // 1 of p1
  if (same_meaning(a, b)) return 0.75;
  const auto apart = std::mismatch(shorter.begin(), shorter.end(), longer.begin());
  if (apart.first - shorter.begin() > 4) return 0.7;  // one stem
  const double kept = 1 - static_cast<double>(edit_distance(a, b)) / static_cast<double>(longer.size());
  return kept < 0.5 ? 0 : 0.9 * kept;
}

/// Mean of what each word of both has as its like in the other.
double likeness(const Words& a, const Words& b) {
  double sum = 0;
  const auto add = [&sum](const Words& words, const Words& others) {
    for (const std::string& word : words) {
      double most = 0;
      for (const std::string& other : others) most = std::max(most, likeness(word, other));
      sum += most;
    }
  };
  add(a, b);
  add(b, a);
  return sum / static_cast<double>(a.size() + b.size());
}

/// Section and rest; no section if there is no dot.
std::pair<std::string, std::string> split(const std::string& path) {
  const std::size_t dot = path.find('.');
  if (dot == std::string::npos) return {"", path};
  return {path.substr(0, dot), path.substr(dot + 1)};
}

/// The section of the keys that is meant, empty if none is like it.
std::string section_like(const std::string& wanted, const Words& keys) {
  std::string best;
  double most = kLikeSection;
  for (const std::string& key : keys) {
    std::string section = split(key).first;
    if (section == wanted) return section;
    const double like = wanted.empty() || section.empty() ? 0 : likeness(words_of(wanted), words_of(section));
    if (like > most) {
      most = like;
      best = section;
    }
  }
  return best;
}

}  // namespace

std::string nearest_key(const std::string& path, const std::vector<std::string>& keys) {
  const std::string wanted = lower_case(path.substr(0, kLongestPath));
  const std::string section = section_like(split(wanted).first, keys);
  const Words words = words_of(section.empty() ? wanted : split(wanted).second);
  Words nearest;
  double most = -1;
  for (const std::string& key : keys) {
    const auto [of, rest] = split(key);
    if (!section.empty() && of != section) continue;
    const double like = likeness(words, words_of(section.empty() ? key : rest));
    if (like > most) nearest.clear();
    if (like >= most) nearest.push_back(key);
    most = std::max(most, like);
  }
  return nearest_name(wanted, nearest);
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/input/image_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <functional>
#include <iomanip>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "tlm/error.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // some editors put it before UTF-8 text

bool is_image(const fs::path& path) {
  static const std::set<std::string> extensions{".png", ".jpg", ".jpeg", ".bmp",  ".pgm",
                                                ".ppm", ".pnm", ".tif",  ".tiff", ".webp"};
  return extensions.count(lower(path.extension().string())) > 0;
}

std::vector<std::string> image_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code failed;
  fs::directory_iterator entries(folder, failed);
  if (failed) {
    throw UserError(fmt::format("cannot read the folder {}: {}", folder.string(), failed.message()));
  }
  for (const fs::directory_entry& entry : entries) {
    // A leading dot: half-written files and the resource forks of other systems.
    if (entry.is_regular_file() && is_image(entry.path()) && entry.path().filename().string()[0] != '.') {
      names.push_back(entry.path().filename().string());
    }
  }
  std::sort(names.begin(), names.end(), natural_less);
  return names;
}

/// Replaces a token at the front or the back of a file's stem.
struct NameRule {
  std::string left, right;
  bool prefix = false;
  bool whole = false;  ///< nothing but the token
  bool any_case = false;

  /// The name of the other side: `from` replaced by `to`, or nothing when `from` is not in the name.
  std::optional<std::string> partner(const std::string& name, const std::string& from,
                                     const std::string& to) const {
    const fs::path path(name);
    const std::string stem = path.stem().string();
    if (stem.size() < from.size() || (whole && stem.size() != from.size())) {
      return std::nullopt;
    }
    const std::size_t at = prefix ? 0 : stem.size() - from.size();
    const std::string token = stem.substr(at, from.size());
    if ((any_case ? lower(token) : token) != from) {
      return std::nullopt;
    }
    std::string replaced = stem;
    replaced.replace(at, from.size(), to);
    return replaced + path.extension().string();
  }
};

const std::vector<NameRule>& name_rules() {
  static const std::vector<NameRule> rules{{"left", "right", true, false, true},
                                           {"_left", "_right", false, false, true},
                                           {"_l", "_r", false, false, true},
                                           {"L", "R", false, false, false},
                                           {"im0", "im1", true, true, false}};
  return rules;
}

[[noreturn]] void unmatched(const fs::path& folder, const std::string& side, const std::string& name,
                            const fs::path& wanted) {
  throw UserError(
      fmt::format("{}: the {} image {} has no partner {}", folder.string(), side, name, wanted.string()));
}

std::vector<ImagePair> pairs_by_rule(const fs::path& folder, const std::vector<std::string>& names,
                                     const NameRule& rule) {
  // Case-insensitive rules find a partner in any spelling.
  const auto key = [&](const std::string& name) { return rule.any_case ? lower(name) : name; };
  const auto find = [&](const std::string& name) {
    return std::find_if(names.begin(), names.end(),
                        [&](const std::string& n) { return key(n) == key(name); });
  };
  std::vector<ImagePair> pairs;
  for (const std::string& name : names) {
    if (const auto right = rule.partner(name, rule.left, rule.right)) {
      const auto found = find(*right);
      if (found == names.end()) {
        unmatched(folder, "left", name, *right);
      }
      pairs.push_back({folder / name, folder / *found});
    } else if (const auto left = rule.partner(name, rule.right, rule.left)) {
      if (find(*left) == names.end()) {
        unmatched(folder, "right", name, *left);
      }
    }
  }
  return pairs;
}

std::vector<ImagePair> pairs_of_subfolders(const fs::path& folder) {
  static const std::pair<const char*, const char*> names[] = {
      {"left", "right"}, {"image_0", "image_1"}, {"image_2", "image_3"}, {"image_l", "image_r"}};
  for (const auto& [left, right] : names) {
    if (!fs::is_directory(folder / left) || !fs::is_directory(folder / right)) {
      continue;
    }
    const std::vector<std::string> lefts = image_names(folder / left);
    const std::vector<std::string> rights = image_names(folder / right);
    std::vector<ImagePair> pairs;
    for (const std::string& name : lefts) {
      if (std::find(rights.begin(), rights.end(), name) == rights.end()) {
        unmatched(folder, "left", (fs::path(left) / name).string(), fs::path(right) / name);
      }
      pairs.push_back({folder / left / name, folder / right / name});
    }
    for (const std::string& name : rights) {
      if (std::find(lefts.begin(), lefts.end(), name) == lefts.end()) {
        unmatched(folder, "right", (fs::path(right) / name).string(), fs::path(left) / name);
      }
    }
    if (!pairs.empty()) {
      return pairs;
    }
  }
  return {};
}

std::vector<ImagePair> pairs_of_folder(const fs::path& folder) {
  if (auto pairs = pairs_of_subfolders(folder); !pairs.empty()) {
    return pairs;
  }
  const std::vector<std::string> names = image_names(folder);
  for (const NameRule& rule : name_rules()) {
    if (auto pairs = pairs_by_rule(folder, names, rule); !pairs.empty()) {
      return pairs;
    }
  }
  throw UserError(
      fmt::format("{} holds no stereo pair; expected left_*.png and right_*.png, *_l and *_r, or "
                  "subfolders left and right",
                  folder.string()));
}

std::vector<ImagePair> pairs_of_list(const fs::path& list) {
  std::ifstream file(list);
  if (!file) {
    throw UserError(fmt::format("cannot read the list of pairs {}", list.string()));
  }
  std::vector<ImagePair> pairs;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (number == 1 && line.rfind(kByteOrderMark, 0) == 0) line.erase(0, kByteOrderMark.size());
    std::istringstream words(line);
    std::vector<std::string> paths;
    for (std::string word; words >> std::ws && words.peek() != '#' && words >> std::quoted(word);) {
      paths.push_back(word);
    }
    if (paths.empty()) {
      continue;
    }
    if (paths.size() != 2) {
      throw UserError(fmt::format("{}:{}: {} path{} in this line, expected two: left right", list.string(),
                                  number, paths.size(), paths.size() == 1 ? "" : "s"));
    }
    const ImagePair pair{list.parent_path() / paths[0], list.parent_path() / paths[1]};
    for (const fs::path& path : {pair.left, pair.right}) {
      if (!fs::exists(path)) {
        throw UserError(fmt::format("{}:{}: {} does not exist", list.string(), number, path.string()));
      }
    }
    pairs.push_back(pair);
  }
  if (pairs.empty()) {
    throw UserError(
        fmt::format("the list of pairs {} is empty; expected two paths a line: left right", list.string()));
  }
  return pairs;
}

}  // namespace

bool natural_less(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!digit(a[i]) || !digit(b[j])) {
      if (a[i] != b[j]) {
        return a[i] < b[j];
      }
      ++i;
      ++j;
      continue;
    }
    // Runs of digits: without leading zeros, the longer number is the larger one.
    const auto number = [&](const std::string& text, std::size_t& at) {
      while (at < text.size() && text[at] == '0') {
        ++at;
      }
      const std::size_t from = at;
      while (at < text.size() && digit(text[at])) {
        ++at;
      }
      return text.substr(from, at - from);
    };
    const std::string x = number(a, i);
    const std::string y = number(b, j);
    if (x != y) {
      return x.size() != y.size() ? x.size() < y.size() : x < y;
    }
  }
  if (a.size() - i != b.size() - j) {
    return a.size() - i < b.size() - j;
  }
  return a < b;  // 01 and 1: any order, but always the same
}

std::vector<ImagePair> find_image_pairs(const fs::path& folder_or_list) {
  std::error_code unreadable;  // a circle of links, say
  if (!fs::exists(folder_or_list, unreadable)) {
    throw UserError(fmt::format("{} does not exist; expected a folder or a list of image pairs",
                                folder_or_list.string()));
  }
  return fs::is_directory(folder_or_list) ? pairs_of_folder(folder_or_list) : pairs_of_list(folder_or_list);
}

}  // namespace parallax

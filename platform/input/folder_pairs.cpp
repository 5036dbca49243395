// SPDX-License-Identifier: Apache-2.0
#include "platform/input/folder_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "platform/input/folder_layouts.hpp"
#include "platform/input/image_names.hpp"
#include "platform/input/letters.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;
using Kind = FolderLayout::Kind;
using Strength = FolderLayout::Strength;

// An image without its partner.
struct Lonely {
  const char* side;
  fs::path image;
  fs::path wanted;
};

// What a layout makes of a folder.
struct Match {
  Strength strength{};
  std::vector<ImagePair> pairs;
  std::vector<Lonely> lonely;
  std::size_t left_over = 0;  // images of no pair

  bool complete() const { return !pairs.empty() && lonely.empty(); }
};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }

// `to`, written as `like` is: Left has Right, LEFT has RIGHT.
std::string written_as(const std::string& like, std::string to) {
  for (std::size_t i = 0; i < to.size(); ++i) {
    const std::size_t at = i == 0 ? 0 : std::min<std::size_t>(1, like.size() - 1);
    if (is_capital(like[at]) && to[i] >= 'a' && to[i] <= 'z') to[i] = static_cast<char>(to[i] - 'a' + 'A');
  }
  return to;
}

struct Replaced {
  std::string name;
  bool word;  // the token stands by itself, it is no part of another word
};

// The name with the layout's token replaced, or nothing when it is not in the name.
std::optional<Replaced> replaced(Kind kind, bool any_case, const std::string& name, const std::string& from,
                                 const std::string& to) {
  const fs::path path(name);
  std::string stem = path.stem().string();
  const std::string searched = any_case ? lower(stem) : stem;
  const std::string token = any_case ? lower(from) : from;
  if (searched.size() < token.size()) return std::nullopt;
  std::size_t at = kind == Kind::kSuffix ? stem.size() - token.size() : 0;
  if (kind == Kind::kAnywhere) at = searched.rfind(token);
  if (at == std::string::npos || searched.compare(at, token.size(), token) != 0) return std::nullopt;
  if (kind == Kind::kWholeName && stem.size() != token.size()) return std::nullopt;
  const std::size_t end = at + token.size();
  const bool begins = at == 0 || !is_letter(stem[at]) || !is_letter(stem[at - 1]) ||
                      (is_capital(stem[at]) && !is_capital(stem[at - 1]));
  const bool ends = end == stem.size() || !is_letter(stem[end]) || is_capital(stem[end]);
  stem.replace(at, token.size(), any_case ? written_as(stem.substr(at, token.size()), to) : to);
  return Replaced{(path.parent_path() / stem).string() + path.extension().string(), begins && ends};
}

Match match_names(const fs::path& folder, const std::vector<std::string>& names, const FolderLayout& layout) {
  Match match;
  match.strength = layout.strength;
  // Names that compare without regard to case find a partner in any spelling.
  const auto key = [&](const std::string& name) { return layout.any_case ? lower(name) : name; };
  std::map<std::string, std::string> by_key;
  for (const std::string& name : names) by_key.emplace(key(name), name);
  std::set<std::string> paired;
  for (const std::string& name : names) {
    const auto right = replaced(layout.kind, layout.any_case, name, layout.left, layout.right);
    const auto found = right ? by_key.find(key(right->name)) : by_key.end();
    if (found == by_key.end()) continue;
    match.pairs.push_back({folder / name, folder / found->second});
    paired.insert({name, found->second});
  }
  for (const std::string& name : names) {
    if (paired.count(name) > 0) continue;
    ++match.left_over;
    const auto lonely = [&](const char* side, const std::string& from, const std::string& to) {
      const auto other = replaced(layout.kind, layout.any_case, name, from, to);
      if (other && (other->word || layout.kind == Kind::kPrefix))
        match.lonely.push_back({side, name, other->name});
    };
    lonely("left", layout.left, layout.right);
    lonely("right", layout.right, layout.left);
  }
  return match;
}

// How the names in two folders may differ, beyond not at all.
std::vector<std::pair<std::string, std::string>> name_tokens(const fs::path& left, const fs::path& right) {
  return {{left.filename().string(), right.filename().string()},
          {"left", "right"},
          {"lcam", "rcam"},
          {"cam0", "cam1"},
          {"infra1", "infra2"},
          {"_l", "_r"},
          {"l_", "r_"}};
}

Match match_folders(const fs::path& folder, const fs::path& left, const fs::path& right, Strength strength) {
  const std::vector<std::string> lefts = image_names_below(folder / left);
  const std::vector<std::string> rights = image_names_below(folder / right);
  const auto tokens = name_tokens(left, right);
  std::map<std::string, std::string> by_key;
  for (const std::string& name : rights) by_key.emplace(lower(name), name);
  Match match;
  match.strength = strength;
  std::set<std::string> paired;
  std::optional<std::size_t> usual;  // token in the names, as far as the pairs tell
  const auto other = [&](const std::string& name, std::optional<std::size_t> token, bool to_left) {
    if (!token) return name;
    const auto& [l, r] = tokens[*token];
    const auto with = replaced(Kind::kAnywhere, true, name, to_left ? r : l, to_left ? l : r);
    return with ? with->name : name;
  };
  std::vector<std::string> alone;
  for (const std::string& name : lefts) {
    std::optional<std::size_t> token;
    auto found = by_key.find(lower(name));
    for (std::size_t t = 0; t < tokens.size() && found == by_key.end(); ++t) {
      token = t;
      found = by_key.find(lower(other(name, t, false)));
    }
    if (found == by_key.end()) {
      alone.push_back(name);
      continue;
    }
    if (token) usual = token;
    match.pairs.push_back({folder / left / name, folder / right / found->second});
    paired.insert(found->second);
  }
  for (const std::string& name : alone)
    match.lonely.push_back({"left", left / name, right / other(name, usual, false)});
  for (const std::string& name : rights) {
    if (paired.count(name) == 0)
      match.lonely.push_back({"right", right / name, left / other(name, usual, true)});
  }
  match.left_over = match.lonely.size();
  return match;
}

// The folder below `folder` of this name in any spelling, or nothing.
std::optional<fs::path> find_folder(const fs::path& folder, const std::string& name) {
  fs::path found;
  for (const fs::path& part : fs::path(name)) {
    const std::vector<std::string> names = folder_names(folder / found);
    auto at = std::find(names.begin(), names.end(), part.string());
    if (at == names.end()) {
      at = std::find_if(names.begin(), names.end(),
                        [&](const std::string& n) { return lower(n) == lower(part.string()); });
    }
    if (at == names.end()) return std::nullopt;
    found /= *at;
  }
  return found;
}

std::vector<Match> all_matches(const fs::path& folder) {
  const std::vector<std::string> images = image_names(folder);
  const std::vector<std::string> folders = folder_names(folder);
  std::vector<Match> matches;
  for (const FolderLayout& layout : folder_layouts()) {
    if (layout.kind == Kind::kFolders) {
      const auto left = find_folder(folder, layout.left);
      const auto right = find_folder(folder, layout.right);
      if (left && right) matches.push_back(match_folders(folder, *left, *right, layout.strength));
    } else if (layout.kind == Kind::kFoldersOf) {
      for (const std::string& left : folders) {
        const auto right = replaced(Kind::kAnywhere, true, left, layout.left, layout.right);
        const auto found = right ? find_folder(folder, right->name) : std::nullopt;
        if (found) matches.push_back(match_folders(folder, left, *found, layout.strength));
      }
    } else {
      matches.push_back(match_names(folder, images, layout));
    }
  }
  return matches;
}

bool better(const Match& a, const Match& b) {
  if (a.complete() != b.complete()) return a.complete();
  const bool strength_first = a.complete();  // of what misses a partner, the most pairs say most
  if (strength_first && a.strength != b.strength) return a.strength < b.strength;
  if (a.pairs.size() != b.pairs.size()) return a.pairs.size() > b.pairs.size();
  if (a.strength != b.strength) return a.strength < b.strength;
  return a.left_over < b.left_over;
}

[[noreturn]] void refuse(const fs::path& folder, const Match& match) {
  const Lonely& first = match.lonely.front();
  const std::size_t more = match.lonely.size() - 1;
  throw UserError(fmt::format("{}: the {} image {} has no partner {}{}", folder.string(), first.side,
                              first.image.string(), first.wanted.string(),
                              more == 0 ? "" : fmt::format(", and {} more have none", more)));
}

}  // namespace

std::vector<ImagePair> pairs_of_folder(const fs::path& folder) {
  std::vector<Match> matches = all_matches(folder);
  // The first of equals stays the first.
  std::stable_sort(matches.begin(), matches.end(), better);
  const Match* const best = !matches.empty() && matches.front().complete() ? &matches.front() : nullptr;
  for (const Match& match : matches) {
    if (match.lonely.empty()) continue;
    const bool frame_is_missing =
        best != nullptr ? match.strength <= best->strength && match.pairs.size() > best->pairs.size()
                        : match.strength != Strength::kLetter || !match.pairs.empty();
    if (frame_is_missing) refuse(folder, match);
  }
  if (best != nullptr) return best->pairs;
  throw UserError(
      fmt::format("{} holds no stereo pair; looked for {}; or give a list file, two paths a line: left right",
                  folder.string(), folder_layouts_text()));
}

}  // namespace parallax

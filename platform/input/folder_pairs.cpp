// SPDX-License-Identifier: Apache-2.0
#include "platform/input/folder_pairs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "platform/input/folder_layouts.hpp"
#include "platform/input/folder_scenes.hpp"
#include "platform/input/image_names.hpp"
#include "platform/input/letters.hpp"
#include "platform/input/partner_names.hpp"
#include "platform/input/quoted_text.hpp"
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
  const PartnerNames candidates(names, layout.any_case);
  std::set<std::string> paired;
  std::vector<std::optional<std::string>> partners(names.size());
  const auto pair = [&](bool other_format) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (other_format && paired.count(names[i]) > 0) continue;
      const auto right = replaced(layout.kind, layout.any_case, names[i], layout.left, layout.right);
      if (!right) continue;
      partners[i] =
          other_format ? candidates.of_other_format(right->name, paired) : candidates.named(right->name);
      if (partners[i]) paired.insert({names[i], *partners[i]});
    }
  };
  pair(false);
  pair(true);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (partners[i]) match.pairs.push_back({folder / names[i], folder / *partners[i]});
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
  const PartnerNames candidates(rights, true);
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
  std::vector<std::optional<std::string>> partners(lefts.size());
  const auto pair = [&](bool other_format) {
    for (std::size_t i = 0; i < lefts.size(); ++i) {
      if (partners[i]) continue;
      const auto find = [&](std::optional<std::size_t> token) {
        const std::string wanted = other(lefts[i], token, false);
        return other_format ? candidates.of_other_format(wanted, paired) : candidates.named(wanted);
      };
      std::optional<std::size_t> token;
      partners[i] = find(token);
      for (std::size_t t = 0; t < tokens.size() && !partners[i]; ++t) {
        token = t;
        partners[i] = find(token);
      }
      if (!partners[i]) continue;
      if (token) usual = token;
      paired.insert(*partners[i]);
    }
  };
  pair(false);
  pair(true);
  for (std::size_t i = 0; i < lefts.size(); ++i) {
    if (partners[i]) {
      match.pairs.push_back({folder / left / lefts[i], folder / right / *partners[i]});
    } else {
      match.lonely.push_back({"left", left / lefts[i], right / other(lefts[i], usual, false)});
    }
  }
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

// The pairs of the best layout that leaves no image without its partner, none where there is none; or the
// match that misses a frame.
struct Found {
  std::vector<ImagePair> pairs;
  std::optional<Match> incomplete;
};

Found best_pairs(const fs::path& folder) {
  std::vector<Match> matches = all_matches(folder);
  // The first of equals stays the first.
  std::stable_sort(matches.begin(), matches.end(), better);
  const Match* const best = !matches.empty() && matches.front().complete() ? &matches.front() : nullptr;
  for (const Match& match : matches) {
    if (match.lonely.empty()) continue;
    const bool frame_is_missing =
        best != nullptr ? match.strength <= best->strength && match.pairs.size() > best->pairs.size()
                        : match.strength != Strength::kLetter || !match.pairs.empty();
    if (frame_is_missing) return {{}, match};
  }
  return {best != nullptr ? best->pairs : std::vector<ImagePair>(), std::nullopt};
}

std::string scenes_text(const fs::path& folder, const std::vector<std::string>& scenes) {
  constexpr std::size_t kMostNames = 8;
  const std::size_t shown = std::min(kMostNames, scenes.size());
  const auto end = scenes.begin() + static_cast<std::ptrdiff_t>(shown);
  return fmt::format(
      "{} holds no stereo pair itself, but {} below: {}{}; to run one: parallax run --input {}",
      folder.string(), scenes.size() == 1 ? "a scene" : fmt::format("{} scenes", scenes.size()),
      fmt::join(scenes.begin(), end, ", "),
      scenes.size() == shown ? "" : fmt::format(" and {} more", scenes.size() - shown),
      shell_word((folder / scenes.front()).string()));
}

}  // namespace

std::vector<ImagePair> pairs_of_folder(const fs::path& folder) {
  Found found = best_pairs(folder);
  if (found.incomplete) refuse(folder, *found.incomplete);
  if (!found.pairs.empty()) return found.pairs;
  const std::vector<std::string> scenes =
      folder_scenes(folder, [](const fs::path& below) { return !best_pairs(below).pairs.empty(); });
  if (!scenes.empty()) throw UserError(scenes_text(folder, scenes));
  throw UserError(
      fmt::format("{} holds no stereo pair; looked for {}; or give a list file, two paths a line: left right",
                  folder.string(), folder_layouts_text()));
}

}  // namespace parallax

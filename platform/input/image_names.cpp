// SPDX-License-Identifier: Apache-2.0
#include "platform/input/image_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "platform/input/letters.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepest = 4;  // folders below a side: a circle of links ends, too

bool is_image(const fs::path& path) {
  static const std::set<std::string> extensions{".png", ".jpg", ".jpeg", ".bmp",  ".pgm",
                                                ".ppm", ".pnm", ".tif",  ".tiff", ".webp"};
  return extensions.count(lower(path.extension().string())) > 0;
}

// The words of a name: aloeGT_mask01 has aloe, gt, mask, 01.
std::vector<std::string> words(const std::string& name) {
  std::vector<std::string> found(1);
  const auto kind = [](unsigned char c) {
    return std::isdigit(c) != 0 ? 1 : std::isupper(c) != 0 ? 2 : std::isalpha(c) != 0 ? 3 : 0;
  };
  int last = 0;
  for (const char c : name) {
    const int now = kind(static_cast<unsigned char>(c));
    if (now != last && !(last == 2 && now == 3)) found.emplace_back();
    if (now != 0) found.back() += c;
    last = now;
  }
  for (std::string& word : found) word = lower(word);
  return found;
}

bool is_of_other_kind(const std::string& stem) {
  static const std::set<std::string> kinds{
      "disp",  "disps",  "disparity",    "disparities", "depth",    "depths",
      "gt",    "truth",  "groundtruth",  "mask",        "masks",    "occl",
      "occ",   "nocc",   "noc",          "nonocc",      "flow",     "occlusions",
      "seg",   "segs",   "semantic",     "semantics",   "instance", "instances",
      "label", "labels", "segmentation", "normals",     "conf",     "confidence"};
  const std::vector<std::string> all = words(stem);
  return std::any_of(all.begin(), all.end(), [](const std::string& word) { return kinds.count(word) > 0; });
}

fs::directory_iterator entries_of(const fs::path& folder) {
  std::error_code failed;
  fs::directory_iterator entries(folder, failed);
  if (failed)
    throw UserError(fmt::format("cannot read the folder {}: {}", folder.string(), failed.message()));
  return entries;
}

// A leading dot: half-written files and the resource forks of other systems.
bool hidden(const fs::path& path) { return path.filename().string()[0] == '.'; }

void add_below(const fs::path& folder, const std::string& prefix, int depth,
               std::vector<std::string>& names) {
  const std::vector<std::string> here = image_names(folder);
  for (const std::string& name : here) names.push_back(prefix + name);
  if (!here.empty() || depth == kDeepest) return;
  for (const std::string& name : folder_names(folder))
    add_below(folder / name, prefix + name + "/", depth + 1, names);
}

}  // namespace

std::vector<std::string> image_names(const fs::path& folder) {
  std::vector<std::string> images, others;
  for (const fs::directory_entry& entry : entries_of(folder)) {
    std::error_code failed;
    const fs::file_type type = entry.status(failed).type();
    // A link that leads nowhere is an image that is missing, which its reader says.
    if (type != fs::file_type::regular && type != fs::file_type::not_found) continue;
    if (!is_image(entry.path()) || hidden(entry.path())) continue;
    (is_of_other_kind(entry.path().stem().string()) ? others : images)
        .push_back(entry.path().filename().string());
  }
  std::vector<std::string>& names = images.empty() ? others : images;
  std::sort(names.begin(), names.end(), natural_less);
  return names;
}

std::vector<std::string> folder_names(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : entries_of(folder)) {
    std::error_code failed;
    const std::string name = entry.path().filename().string();
    if (entry.is_directory(failed) && !hidden(entry.path()) && !is_of_other_kind(name)) names.push_back(name);
  }
  std::sort(names.begin(), names.end(), natural_less);
  return names;
}

std::vector<std::string> image_names_below(const fs::path& folder) {
  std::vector<std::string> names;
  add_below(folder, "", 0, names);
  return names;
}

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

}  // namespace parallax

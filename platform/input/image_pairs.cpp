// SPDX-License-Identifier: Apache-2.0
#include "platform/input/image_pairs.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iomanip>
#include <sstream>

#include "platform/input/folder_pairs.hpp"
#include "platform/input/input_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;

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

std::vector<ImagePair> find_image_pairs(const fs::path& folder_or_list) {
  std::error_code unreadable;  // a circle of links, say
  if (!fs::exists(folder_or_list, unreadable)) {
    throw UserError(fmt::format("{} does not exist; expected a folder or a list of image pairs",
                                folder_or_list.string()));
  }
  return fs::is_directory(folder_or_list) ? pairs_of_folder(folder_or_list) : pairs_of_list(folder_or_list);
}

}  // namespace parallax

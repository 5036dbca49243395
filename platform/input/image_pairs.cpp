// SPDX-License-Identifier: Apache-2.0
#include "platform/input/image_pairs.hpp"

#include <fmt/format.h>

#include <iomanip>
#include <sstream>

#include "platform/files/plain_file.hpp"
#include "platform/input/folder_pairs.hpp"
#include "platform/input/text_file.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestPath = 200;  // of what a message quotes of a path

// What says nothing of a path, such as that it is too long, is that it is not there.
bool is_there(const fs::path& path) {
  std::error_code failed;
  return fs::exists(path, failed);
}

std::string text_of_list(const fs::path& list) {
  constexpr std::size_t kLargestList = std::size_t{64} << 20;
  require_plain_file(list.string(), "a folder or a list of image pairs");
  std::string text = read_text_file(list.string(), kLargestList);
  if (text.find('\0') != std::string::npos) {
    throw UserError(fmt::format(
        "{} is no list of pairs, as it is no text; expected two paths a line: left right; a pair goes with "
        "--left and --right",
        list.string()));
  }
  return text;
}

std::vector<ImagePair> pairs_of_list(const fs::path& list) {
  std::istringstream file(text_of_list(list));
  std::vector<ImagePair> pairs;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
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
      if (!is_there(path)) {
        throw UserError(fmt::format("{}:{}: {} does not exist", list.string(), number,
                                    excerpt(path.string(), kLongestPath)));
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
  if (!is_there(folder_or_list)) {
    throw UserError(fmt::format("{} does not exist; expected a folder or a list of image pairs",
                                folder_or_list.string()));
  }
  return fs::is_directory(folder_or_list) ? pairs_of_folder(folder_or_list) : pairs_of_list(folder_or_list);
}

std::vector<ImagePair> pairs_in_memory(const std::vector<StereoImages>& images) {
  std::vector<ImagePair> pairs;
  for (const StereoImages& pixels : images) {
    const std::string number = images.size() == 1 ? "" : fmt::format("[{}]", pairs.size());
    pairs.push_back({"left" + number, "right" + number, pixels});
  }
  return pairs;
}

}  // namespace parallax

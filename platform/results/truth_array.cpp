// SPDX-License-Identifier: Apache-2.0
#include "platform/results/truth_array.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "platform/images/zip_archive.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr const char* kArrayEnd = ".npy";

struct NamedArray {
  std::string name;
  const ZipMember* member;
};

std::vector<NamedArray> arrays_of(const ZipArchive& archive) {
  std::vector<NamedArray> arrays;
  const std::string end = kArrayEnd;
  for (const ZipMember& member : archive.members()) {
    const std::string& name = member.name;
    if (name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0)
      arrays.push_back({name.substr(0, name.size() - end.size()), &member});
  }
  return arrays;
}

std::string names_text(const std::vector<NamedArray>& arrays) {
  constexpr std::size_t kMostNames = 10;
  std::vector<std::string> names;
  for (const NamedArray& array : arrays) names.push_back(excerpt(array.name));
  const std::size_t shown = std::min(kMostNames, names.size());
  return fmt::format("{}{}",
                     fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                     names.size() == shown ? "" : fmt::format(" and {} more", names.size() - shown));
}

std::vector<NamedArray> named_like_disparities(const std::vector<NamedArray>& arrays) {
  static const std::vector<std::string> usual{"disparity",    "disp",    "disparity_gt", "disp_gt",
                                              "gt_disparity", "gt_disp", "disparities",  "arr_0"};
  std::vector<NamedArray> found;
  std::copy_if(arrays.begin(), arrays.end(), std::back_inserter(found), [](const NamedArray& array) {
    return std::find(usual.begin(), usual.end(), array.name) != usual.end();
  });
  return found;
}

NamedArray chosen(const std::vector<NamedArray>& arrays, const TruthPath& path,
                  const std::function<void(const std::string&)>& notice) {
  if (arrays.empty())
    throw UserError(fmt::format("{}: an archive without arrays, which numpy.savez names *.npy", path.file));
  if (!path.array.empty()) {
    const auto found = std::find_if(arrays.begin(), arrays.end(),
                                    [&](const NamedArray& array) { return array.name == path.array; });
    if (found != arrays.end()) return *found;
    throw UserError(
        fmt::format("{}: holds no array {}, but {}", path.file, excerpt(path.array), names_text(arrays)));
  }
  if (arrays.size() == 1) return arrays.front();
  const std::vector<NamedArray> likely = named_like_disparities(arrays);
  if (likely.size() != 1) {
    throw UserError(fmt::format(
        "{}: holds the arrays {}; name the one that holds disparities: "
        "--ground-truth {}:{}",
        path.file, names_text(arrays), path.file, excerpt((likely.empty() ? arrays : likely).front().name)));
  }
  if (notice) {
    notice(fmt::format("ground truth {}: it holds the arrays {}: {} is taken; {}:NAME names another",
                       path.file, names_text(arrays), likely.front().name, path.file));
  }
  return likely.front();
}

}  // namespace

TruthPath truth_path(const std::string& text) {
  std::error_code failed;
  if (std::filesystem::exists(text, failed)) return {text, ""};
  for (std::size_t colon = text.rfind(':'); colon != std::string::npos && colon > 0;
       colon = text.rfind(':', colon - 1)) {
    const std::string file = text.substr(0, colon);
    if (colon + 1 < text.size() && std::filesystem::is_regular_file(file, failed))
      return {file, text.substr(colon + 1)};
  }
  return {text, ""};
}

std::vector<std::uint8_t> truth_array(const TruthPath& path, std::uint64_t most,
                                      const std::function<void(const std::string&)>& notice) {
  ZipArchive archive(path.file);
  const std::vector<NamedArray> arrays = arrays_of(archive);
  return archive.read(*chosen(arrays, path, notice).member, most);
}

}  // namespace parallax

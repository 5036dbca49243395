// SPDX-License-Identifier: Apache-2.0
#include "platform/input/raw_map_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>

#include "platform/images/image_codecs.hpp"
#include "platform/images/image_file.hpp"
#include "platform/input/file_storage.hpp"
#include "platform/results/output_file.hpp"
#include "tlm/error.hpp"

namespace parallax {

namespace {

struct NamedMap {
  const char* name;
  cv::Mat RawMaps::*map;
};
constexpr std::array<NamedMap, 4> kMaps = {{{"left_x", &RawMaps::left_x},
                                            {"left_y", &RawMaps::left_y},
                                            {"right_x", &RawMaps::right_x},
                                            {"right_y", &RawMaps::right_y}}};

cv::Mat matrix(const cv::FileStorage& file, const std::string& path, const char* name) {
  const cv::FileNode node = file[name];
  if (node.empty()) {
    throw UserError(fmt::format("{}: matrix {} is missing", path, name));
  }
  cv::Mat mat;
  try {
    node >> mat;
  } catch (const cv::Exception&) {
    mat.release();
  }
  if (mat.empty()) {
    throw UserError(fmt::format("{}: {} is not a matrix", path, name));
  }
  return mat;
}

// One channel of 32-bit float; a matrix of doubles is rounded.
cv::Mat checked(const cv::Mat& mat, const std::string& where) {
  if (mat.dims != 2 || mat.channels() != 1 || (mat.depth() != CV_32F && mat.depth() != CV_64F)) {
    throw UserError(fmt::format("{}: a map has one channel of 32-bit float", where));
  }
  cv::Mat floats;
  mat.convertTo(floats, CV_32F);
  return floats;
}

void check_sizes(const RawMaps& maps, const std::string& source) {
  for (const NamedMap& named : kMaps) {
    const cv::Mat& map = maps.*named.map;
    if (map.size() != maps.left_x.size()) {
      throw UserError(fmt::format("{}: {} has {}x{} pixels, left_x has {}x{}", source, named.name, map.cols,
                                  map.rows, maps.left_x.cols, maps.left_x.rows));
    }
  }
}

bool is_file_storage(const std::string& extension) {
  return extension == ".yml" || extension == ".yaml" || extension == ".xml" || extension == ".json";
}

// Its user has not named this file, but one that its name is derived from.
bool may_write(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(path, ignored);
  return !std::filesystem::exists(std::filesystem::symlink_status(path, ignored)) ||
         (size == bytes.size() && read_file(path) == bytes);
}

}  // namespace

RawMaps read_raw_maps(const std::vector<std::string>& paths) {
  RawMaps maps;
  if (paths.size() == 1) {
    const cv::FileStorage file = open_file_storage(paths.front());
    for (const NamedMap& named : kMaps) {
      maps.*named.map =
          checked(matrix(file, paths.front(), named.name), fmt::format("{}: {}", paths.front(), named.name));
    }
  } else if (paths.size() == kMaps.size()) {
    for (std::size_t i = 0; i < kMaps.size(); ++i) {
      maps.*kMaps[i].map =
          checked(read_image_file(paths[i], "map", at_most_any_image(paths[i], "map")), paths[i]);
    }
  } else {
    throw UserError(
        fmt::format("raw maps: {} files; one with four matrices, or four images (left x, left y, right x, "
                    "right y) expected",
                    paths.size()));
  }
  check_sizes(maps, fmt::format("{}", fmt::join(paths, " + ")));
  return maps;
}

std::vector<std::string> raw_map_names(const std::string& path) {
  const std::filesystem::path target(path);
  const std::string extension = target.extension().string();
  if (is_file_storage(extension)) return {path};
  if (extension != ".tif" && extension != ".tiff") {
    throw UserError(fmt::format("{}: raw maps are written as .yml, .yaml, .xml, .json, .tif or .tiff", path));
  }
  std::vector<std::string> names;
  for (const NamedMap& named : kMaps) {
    const std::string name = fmt::format("{}_{}{}", target.stem().string(), named.name, extension);
    names.push_back((target.parent_path() / name).string());
  }
  return names;
}

std::vector<std::string> write_raw_maps(const std::string& path, const RawMaps& maps) {
  std::vector<std::string> names = raw_map_names(path);
  const std::string extension = std::filesystem::path(path).extension().string();
  if (is_file_storage(extension)) {
    cv::FileStorage file(extension, cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
    for (const NamedMap& named : kMaps) {
      file << named.name << maps.*named.map;
    }
    write_file(path, file.releaseAndGetString());
    return names;
  }
  std::vector<std::unique_ptr<OutputFile>> files;
  for (std::size_t i = 0; i < kMaps.size(); ++i) {
    const std::vector<std::uint8_t> bytes = encode_image(extension, maps.*kMaps[i].map);
    if (!may_write(names[i], bytes)) {
      throw UserError(
          fmt::format("{} exists and holds something else; move it away, or choose another name than {}",
                      names[i], path));
    }
    remove_abandoned_of(names[i]);
    files.push_back(std::make_unique<OutputFile>(names[i]));
    files.back()->write(bytes.data(), bytes.size());
    files.back()->close();
  }
  for (const auto& file : files) file->publish();
  return names;
}

}  // namespace parallax

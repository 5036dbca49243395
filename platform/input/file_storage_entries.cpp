// SPDX-License-Identifier: Apache-2.0
#include "platform/input/file_storage_entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <opencv2/core.hpp>

#include "platform/input/file_storage.hpp"
#include "platform/input/quoted_text.hpp"
#include "tlm/error.hpp"

namespace parallax {

struct FileStorageEntries::File {
  std::string path;
  cv::FileStorage storage;
};

struct FileStorageEntries::Place {
  std::string name;  ///< "file: entry"
  cv::FileNode node;
};

namespace {

cv::Mat to_mat(const cv::FileNode& node) {
  cv::Mat mat;
  if (node.isInt() || node.isReal()) {
    return cv::Mat(1, 1, CV_64F, cv::Scalar(static_cast<double>(node)));
  }
  if (node.isSeq()) {
    std::vector<double> values;
    for (const cv::FileNode& element : node) {
      if (!element.isInt() && !element.isReal()) {
        return mat;
      }
      values.push_back(static_cast<double>(element));
    }
    return cv::Mat(values, true);
  }
  if (node.isMap()) {
    node >> mat;
  }
  return mat;
}

// A matrix of one channel whose numbers are too few or too many, which OpenCV refuses without saying why.
void check_count(const cv::FileNode& node, const std::string& place) {
  if (!node.isMap()) return;
  const cv::FileNode rows = node["rows"];
  const cv::FileNode columns = node["cols"];
  const cv::FileNode type = node["dt"];
  const cv::FileNode data = node["data"];
  const bool plain = rows.isInt() && columns.isInt() && data.isSeq() && type.isString();
  if (!plain || static_cast<std::string>(type).size() != 1) return;
  const double count = static_cast<double>(rows) * static_cast<double>(columns);
  if (count != static_cast<double>(data.size())) {
    throw UserError(fmt::format("{} has rows: {} and cols: {}, but {} numbers", place, static_cast<int>(rows),
                                static_cast<int>(columns), data.size()));
  }
}

std::vector<double> numbers_at(const cv::FileNode& node, const std::string& place,
                               const std::vector<FileStorageEntries::Shape>& shapes) {
  check_count(node, place);
  cv::Mat mat;
  try {
    mat = to_mat(node);
  } catch (const std::exception&) {
    mat.release();
  }
  if (mat.empty() || mat.dims != 2 || mat.channels() != 1) {
    throw UserError(place + " is not a matrix of numbers");
  }
  const bool fits = std::any_of(shapes.begin(), shapes.end(), [&mat](const auto& shape) {
    return mat.rows == shape.first && mat.cols == shape.second;
  });
  if (!shapes.empty() && !fits) {
    throw UserError(fmt::format("{} has {}x{} elements, {}x{} expected", place, mat.rows, mat.cols,
                                shapes.front().first, shapes.front().second));
  }
  cv::Mat_<double> doubles;
  mat.convertTo(doubles, CV_64F);
  std::vector<double> values(doubles.begin(), doubles.end());
  if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) {
    throw UserError(place + " holds a value that is not a finite number");
  }
  return values;
}

// OpenCV 4.6 takes a comment behind a word of YAML for a part of it.
std::string without_comment(const std::string& text) {
  const std::size_t comment = text.find(" #");
  return comment == std::string::npos ? text : text.substr(0, text.find_last_not_of(' ', comment) + 1);
}

}  // namespace

FileStorageEntries::FileStorageEntries(const std::vector<CalibrationRequest::File>& files) {
  for (const CalibrationRequest::File& file : files) {
    files_.push_back({file.path, parse_file_storage(file.text, file.path)});
  }
}

FileStorageEntries::~FileStorageEntries() = default;

std::vector<FileStorageEntries::Place> FileStorageEntries::places(const Names& names) const {
  std::vector<Place> found;
  for (const File& file : files_) {
    for (const std::string& name : names) {
      const cv::FileNode node = file.storage[name];
      if (!node.empty()) found.push_back({fmt::format("{}: {}", file.path, name), node});
    }
  }
  return found;
}

bool FileStorageEntries::has(const Names& names) const { return !places(names).empty(); }

std::string FileStorageEntries::where(const Names& names) const {
  const std::vector<Place> found = places(names);
  if (!found.empty()) return found.front().name;
  std::string all;
  for (const File& file : files_) all += (all.empty() ? "" : " + ") + file.path;
  return fmt::format("{}: {}", all, names.front());
}

void FileStorageEntries::missing(const Names& names) const { throw UserError(where(names) + " is missing"); }

std::vector<double> FileStorageEntries::numbers(const Names& names, const std::vector<Shape>& shapes) const {
  const std::vector<Place> found = places(names);
  if (found.empty()) missing(names);
  std::vector<double> values = numbers_at(found.front().node, found.front().name, shapes);
  for (const Place& other : found) {
    if (numbers_at(other.node, other.name, shapes) != values) {
      throw UserError(fmt::format("{} contradicts {}", found.front().name, other.name));
    }
  }
  return values;
}

std::string FileStorageEntries::text(const Names& names, const std::string& otherwise) const {
  std::optional<std::string> text;
  for (const Place& place : places(names)) {
    if (!place.node.isString()) throw UserError(place.name + " is not a text");
    const std::string here = without_comment(static_cast<std::string>(place.node));
    if (text && *text != here) {
      throw UserError(fmt::format("{} contradicts the same entry elsewhere: {} and {}", place.name,
                                  in_quotes(here), in_quotes(*text)));
    }
    text = here;
  }
  return text.value_or(otherwise);
}

}  // namespace parallax

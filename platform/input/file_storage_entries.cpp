// SPDX-License-Identifier: Apache-2.0
#include "platform/input/calibration_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "platform/input/file_storage.hpp"
#include "tlm/error.hpp"

namespace parallax {

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

}  // namespace

CalibrationFile::CalibrationFile(const std::vector<std::string>& paths)
    : name_(fmt::format("{}", fmt::join(paths, " + "))) {
  for (const std::string& path : paths) {
    files_.push_back(open_file_storage(path));
  }
}

cv::FileNode CalibrationFile::find(const Names& names) const {
  for (const cv::FileStorage& file : files_) {
    for (const std::string& name : names) {
      const cv::FileNode node = file[name];
      if (!node.empty()) {
        return node;
      }
    }
  }
  return {};
}

bool CalibrationFile::has(const Names& names) const { return !find(names).empty(); }

std::vector<double> CalibrationFile::numbers(const Names& names, const std::vector<Shape>& shapes) const {
  const cv::FileNode node = find(names);
  if (node.empty()) {
    throw UserError(fmt::format("{}: {} is missing", name_, names.front()));
  }
  cv::Mat mat;
  try {
    mat = to_mat(node);
  } catch (const cv::Exception&) {
    mat.release();
  }
  if (mat.empty() || mat.dims != 2 || mat.channels() != 1) {
    throw UserError(fmt::format("{}: {} is not a matrix of numbers", name_, node.name()));
  }
  bool fits = shapes.empty();
  for (const auto& [rows, columns] : shapes) {
    fits |= mat.rows == rows && mat.cols == columns;
  }
  if (!fits) {
    throw UserError(fmt::format("{}: {} has {}x{} elements, {}x{} expected", name_, node.name(), mat.rows,
                                mat.cols, shapes.front().first, shapes.front().second));
  }
  cv::Mat_<double> doubles;
  mat.convertTo(doubles, CV_64F);
  std::vector<double> values(doubles.begin(), doubles.end());
  for (const double value : values) {
    if (!std::isfinite(value)) {
      throw UserError(fmt::format("{}: {} holds a value that is not a finite number", name_, node.name()));
    }
  }
  return values;
}

std::string CalibrationFile::text(const Names& names, const std::string& otherwise) const {
  const cv::FileNode node = find(names);
  if (node.empty()) {
    return otherwise;
  }
  if (!node.isString()) {
    throw UserError(fmt::format("{}: {} is not a text", name_, node.name()));
  }
  return static_cast<std::string>(node);
}

}  // namespace parallax

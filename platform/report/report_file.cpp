// SPDX-License-Identifier: Apache-2.0
#include "platform/report/report_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "platform/config/preset.hpp"
#include "platform/images/image_codecs.hpp"
#include "platform/images/image_file.hpp"
#include "platform/report/run_report.hpp"
#include "platform/results/result_images.hpp"
#include "platform/validation/published_row.hpp"
#include "platform/validation/validation.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"
#include "traces/report/report_page.hpp"

namespace parallax {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kWidestImage = 960;  // px; a page of full-size images of the largest format would be 20 MB

struct PageImage {
  const char* file;
  const char* title;
  const char* caption;
};
constexpr PageImage kImages[] = {
    {"left_rectified.png", "Left image", "rectified"},
    {"disparity_color.png", "Disparity", "far is blue, near is red"},
    {"causes.png", "Who invalidated what", "the stage that took a pixel's disparity away"},
    {"error.png", "Error against the ground truth", ""},
};

// The page's copy of an image of a run, no larger than the page wants it.
cv::Mat page_image(const fs::path& path) {
  cv::Mat image = read_image_file(path.string(), "result", at_most_any_image(path.string(), "result"));
  const double scale = std::min(1.0, static_cast<double>(kWidestImage) / image.cols);
  // A low image keeps a row.
  const cv::Size size(std::max(1, cvRound(image.cols * scale)), std::max(1, cvRound(image.rows * scale)));
  if (scale < 1) cv::resize(image, image, size, 0, 0, cv::INTER_AREA);
  return image;
}

bool is_gif(const std::vector<std::uint8_t>& bytes) {
  constexpr std::uint8_t kTrailer = 0x3B;
  return bytes.size() > 6 && std::string(bytes.begin(), bytes.begin() + 4) == "GIF8" &&
         bytes.back() == kTrailer;
}

std::vector<ReportImage> images_of(const fs::path& folder) {
  std::error_code error;
  std::string frame;
  if (fs::exists(folder / "frame_0000", error)) frame = "frame_0000";
  std::vector<ReportImage> images;
  for (const PageImage& wanted : kImages) {
    const fs::path path = folder / frame / wanted.file;
    if (!fs::exists(path, error)) continue;  // error.png comes with a ground truth
    const cv::Mat image = page_image(path);
    images.push_back({wanted.title, fmt::format("{}{}", wanted.caption, frame.empty() ? "" : ", first frame"),
                      "image/png", encode_image(".png", image)});
  }
  // A strip is small, but grows with the frames.
  constexpr std::uintmax_t kLargestStrip = 8 << 20;
  const fs::path strip = folder / "strip.gif";
  if (fs::exists(strip, error) && fs::file_size(strip, error) <= kLargestStrip) {
    std::ifstream in(strip, std::ios::binary);
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in),
                                          std::istreambuf_iterator<char>()};
    if (!is_gif(bytes))
      throw UserError(
          fmt::format("cannot read result {}: it is damaged; run parallax again", strip.string()));
    images.push_back({"All frames", "left image and disparity", "image/gif", bytes});
  }
  return images;
}

// Whether the run, of the row's preset, has its size and what it sets.
bool is_of(const PublishedRow& row, const RunReport& report) {
  const MetricGroup& input = report.metrics.group_at("input");
  if (row.width != input.count("width") || row.height != input.count("height")) return false;
  return std::all_of(row.assignments.begin(), row.assignments.end(), [&](const std::string& assignment) {
    const std::size_t equals = assignment.find('=');
    std::string path = "/" + assignment.substr(0, equals);
    std::replace(path.begin(), path.end(), '.', '/');
    const Json::json_pointer pointer(path);
    if (!report.configuration.contains(pointer)) return false;
    const Json& value = report.configuration.at(pointer);
    return (value.is_string() ? value.get<std::string>() : json_text(value)) == assignment.substr(equals + 1);
  });
}

std::vector<BudgetLine> budget_of(const RunReport& report) {
  std::vector<BudgetLine> budget;
  const bool has_rate = report.metrics.find_group("performance") != nullptr;
  const std::string preset = report.configuration.value("preset", "");
  for (const std::string& name : published_row_files()) {
    const PublishedRows file = read_published_rows(name, preset_folders());
    for (const PublishedRow& row : file.rows) {
      if ((row.preset.empty() ? file.preset : row.preset) != preset || row.refused) continue;
      BudgetLine line{row.name, row.source, row.metric, row.unit, row.published};
      const std::size_t slash = line.metric.rfind('/');
      if (slash != std::string::npos) line.metric.erase(0, slash + 1);
      if (has_rate && is_of(row, report)) {
        line.reached = predicted(row, report.metrics);
        line.deviation = row.deviation(*line.reached);
        line.within = row.allows(line.deviation);
      }
      budget.push_back(std::move(line));
    }
  }
  return budget;
}

}  // namespace

std::string report_of(const fs::path& folder) {
  const RunReport report = read_run_report(folder.string());
  ReportInput input;
  input.metrics = report.metrics;
  input.configuration = report.configuration;
  input.profile = read_result_json((folder / "profile.json").string());
  input.relaxations = read_result_json((folder / "relaxations.json").string());
  try {
    input.images = images_of(folder);
    input.budget = budget_of(report);
    return report_page(input);
  } catch (const MetricError& error) {
    throw UserError(fmt::format("{}: its timing.json or relaxations.json is damaged, {}; run parallax again",
                                folder.string(), excerpt(error.what(), 200)));
  } catch (const Json::exception&) {
    // What is no metric: the configuration, the profile, the list of relaxations.
    throw UserError(
        fmt::format("{}: its timing.json, profile.json or relaxations.json is damaged; run parallax again",
                    folder.string()));
  }
}

}  // namespace parallax

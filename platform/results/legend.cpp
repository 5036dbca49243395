// SPDX-License-Identifier: Apache-2.0
#include "platform/results/legend.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace parallax {
namespace {

constexpr int kNarrowest = 96;    // px: narrower pictures have no room for text
constexpr int kReadableAt = 512;  // px: wider pictures are looked at from farther away
constexpr int kTextHeight = 9;    // px, of OpenCV's Hershey font at kTextScale
constexpr double kTextScale = 0.4;
constexpr int kMargin = 4;      // px
constexpr int kSwatch = 10;     // px
constexpr int kRow = 20;        // px, of names
constexpr int kBarHeight = 12;  // px
constexpr int kTick = 4;        // px
constexpr int kMostTicks = 12;
constexpr int kTickGap = 10;  // px, between two numbers
constexpr int kPanelGap = 8;  // px, between two pictures

const cv::Scalar kInk(255, 255, 255);
const cv::Scalar kPaper(0, 0, 0);

/// Sizes in a picture `width` px wide.
class Zoom {
 public:
  explicit Zoom(int width) : factor_(std::clamp(width / double{kReadableAt}, 1.0, 4.0)) {}

  int operator()(int pixels) const { return static_cast<int>(std::lround(factor_ * pixels)); }

  /// How thick a line is.
  int line() const { return static_cast<int>(factor_); }

  int text_width(const std::string& text) const {
    int baseline = 0;
    return cv::getTextSize(text, kFont, kTextScale * factor_, line(), &baseline).width;
  }

  /// `middle`: of the row of text.
  void put_text(cv::Mat& image, const std::string& text, int left, int middle) const {
    cv::putText(image, text, {left, middle + (*this)(kTextHeight) / 2}, kFont, kTextScale * factor_, kInk,
                line(), cv::LINE_AA);
  }

 private:
  static constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
  double factor_;
};

std::string tick_text(const LegendScale& scale, int value) {
  return std::to_string(value) + (scale.open && value == scale.colors.highest() ? "+" : "");
}

int widest_tick(const LegendScale& scale, const Zoom& zoom) {
  return std::max(zoom.text_width(tick_text(scale, scale.colors.lowest())),
                  zoom.text_width(tick_text(scale, scale.colors.highest())));
}

cv::Mat draw_scale(const LegendScale& scale, int width) {
  const Zoom zoom(width);
  const ScalePlace place = scale_place(scale, width);
  const int tick_end = place.bottom + zoom(kTick);
  cv::Mat image(tick_end + zoom(kMargin + kTextHeight), width, CV_8UC3, kPaper);
  const auto& colors = scale.colors.colors();
  for (int x = place.first; x <= place.last; ++x) {
    const double share = static_cast<double>(x - place.first) / std::max(1, place.last - place.first);
    const std::size_t color = std::lround(share * static_cast<double>(colors.size() - 1));
    image(cv::Rect(x, place.top, 1, place.bottom - place.top + 1)) = cv::Scalar(colors[color]);
  }
  const int room = std::max(widest_tick(scale, zoom) + zoom(kTickGap), (width - 1) / kMostTicks);
  for (const int value :
       scale_ticks(scale.colors.lowest(), scale.colors.highest(), (place.last - place.first) / room + 1)) {
    const int x = place.column(scale, value);
    image(cv::Rect(x - zoom.line() / 2, place.bottom + 1, zoom.line(), tick_end - place.bottom)) = kInk;
    const std::string text = tick_text(scale, value);
    zoom.put_text(image, text, x - zoom.text_width(text) / 2, image.rows - zoom(kTextHeight) / 2 - 1);
  }
  return image;
}

/// The scale's title and the names of colours, in columns.
cv::Mat draw_names(const Legend& legend, int width) {
  const Zoom zoom(width);
  const int indent = zoom(kMargin + kSwatch + kMargin);
  int column_width = legend.scale ? zoom(kMargin) + zoom.text_width(legend.scale->title) : 0;
  for (const LegendEntry& entry : legend.entries) {
    column_width = std::max(column_width, indent + zoom.text_width(entry.name));
  }
  const int cells = static_cast<int>(legend.entries.size()) + (legend.scale ? 1 : 0);
  column_width += zoom(kMargin);
  const int columns = std::clamp(width / column_width, 1, std::max(1, cells));
  cv::Mat image((cells + columns - 1) / columns * zoom(kRow), width, CV_8UC3, kPaper);
  int cell = 0;
  const auto next = [&] {
    const cv::Point corner(cell % columns * column_width, cell / columns * zoom(kRow));
    ++cell;
    return corner;
  };
  if (legend.scale) {
    const cv::Point corner = next();
    zoom.put_text(image, legend.scale->title, corner.x + zoom(kMargin), corner.y + zoom(kRow) / 2);
  }
  for (const LegendEntry& entry : legend.entries) {
    const cv::Point corner = next();
    const cv::Rect swatch(corner.x + zoom(kMargin), corner.y + (zoom(kRow) - zoom(kSwatch)) / 2,
                          zoom(kSwatch), zoom(kSwatch));
    cv::rectangle(image, swatch, cv::Scalar(entry.color), cv::FILLED);
    cv::rectangle(image, swatch, kInk, zoom.line());  // so that black shows on black
    zoom.put_text(image, entry.name, corner.x + indent, corner.y + zoom(kRow) / 2);
  }
  return image;
}

}  // namespace

std::vector<int> scale_ticks(int lowest, int highest, int most) {
  if (lowest == highest) return {lowest};
  for (int decade = 1;; decade *= 10) {
    for (const int digit : {1, 2, 5}) {
      const int step = digit * decade;
      std::vector<int> ticks{lowest};
      // An end takes the place of what lies closer to it than a step.
      const int first = (lowest + step - 1) / step * step;
      for (int tick = first; tick <= highest - step; tick += step) {
        if (tick - lowest >= step) ticks.push_back(tick);
      }
      ticks.push_back(highest);
      if (static_cast<int>(ticks.size()) <= most || ticks.size() == 2) return ticks;
    }
  }
}

int ScalePlace::column(const LegendScale& scale, int value) const {
  const int span = std::max(1, scale.colors.highest() - scale.colors.lowest());
  return first + static_cast<int>(
                     std::lround(static_cast<double>(value - scale.colors.lowest()) / span * (last - first)));
}

ScalePlace scale_place(const LegendScale& scale, int width) {
  const Zoom zoom(width);
  const int side = zoom(kMargin) + (widest_tick(scale, zoom) + 1) / 2;  // numbers are centred on their ticks
  const int top = zoom(kMargin);
  return {side, width - 1 - side, top, top + zoom(kBarHeight) - 1};
}

cv::Mat draw_legend(const Legend& legend, int width) {
  cv::Mat image(0, width, CV_8UC3);
  if (width < kNarrowest) return image;
  if (legend.scale) image.push_back(draw_scale(*legend.scale, width));
  image.push_back(draw_names(legend, width));
  return image;
}

cv::Mat with_legend(const cv::Mat& picture, const Legend& legend) {
  cv::Mat image = picture.clone();
  image.push_back(draw_legend(legend, picture.cols));
  return image;
}

cv::Mat side_by_side(const cv::Mat& left, const std::string& left_caption, const cv::Mat& right,
                     const std::string& right_caption, const Legend& legend) {
  const int width = 2 * left.cols + kPanelGap;
  const int right_at = left.cols + kPanelGap;
  const Zoom zoom(width);
  const int top = left.cols < kNarrowest ? 0 : zoom(kRow);
  cv::Mat image(top + left.rows, width, CV_8UC3, kPaper);
  if (top > 0) {
    zoom.put_text(image, left_caption, zoom(kMargin), top / 2);
    zoom.put_text(image, right_caption, right_at + zoom(kMargin), top / 2);
  }
  left.copyTo(image(cv::Rect({0, top}, left.size())));
  right.copyTo(image(cv::Rect({right_at, top}, right.size())));
  return with_legend(image, legend);
}

}  // namespace parallax

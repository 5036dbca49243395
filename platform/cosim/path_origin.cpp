// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/path_origin.hpp"

#include <fmt/format.h>

#include <set>
#include <string>
#include <vector>

#include "modules/path_step.hpp"

namespace parallax {
namespace {

constexpr std::size_t kMostNamed = 4;  // disparities, one by one

class OriginSearch {
 public:
  OriginSearch(const TokenComparison& comparison, const PathStep& step, const TokenWords& expected,
               const TokenWords& got)
      : manifest_(*comparison.manifest),
        stream_(*comparison.stream),
        step_(step),
        width_(manifest_.tile_width),
        height_(manifest_.height) {
    const std::uint64_t groups = stream_.shape.tokens_per_pixel;
    differs_.resize((comparison.compared_tokens + groups - 1) / groups);
    const auto each = [&](const auto& take) { for_each_difference(stream_, expected, got, take); };
    each([&](std::uint64_t token, std::size_t) { differs_[token / groups] = true; });
    each([&](std::uint64_t token, std::size_t field) {
      if (!begins(token / groups)) return;
      const ValuePlace place = manifest_.place(stream_, token, field);
      disparities_.insert(place.disparity);
      lanes_.insert(field);
      rows_.insert(place.row);
      columns_.insert(place.column);
    });
  }

  std::string text() const {
    std::string where = where_in_image();
    const std::string disparities = which_disparities();
    if (where.empty() && disparities.empty()) return "";
    if (!where.empty() && !disparities.empty()) where = ", " + where;
    return fmt::format("it goes wrong {}{}; all else that differs lies behind a pixel that does", disparities,
                       where);
  }

 private:
  // Whether the pixel before pixel `at` is equal, or there is none.
  bool begins(std::uint64_t at) const {
    const std::uint64_t in_pass = at % (width_ * height_);
    const int before = step_.predecessor(static_cast<int>(in_pass % width_),
                                         static_cast<int>(in_pass / width_), static_cast<int>(width_));
    return before < 0 || !differs_[at - in_pass + before];
  }

  std::string which_disparities() const {
    const std::size_t all = stream_.shape.tokens_per_pixel * stream_.shape.format.all().size();
    if (disparities_.size() < all && disparities_.size() <= kMostNamed) {
      std::string text = disparities_.size() == 1 ? "at disparity " : "at disparities ";
      for (const std::int64_t disparity : disparities_)
        text += fmt::format("{}{}", disparity == *disparities_.begin() ? "" : ", ", disparity);
      return text;
    }
    if (lanes_.size() == 1 && stream_.shape.format.all().size() > 1)
      return fmt::format("in field {}", stream_.shape.format.all()[*lanes_.begin()].name);
    return "";
  }

  std::string where_in_image() const {
    const bool up = stream_.shape.order == ScanOrder::kTurned;
    const std::int64_t second = up ? height_ - 2 : 1;
    std::string text;
    if (rows_.size() == 1) {
      text = fmt::format("in row {}", *rows_.begin());
    } else if ((up ? *rows_.rbegin() : *rows_.begin()) == second) {
      text = fmt::format("from row {} {}", second, up ? "upwards" : "on");
    }
    if (columns_.size() == 1)
      text += fmt::format("{}in column {}", text.empty() ? "" : ", ", *columns_.begin());
    return text;
  }

  const VectorManifest& manifest_;
  const VectorStream& stream_;
  const PathStep step_;
  const std::int64_t width_, height_;
  std::vector<bool> differs_;  // for each pixel, in the order of the stream
  std::set<std::int64_t> disparities_, rows_, columns_;
  std::set<std::size_t> lanes_;
};

}  // namespace

std::optional<DifferencePattern> find_path_origin(const TokenComparison& comparison,
                                                  const TokenWords& expected, const TokenWords& got) {
  const std::optional<PathStep>& step = comparison.stream->shape.path;
  if (!step || comparison.different_tokens == 0) return std::nullopt;
  const std::string text = OriginSearch(comparison, *step, expected, got).text();
  if (text.empty()) return std::nullopt;
  return DifferencePattern{"path_origin", text};
}

}  // namespace parallax

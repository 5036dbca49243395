// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/path_sums.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "platform/cosim/pattern_evidence.hpp"

namespace parallax {
namespace {

constexpr unsigned kMostShift = 11;  // matching.sum_shift

// The costs of a path, token by token as the sums are.
struct PathWords {
  const VectorStream* stream;
  TokenWords words;
};

// Another sum: without one path, and with another one. -1: none.
struct Mistake {
  int without, with;
};

class SumSearch {
 public:
  SumSearch(const TokenComparison& comparison, const TokenWords& expected, const TokenWords& got,
            std::vector<PathWords> paths)
      : manifest_(*comparison.manifest),
        stream_(*comparison.stream),
        mask_((std::uint64_t{1} << stream_.shape.format.all().front().width) - 1),
        expected_(expected),
        got_(got),
        tokens_(comparison.compared_tokens),
        paths_(std::move(paths)),
        costs_(paths_.size()) {}

  std::string text() {
    std::vector<Mistake> found;
    for (shift_ = 0; found.empty() && shift_ <= kMostShift; ++shift_)
      found = explaining(all_mistakes(), false);
    if (found.empty()) return "";
    --shift_;
    const std::vector<Mistake> everywhere = explaining(found, true);
    std::vector<std::string> texts;
    for (const Mistake& mistake : everywhere.empty() ? found : everywhere) texts.push_back(text(mistake));
    return fmt::format("{}{}", fmt::join(texts, ", or "), everywhere.empty() ? ", where they differ" : "");
  }

 private:
  std::vector<Mistake> all_mistakes() const {
    const auto count = static_cast<int>(paths_.size());
    std::vector<Mistake> all;
    for (int i = 0; i < count; ++i) all.push_back({i, -1});
    for (int i = 0; i < count; ++i) all.push_back({-1, i});
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) {
        if (i != j) all.push_back({i, j});
      }
    }
    return all;
  }

  // Those of the mistakes that explain each value that differs, or each at all.
  std::vector<Mistake> explaining(std::vector<Mistake> left, bool also_equal) {
    const std::vector<TokenField>& fields = stream_.shape.format.all();
    for (std::uint64_t token = 0; token < tokens_ && !left.empty(); ++token) {
      if (!also_equal && expected_.same(token, got_, token)) continue;
      for (std::size_t field = 0; field < fields.size() && !left.empty(); ++field) {
        const std::uint64_t expected = expected_.raw(token, fields[field]),
                            got = got_.raw(token, fields[field]);
        if (got_.unknown(token, fields[field])) return {};
        if (!also_equal && expected == got) continue;
        const std::uint64_t sum = add_up(token, field);
        if (sum >> shift_ != expected) return {};
        left.erase(std::remove_if(left.begin(), left.end(),
                                  [&](const Mistake& mistake) { return with(mistake, sum) != got; }),
                   left.end());
      }
    }
    return left;
  }

  // The sum of the paths' costs, which are then in costs_.
  std::uint64_t add_up(std::uint64_t token, std::size_t field) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      const VectorStream& path = *paths_[i].stream;
      costs_[i] = paths_[i].words.raw(same_group(path, token), path.shape.format.all()[field]);
      sum += costs_[i];
    }
    return sum;
  }

  std::uint64_t with(const Mistake& mistake, std::uint64_t sum) const {
    if (mistake.without >= 0) sum -= costs_[static_cast<std::size_t>(mistake.without)];
    if (mistake.with >= 0) sum += costs_[static_cast<std::size_t>(mistake.with)];
    return sum >> shift_ & mask_;
  }

  // The token of a path with the costs of the same pixel and disparities: in another order of pixels perhaps.
  std::uint64_t same_group(const VectorStream& path, std::uint64_t token) const {
    const std::uint64_t row_tokens = stream_.shape.row_tokens;
    const std::uint64_t groups = stream_.shape.tokens_per_pixel;
    const auto height = static_cast<std::uint64_t>(manifest_.height);
    std::uint64_t row = token / row_tokens;  // of all tiles and frames
    std::uint64_t pixel = token % row_tokens / groups;
    if (path.shape.order == ScanOrder::kTurned) row += height - 1 - 2 * (row % height);
    if (path.shape.order != ScanOrder::kRaster) pixel = row_tokens / groups - 1 - pixel;
    return row * row_tokens + pixel * groups + token % groups;
  }

  std::string name(int path) const {
    std::string text = paths_[static_cast<std::size_t>(path)].stream->name;
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
  }
  std::string text(const Mistake& mistake) const {
    if (mistake.with < 0) return name(mistake.without) + " is missing";
    if (mistake.without < 0) return name(mistake.with) + " is there twice";
    return fmt::format("{} stands in the place of {}", name(mistake.with), name(mistake.without));
  }

  const VectorManifest& manifest_;
  const VectorStream& stream_;
  const std::uint64_t mask_;
  const TokenWords& expected_;
  const TokenWords& got_;
  const std::uint64_t tokens_;  // that both have
  const std::vector<PathWords> paths_;
  std::vector<std::uint64_t> costs_;  // of the paths, of one value
  unsigned shift_ = 0;
};

}  // namespace

std::optional<DifferencePattern> find_one_path(const TokenComparison& comparison, const TokenWords& expected,
                                               const TokenWords& got, const std::filesystem::path& folder) {
  const VectorStream& stream = *comparison.stream;
  if (stream.is_tap || !stream.shape.first_disparity || comparison.different_tokens < kLeastExplained)
    return std::nullopt;
  std::vector<PathWords> paths;
  for (const VectorStream& tap : comparison.manifest->streams) {
    if (!tap.shape.path) continue;
    const std::filesystem::path file = folder / tap.file;
    if (!std::filesystem::exists(file)) return std::nullopt;
    paths.push_back({&tap, read_vectors(file.string(), tap)});
  }
  if (paths.empty()) return std::nullopt;
  const std::string text = SumSearch(comparison, expected, got, std::move(paths)).text();
  if (text.empty()) return std::nullopt;
  return DifferencePattern{"one_path", text};
}

}  // namespace parallax

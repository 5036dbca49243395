// SPDX-License-Identifier: Apache-2.0
// Vectors with random values, and dumps that are these, altered by a simple function.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "modules/token_formats.hpp"
#include "platform/cosim/token_comparison.hpp"

namespace parallax::test {

using Words = std::vector<std::vector<std::uint64_t>>;  // the fields of each token

inline VectorManifest image_manifest(const TokenShape& shape, int width, int height, std::int64_t frames) {
  VectorManifest manifest;
  manifest.stage = "census";
  manifest.width = manifest.tile_width = width;
  manifest.height = height;
  manifest.tile_begins = {0};
  manifest.frames = frames;
  VectorStream stream;
  stream.name = "left_codes";
  stream.port = "out_left";
  stream.shape = shape;
  stream.frame_tokens = shape.row_tokens * static_cast<std::uint64_t>(height);
  stream.tokens = stream.frame_tokens * static_cast<std::uint64_t>(frames);
  manifest.streams.push_back(stream);
  return manifest;
}

/// A token a pixel.
inline TokenShape image_of(const TokenFormat& format, int width) {
  TokenShape shape(format);
  shape.row_tokens = static_cast<std::uint64_t>(width);
  return shape;
}

inline TokenShape codes(int width, std::size_t bits) { return image_of(census_code_format(bits), width); }

inline TokenShape costs(int width, std::uint64_t groups, std::size_t parallelism) {
  TokenShape shape(cost_group_format(parallelism, 9));
  shape.row_tokens = static_cast<std::uint64_t>(width) * groups;
  shape.tokens_per_pixel = groups;
  shape.first_disparity = 10;
  return shape;
}

inline TokenWords packed(const VectorStream& stream, const Words& words) {
  TokenWords out(stream.shape.format.width().size());
  for (const std::vector<std::uint64_t>& word : words) {
    out.append();
    for (std::size_t i = 0; i < word.size(); ++i) out.set(stream.shape.format.all()[i], word[i]);
  }
  return out;
}

class AlteredDump : public ::testing::Test {
 protected:
  void make(const TokenShape& shape, int width, int height, std::int64_t frames = 1) {
    manifest_ = image_manifest(shape, width, height, frames);
    std::mt19937 random(7);
    words_.clear();
    for (std::uint64_t token = 0; token < stream().tokens; ++token) {
      std::vector<std::uint64_t> word;
      for (const TokenField& field : shape.format.all())
        word.push_back(random() & ((std::uint64_t{1} << field.width) - 1));
      words_.push_back(word);
    }
  }
  const VectorStream& stream() const { return manifest_.streams.front(); }

  TokenComparison compare(const Words& got) const {
    return compare_tokens(manifest_, stream(), packed(stream(), words_), {packed(stream(), got), {}});
  }
  /// The first pattern's name where `change` alters the values of a pixel's fields.
  using Change = std::function<std::uint64_t(const ValuePlace& place, std::uint64_t value)>;
  std::string pattern(const Change& change) const { return first_pattern(changed(change)); }
  /// All that is said of it.
  std::string said(const Change& change) const { return said(changed(change)); }
  std::string said(const Words& got) const {
    std::string all;
    for (const DifferencePattern& one : compare(got).patterns) all += (all.empty() ? "" : "; ") + one.text;
    return all;
  }
  Words changed(const Change& change) const {
    Words got = words_;
    for (std::uint64_t token = 0; token < got.size(); ++token) {
      for (std::size_t field = 0; field < got[token].size(); ++field) {
        const std::size_t width = stream().shape.format.all()[field].width;
        got[token][field] = change(manifest_.place(stream(), token, field), got[token][field]) &
                            ((std::uint64_t{1} << width) - 1);
      }
    }
    return got;
  }
  std::string first_pattern(const Words& got) const {
    const TokenComparison comparison = compare(got);
    return comparison.patterns.empty() ? "" : comparison.patterns.front().name;
  }
  Words shifted(std::int64_t late) const {
    Words got = words_;
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(got.size()); ++i) {
      const std::int64_t from = i - late;
      got[i] = from < 0 || from >= static_cast<std::int64_t>(got.size())
                   ? std::vector<std::uint64_t>(got[i].size())
                   : words_[from];
    }
    return got;
  }

  VectorManifest manifest_;
  Words words_;
};

}  // namespace parallax::test

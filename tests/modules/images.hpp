// SPDX-License-Identifier: Apache-2.0
// Images, and rows through kernels, for the tests of the stages from census to consistency.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace parallax::test {

/// A whole image, row by row; `depth` values a pixel.
template <class T>
struct Grid {
  Grid(int columns, int rows, int values = 1)
      : width(columns),
        height(rows),
        depth(values),
        data(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) *
             static_cast<std::size_t>(values)) {}

  T& at(int x, int y, int k = 0) { return data[index(x, y, k)]; }
  const T& at(int x, int y, int k = 0) const { return data[index(x, y, k)]; }
  const T* row(int y) const { return data.data() + index(0, y, 0); }

  std::size_t index(int x, int y, int k) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(depth) +
           static_cast<std::size_t>(k);
  }

  int width;
  int height;
  int depth;
  std::vector<T> data;
};

template <class T>
bool operator==(const Grid<T>& a, const Grid<T>& b) {
  return a.width == b.width && a.height == b.height && a.depth == b.depth && a.data == b.data;
}

/// Collects what a kernel emits: `push(y, emit)` gives it row y. A wrong number of rows makes it unequal to
/// any whole image.
template <class T, class Push>
Grid<T> collect(int width, int height, int depth, Push push) {
  Grid<T> out(width, height, depth);
  out.data.clear();
  const auto row_values = static_cast<std::size_t>(width) * static_cast<std::size_t>(depth);
  for (int y = 0; y < height; ++y) {
    push(y, [&](const T* row) { out.data.insert(out.data.end(), row, row + row_values); });
  }
  return out;
}

/// Random values 0..top.
template <class T>
Grid<T> random_grid(int width, int height, int depth, std::uint64_t top, std::uint32_t seed) {
  Grid<T> grid(width, height, depth);
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::uint64_t> value(0, top);
  for (T& v : grid.data) v = static_cast<T>(value(random));
  return grid;
}

}  // namespace parallax::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace parallax {

/// What --ground-truth names: a file, or an array in an archive of NumPy, FILE.npz:NAME.
struct TruthPath {
  std::string file;
  std::string array;  ///< empty when none is named
};

/// A path that exists is a file, whatever its name; else what is before a colon may be one.
TruthPath truth_path(const std::string& text);

/// The bytes of an array (.npy) of an archive that numpy.savez wrote, `most` at most: the one that is named,
/// the only one, or the one whose name says that it holds disparities (disparity, disp, arr_0, ...), which
/// `notice` hears of. Throws UserError, which lists the arrays, when that does not say which.
std::vector<std::uint8_t> truth_array(const TruthPath& path, std::uint64_t most,
                                      const std::function<void(const std::string&)>& notice);

}  // namespace parallax

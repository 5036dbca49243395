// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace parallax {

/// How a data set tells the left image from the right one. A new layout is one row of the table.
struct FolderLayout {
  enum class Kind {
    kFolders,    ///< a folder for each side, with scenes below or without; the files go by one name, or by
                 ///< names that differ as the folders' do
    kFoldersOf,  ///< any two folders whose names differ in this word
    kWholeName,  ///< the stem of the file is the token
    kPrefix,     ///< the stem begins with the token
    kSuffix,     ///< the stem ends with it
    kAnywhere,   ///< the stem has it somewhere, the last time counts
  };
  /// An exact layout comes before a word, a word before a letter.
  enum class Strength { kExact, kWord, kLetter };

  Kind kind;
  Strength strength;
  std::string left;  ///< of kFolders with slashes for folders in folders
  std::string right;
  bool any_case = true;
};

const std::vector<FolderLayout>& folder_layouts();

/// What the table looks for, for a message.
std::string folder_layouts_text();

}  // namespace parallax

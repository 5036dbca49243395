// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace parallax {

/// What OpenCV 4.6 would do with a text of YAML, seen before it does.
struct OpenCvYaml {
  /// How deep its parser goes down, as far as it comes: what is malformed ends it.
  std::size_t depth = 0;
  /// Where the text goes on behind the end of its first document, or on the line of a document's mark (---,
  /// ...): OpenCV 4.6 leaves such entries out without a word, and from some texts it does not come back.
  /// Empty when it does not; "line 3: ..." else.
  std::string fault;
};

/// Follows a text as the parser does, without going down itself.
OpenCvYaml look_at_opencv_yaml(std::string_view text);

}  // namespace parallax

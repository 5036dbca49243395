// SPDX-License-Identifier: Apache-2.0
#include "platform/results/result_names.hpp"

#include <regex>

namespace parallax {

bool is_result_name(const std::string& path) {
  static const std::regex names(
      "(frame_[0-9]{4,}/)?"
      "(disparity|disparity_color|causes|cause_labels|left_rectified|side_by_side|error)\\.png"
      "|(frame_[0-9]{4,}/)?(disparity\\.bin|points\\.ply)"
      "|(point_[0-9]{4,}/)?timing\\.json"
      "|(profile|relaxations)\\.json|report\\.html|strip\\.gif"
      "|trace\\.(pftrace|vcd|json)|trace_(rows|fifos|ports|frames|firings|tokens|bursts)\\.csv");
  return std::regex_match(path, names);
}

}  // namespace parallax

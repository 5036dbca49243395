// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace parallax {

/// A directed graph to be drawn as SVG, from top to bottom.
struct Diagram {
  enum class Mark { kNone, kLimits, kWaits };

  struct Share {
    std::string style;  ///< a class of report.css
    double share = 0;   ///< 0..1
    std::string text;   ///< what it says: "9.8 %"
  };
  struct Node {
    std::string id;
    std::string title;
    std::string line;           ///< below the title
    std::string target;         ///< id on the page that it leads to; empty: it leads nowhere
    std::vector<Share> shares;  ///< a bar; empty: none
    Mark mark = Mark::kNone;
  };
  struct Gauge {
    double fill = 0;  ///< 0..1
    double peak = 0;  ///< 0..1, a mark
  };
  struct Edge {
    std::string from;
    std::string to;
    std::string title;
    std::string line;            ///< beside the gauge
    std::optional<Gauge> gauge;  ///< none: not a FIFO
    Mark mark = Mark::kNone;
  };
  std::vector<Node> nodes;
  std::vector<Edge> edges;
};

/// `label` says what it shows, for those who do not see it. Throws std::runtime_error when the layout fails.
std::string draw(const Diagram& diagram, const std::string& label);

}  // namespace parallax

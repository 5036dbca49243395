// SPDX-License-Identifier: Apache-2.0
#include "traces/report/diagram.hpp"

#include <fmt/format.h>
#include <gvc.h>

#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "traces/report/html.hpp"

namespace parallax {
namespace {

// Sizes in the unit of the picture, which is a point of the layout.
constexpr double kNodeWidth = 178, kNodeHeight = 58;
constexpr double kLabelWidth = 118, kLabelHeight = 26;
constexpr double kInch = 72;

struct Point {
  double x = 0;
  double y = 0;
};

struct Layout {
  Point size;
  std::vector<Point> nodes;  // centres
  struct Edge {
    std::vector<Point> curve;  // a start, then three points a Bezier piece
    Point label;
  };
  std::vector<Edge> edges;
};

// The layout library's functions take what they do not write to as char*.
char* mutable_text(const std::string& text) { return const_cast<char*>(text.c_str()); }

std::string layout_text(const Diagram& diagram) {
  const std::unique_ptr<GVC_t, int (*)(GVC_t*)> context(gvContext(), gvFreeContext);
  const std::unique_ptr<Agraph_t, int (*)(Agraph_t*)> graph(
      agopen(mutable_text("diagram"), Agdirected, nullptr), agclose);
  const auto attribute = [&](int kind, const std::string& name, const std::string& value) {
    agattr(graph.get(), kind, mutable_text(name), mutable_text(value));
  };
  attribute(AGRAPH, "ranksep", "0.18");
  attribute(AGRAPH, "nodesep", "0.2");
  attribute(AGNODE, "shape", "box");
  attribute(AGNODE, "fixedsize", "true");
  attribute(AGNODE, "label", "");
  attribute(AGNODE, "width", fmt::format("{}", kNodeWidth / kInch));
  attribute(AGNODE, "height", fmt::format("{}", kNodeHeight / kInch));
  attribute(AGEDGE, "label", "");
  char* const label = agstrdup_html(
      graph.get(), mutable_text(fmt::format("<TABLE BORDER=\"0\" FIXEDSIZE=\"TRUE\" WIDTH=\"{}\" "
                                            "HEIGHT=\"{}\"><TR><TD></TD></TR></TABLE>",
                                            kLabelWidth, kLabelHeight)));
  std::map<std::string, Agnode_t*> nodes;
  for (std::size_t i = 0; i < diagram.nodes.size(); ++i)
    nodes[diagram.nodes[i].id] = agnode(graph.get(), mutable_text(fmt::format("n{}", i)), 1);
  for (std::size_t i = 0; i < diagram.edges.size(); ++i) {
    Agedge_t* const edge = agedge(graph.get(), nodes.at(diagram.edges[i].from), nodes.at(diagram.edges[i].to),
                                  mutable_text(fmt::format("e{}", i)), 1);
    agxset(edge, agattr(graph.get(), AGEDGE, mutable_text("label"), nullptr), label);
    agsafeset(edge, mutable_text("color"), mutable_text(fmt::format("#{:06x}", i)), mutable_text(""));
  }
  if (gvLayout(context.get(), graph.get(), "dot") != 0) throw std::runtime_error("no layout of the diagram");
  char* text = nullptr;
  unsigned length = 0;
  const int failed = gvRenderData(context.get(), graph.get(), "plain", &text, &length);
  std::string result(failed == 0 ? text : "", failed == 0 ? length : 0);
  if (failed == 0) gvFreeRenderData(text);
  gvFreeLayout(context.get(), graph.get());
  agstrfree(graph.get(), label);
  if (failed != 0) throw std::runtime_error("no layout of the diagram");
  return result;
}

// The format "plain": one line for each node and edge, in inches, the y axis upwards. An edge's colour is its
// number: edges come in an order of their own.
Layout layout(const Diagram& diagram) {
  Layout result;
  result.nodes.resize(diagram.nodes.size());
  result.edges.resize(diagram.edges.size());
  std::istringstream lines(layout_text(diagram));
  const auto point = [&](std::istream& in) {
    Point p;
    in >> p.x >> p.y;
    return Point{p.x * kInch, result.size.y - p.y * kInch};
  };
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line);
    std::string kind, name;
    in >> kind;
    if (kind == "graph") {
      double scale = 0;
      in >> scale >> result.size.x >> result.size.y;
      result.size = {result.size.x * kInch, result.size.y * kInch};
    } else if (kind == "node") {
      in >> name;
      result.nodes.at(std::stoul(name.substr(1))) = point(in);
    } else if (kind == "edge") {
      std::string tail, head, style;
      std::size_t count = 0;
      in >> tail >> head >> count;
      Layout::Edge edge;
      for (std::size_t i = 0; i < count; ++i) edge.curve.push_back(point(in));
      // The label's text is markup with blanks in it: what counts stands at the line's end.
      std::vector<std::string> words;
      for (std::string word; in >> word;) words.push_back(word);
      const std::size_t end = words.size();
      if (end < 4) throw std::runtime_error("no layout of the diagram's edges");
      edge.label = {std::stod(words[end - 4]) * kInch, result.size.y - std::stod(words[end - 3]) * kInch};
      result.edges.at(std::stoul(words[end - 1].substr(1), nullptr, 16)) = std::move(edge);
    }
  }
  return result;
}

const char* class_of(Diagram::Mark mark) {
  switch (mark) {
    case Diagram::Mark::kLimits:
      return " limits";
    case Diagram::Mark::kWaits:
      return " waits";
    case Diagram::Mark::kNone:
      break;
  }
  return "";
}

std::string draw_node(const Diagram::Node& node, const Point& center) {
  const double x = center.x - kNodeWidth / 2, y = center.y - kNodeHeight / 2;
  const bool leads = !node.target.empty();
  std::string svg =
      leads ? fmt::format("<a href=\"#{}\" data-stage=\"{}\" class=\"node{}\" aria-label=\"{}: {}\">",
                          escaped(node.target), escaped(node.title), class_of(node.mark), escaped(node.title),
                          escaped(node.line))
            : fmt::format("<g class=\"node{}\">", class_of(node.mark));
  svg += fmt::format(
      "<rect class=\"box\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" rx=\"{}\"/>"
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" font-weight=\"600\">{}</text>"
      "<text class=\"soft\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>",
      x, y, kNodeWidth, kNodeHeight, leads ? 6 : 22, center.x, y + 19, escaped(node.title), center.x, y + 35,
      escaped(node.line));
  double at = x + 12;
  for (const Diagram::Share& share : node.shares) {
    const double width = share.share * (kNodeWidth - 24);
    if (width > 0)
      svg += fmt::format(
          "<rect class=\"{}\" x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"7\"><title>{} "
          "{}</title></rect>",
          share.style, at, y + 43, width, share.style, escaped(share.text));
    at += width;
  }
  return svg + (leads ? "</a>\n" : "</g>\n");
}

std::string draw_edge(const Diagram::Edge& edge, const Layout::Edge& layout) {
  if (layout.curve.empty()) return "";
  std::string path = fmt::format("M{:.1f},{:.1f}", layout.curve[0].x, layout.curve[0].y);
  for (std::size_t i = 1; i + 2 < layout.curve.size(); i += 3) {
    path += fmt::format("C{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}", layout.curve[i].x, layout.curve[i].y,
                        layout.curve[i + 1].x, layout.curve[i + 1].y, layout.curve[i + 2].x,
                        layout.curve[i + 2].y);
  }
  const double x = layout.label.x - kLabelWidth / 2 + 4, y = layout.label.y - kLabelHeight / 2;
  std::string svg = fmt::format(
      "<g class=\"stream{}\"><title>{}: {}</title>"
      "<path class=\"edge{}{}\" d=\"{}\" marker-end=\"url(#head)\"/>"
      "<text class=\"soft\" x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"10.5\">{}</text>",
      class_of(edge.mark), escaped(edge.title), escaped(edge.line), class_of(edge.mark),
      edge.gauge ? "" : " memory", path, x, y + 10, escaped(edge.title));
  constexpr double kGauge = 46;
  if (edge.gauge) {
    svg += fmt::format(
        "<rect class=\"blanking\" opacity=\"0.35\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"6\"/>"
        "<rect class=\"busy\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"6\"/>"
        "<rect class=\"blocked\" x=\"{:.2f}\" y=\"{:.1f}\" width=\"1.5\" height=\"8\"/>",
        x, y + 15, kGauge, x, y + 15, kGauge * edge.gauge->fill, x + kGauge * edge.gauge->peak - 0.75,
        y + 14);
  }
  return svg + fmt::format("<text class=\"soft\" x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"9.5\">{}</text></g>\n",
                           edge.gauge ? x + kGauge + 5 : x, y + 21.5, escaped(edge.line));
}

}  // namespace

std::string draw(const Diagram& diagram, const std::string& label) {
  const Layout placed = layout(diagram);
  std::string svg = fmt::format(
      "<svg class=\"diagram\" viewBox=\"-4 -4 {:.0f} {:.0f}\" role=\"group\" aria-label=\"{}\">"
      "<defs><marker id=\"head\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"10\" "
      "markerHeight=\"10\" orient=\"auto\" markerUnits=\"userSpaceOnUse\"><path class=\"head\" "
      "d=\"M0,0 8,4 0,8z\"/></marker></defs>\n",
      placed.size.x + 8, placed.size.y + 8, escaped(label));
  for (std::size_t i = 0; i < diagram.edges.size(); ++i) svg += draw_edge(diagram.edges[i], placed.edges[i]);
  for (std::size_t i = 0; i < diagram.nodes.size(); ++i) svg += draw_node(diagram.nodes[i], placed.nodes[i]);
  return svg + "</svg>\n";
}

}  // namespace parallax

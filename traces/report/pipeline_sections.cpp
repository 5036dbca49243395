// SPDX-License-Identifier: Apache-2.0
// Stages and the FIFOs between them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

#include "traces/report/diagram.hpp"
#include "traces/report/html.hpp"
#include "traces/report/metric_text.hpp"
#include "traces/report/sections.hpp"

namespace parallax {
namespace {

using Json = nlohmann::ordered_json;

struct Activity {
  const char* name;
  const char* title;
};
constexpr std::array<Activity, 6> kActivities = {{{"busy", "busy"},
                                                  {"starved", "upstream empty"},
                                                  {"blocked", "downstream full"},
                                                  {"memory", "memory"},
                                                  {"synchroniser", "synchroniser"},
                                                  {"blanking", "blanking"}}};

double share(const Json& stage, const char* activity) {
  return metric_number(stage, fmt::format("{}_share", activity));
}

std::string legend() {
  std::string html = "<p class=\"legend\">";
  for (const Activity& activity : kActivities)
    html += fmt::format("<span><i class=\"{}\"></i>{}</span>\n", activity.name, activity.title);
  return html + "</p>\n";
}

// What a module is called here: a stage and an engine of the core by itself, any other with its parent.
std::string short_name(const std::string& path) {
  const std::size_t last = path.rfind('.');
  if (last == std::string::npos) return path;
  const std::size_t before = path.rfind('.', last - 1);
  const std::string parent = path.substr(before + 1, last - before - 1);
  const std::string name = path.substr(last + 1);
  return parent == "pipeline" || parent == "core" ? name : parent + " " + name;
}

std::set<std::string> waiting(const Json& tree, const char* what) {
  std::set<std::string> names;
  if (!tree.contains("deadlock")) return names;
  for (const Json& wait : tree.at("deadlock")) names.insert(metric_word(wait, what));
  return names;
}

Diagram::Node stage_node(const Json& tree, const std::string& name) {
  const Json& stage = tree.at("stages").at(name);
  const double pixels =
      metric_number(tree, "input/processed_width") * metric_number(tree, "input/processed_height");
  Diagram::Node node;
  node.title = name;
  node.target = "stage-" + name;
  node.line =
      fmt::format("{} cycles/px, {:.1f} %",
                  number_text(metric_number(stage, "cycles_per_frame") / std::max(pixels, 1.0), 2),
                  tree.contains("deadlock") ? share(stage, "busy") : metric_number(stage, "utilisation"));
  for (const Activity& activity : kActivities)
    node.shares.push_back({activity.name, share(stage, activity.name) / 100});
  return node;
}

class PipelineDiagram {
 public:
  explicit PipelineDiagram(const Json& tree) : tree_(tree), waiters_(waiting(tree, "waiter")) {
    // In the order of the data: the order in which the keyboard goes through them.
    for (const char* group : {"streams", "buffers"}) {
      if (!tree.contains(group)) continue;
      for (const auto& entry : tree.at(group).items()) {
        ends_.insert(metric_word(entry.value(), "writer"));
        ends_.insert(metric_word(entry.value(), "reader"));
      }
    }
    for (const auto& stage : tree.at("stages").items()) {
      for (const std::string& path : ends_) {
        if (last_name(path) == stage.key()) add_node(path);
      }
    }
    for (const std::string& path : ends_) {
      if (!path.empty()) add_node(path);
    }
    add_limit();
    for (const auto& stream : tree.at("streams").items()) add_stream(stream.key(), stream.value());
    if (!tree.contains("buffers")) return;
    for (const auto& buffers : tree.at("buffers").items()) {
      diagram_.edges.push_back({metric_word(buffers.value(), "writer"),
                                metric_word(buffers.value(), "reader"),
                                buffers.key() + " buffers",
                                fmt::format("{:.0f} in memory", metric_number(buffers.value(), "number")),
                                {}});
    }
  }

  const Diagram& diagram() const { return diagram_; }

 private:
  static std::string last_name(const std::string& path) { return path.substr(path.rfind('.') + 1); }

  void add_node(const std::string& path) {
    if (!known_.insert(path).second) return;
    const std::string name = last_name(path);
    Diagram::Node node;
    if (tree_.at("stages").contains(name)) {
      node = stage_node(tree_, name);
    } else {
      node.title = words(short_name(path));
      const Json* const load = find_metric(tree_, "limit/utilisation_by_part/" + name);
      if (load != nullptr) node.line = metric_text(*load);
    }
    node.id = path;
    if (waiters_.count(path) != 0) node.mark = Diagram::Mark::kWaits;
    if (name == metric_word(tree_, "limit/part")) node.mark = Diagram::Mark::kLimits;
    diagram_.nodes.push_back(std::move(node));
  }

  // A part that is none of the modules here, such as the host, stands by itself.
  void add_limit() {
    const std::string part = metric_word(tree_, "limit/part");
    const auto limits = [](const Diagram::Node& node) { return node.mark == Diagram::Mark::kLimits; };
    if (part.empty() || part == "none" || std::any_of(diagram_.nodes.begin(), diagram_.nodes.end(), limits))
      return;
    Diagram::Node node;
    node.id = node.title = words(part);
    node.line = fmt::format("{:.1f} %, limits", metric_number(tree_, "limit/utilisation"));
    node.mark = Diagram::Mark::kLimits;
    diagram_.nodes.push_back(std::move(node));
  }

  void add_stream(const std::string& name, const Json& stream) {
    Diagram::Edge edge{metric_word(stream, "writer"), metric_word(stream, "reader"), name, "", {}};
    if (edge.from.empty() || edge.to.empty()) return;
    const double depth = std::max(1.0, metric_number(stream, "depth"));
    const double mean = metric_number(stream, "mean_occupancy");
    edge.gauge = Diagram::Gauge{std::min(1.0, mean / depth),
                                std::min(1.0, metric_number(stream, "high_water") / depth)};
    edge.line = fmt::format("{} of {}", number_text(mean, mean < 10 ? 1 : 0), number_text(depth, 0));
    if (tree_.contains("deadlock")) add_wait(name, edge);
    diagram_.edges.push_back(std::move(edge));
  }

  // What a stream's FIFO was when the machine got stuck says more than its mean.
  void add_wait(const std::string& name, Diagram::Edge& edge) {
    for (const Json& wait : tree_.at("deadlock")) {
      if (metric_word(wait, "stream") != name) continue;
      const bool full = metric_word(wait, "state") == "full";
      edge.mark = Diagram::Mark::kWaits;
      edge.gauge = Diagram::Gauge{full ? 1.0 : 0.0, full ? 1.0 : 0.0};
      edge.line = fmt::format("{}, depth {:.0f}", full ? "full" : "empty", metric_number(wait, "depth"));
    }
  }

  const Json& tree_;
  const std::set<std::string> waiters_;
  std::set<std::string> ends_;
  std::set<std::string> known_;
  Diagram diagram_;
};

// The parts of the machine around the stages, and how much of the time each is at work.
std::string parts_table(const Json& tree) {
  const Json::json_pointer path("/limit/utilisation_by_part");
  if (!tree.contains(path)) return "";
  const std::string limit = metric_word(tree, "limit/part");
  Table table("How much of the time each part of the machine is at work", {"part", "at work", ""});
  for (const auto& [name, metric] : tree.at(path).items()) {
    if (tree.at("stages").contains(name)) continue;
    const double load = metric.at("value");
    const bool limits = name == limit;
    table.row(
        {term(words(name), metric.value("description", "")), fmt::format("{:.1f} %", load),
         fmt::format("<span class=\"bar\"><i class=\"busy\" style=\"width:{:.1f}%\"></i></span>", load)},
        limits ? "class=\"limits\"" : "");
  }
  return table.html();
}

}  // namespace

std::string pipeline_section(const ReportInput& input) {
  const Json& tree = input.timing;
  if (tree.at("streams").empty()) return "";
  return fmt::format(
      "<p class=\"soft\">A box is a stage: its cycles a pixel, how busy it is, and where its time goes; a "
      "round box is an engine of a memory port, a sensor or the link. A line is a FIFO: tokens held on "
      "average of its depth, and a mark at the largest number held; or buffers in memory. {}</p>\n{}"
      "<div class=\"pipeline\"><div>{}</div>\n<aside class=\"details script-only\" id=\"details\" "
      "aria-live=\"polite\"><p class=\"soft\">Choose a stage for its numbers: with the pointer, or with tab, "
      "arrows and space.</p></aside></div>\n{}",
      tree.contains("deadlock") ? "Red: who waits in a circle, and on what."
                                : "The part that limits has a thick border.",
      legend(),
      draw(PipelineDiagram(tree).diagram(),
           "The stages and the FIFOs between them; the tables below say the same"),
      parts_table(tree));
}

std::string stages_section(const ReportInput& input) {
  const Json& tree = input.timing;
  if (tree.at("stages").empty()) return "";
  const std::string first = "stages/" + tree.at("stages").begin().key() + "/";
  std::vector<std::string> headings = {
      "stage", metric_term(tree, first + "cycles_per_frame", "cycles a frame"), "interval",
      metric_term(tree, first + "utilisation", "busy of the frame"), "where its time goes"};
  for (const Activity& activity : kActivities)
    headings.push_back(metric_term(tree, first + activity.name, activity.title));
  Table table("Where the time of each stage goes", headings);
  const std::string limit = metric_word(tree, "limit/part");
  for (const auto& [name, stage] : tree.at("stages").items()) {
    std::string bar = "<span class=\"bar\">";
    for (const Activity& activity : kActivities)
      bar += fmt::format("<i class=\"{}\" style=\"width:{:.1f}%\"></i>", activity.name,
                         share(stage, activity.name));
    const Json::json_pointer interval("/configuration/" + name + "/interval");
    std::vector<std::string> cells = {escaped(name), number_text(metric_number(stage, "cycles_per_frame"), 0),
                                      tree.contains(interval) ? tree.at(interval).dump() : "1",
                                      fmt::format("{:.1f} %", metric_number(stage, "utilisation")),
                                      bar + "</span>"};
    for (const Activity& activity : kActivities)
      cells.push_back(fmt::format("{:.1f} %", share(stage, activity.name)));
    table.row(cells, fmt::format("id=\"stage-{}\"{}", name, name == limit ? " class=\"limits\"" : ""));
  }
  return legend() + canvas("chart-stages", "Where the time of each stage goes", true) + table.html();
}

std::string fifos_section(const ReportInput& input) {
  const Json& tree = input.timing;
  if (tree.at("streams").empty()) return "";
  const std::string first = "streams/" + tree.at("streams").begin().key() + "/";
  const auto heading = [&](const char* name, const char* title) {
    return metric_term(tree, first + name, title);
  };
  Table table("How full each FIFO was, over the whole run",
              {"FIFO", heading("depth", "depth"), heading("width", "width"), heading("kind", "kind"),
               heading("mean_occupancy", "mean"), heading("high_water", "largest"), heading("full", "full"),
               heading("empty", "empty"), heading("blocked_on_full", "held its writer back"),
               heading("starved_on_empty", "held its reader back")});
  // First shown: the deepest one, in a deadlock one of those that take part.
  const std::set<std::string> stuck = waiting(tree, "stream");
  std::string options, shown;
  double most = -1;
  for (const auto& [name, stream] : tree.at("streams").items()) {
    const double depth = metric_number(stream, "depth");
    table.row({escaped(name), number_text(depth, 0), metric_text(stream.at("width")),
               escaped(metric_word(stream, "kind")), number_text(metric_number(stream, "mean_occupancy"), 1),
               number_text(metric_number(stream, "high_water"), 0),
               fmt::format("{:.1f} %", metric_number(stream, "full")),
               fmt::format("{:.1f} %", metric_number(stream, "empty")),
               metric_text(stream.at("blocked_on_full")), metric_text(stream.at("starved_on_empty"))});
    const double interest = depth + (stuck.count(name) != 0 ? 1e9 : 0);
    if (interest > most) shown = name;
    most = std::max(most, interest);
  }
  for (const auto& stream : tree.at("streams").items()) {
    options +=
        fmt::format("<option{}>{}</option>", stream.key() == shown ? " selected" : "", escaped(stream.key()));
  }
  return fmt::format(
             "<p class=\"script-only\"><label>Tokens held in <select id=\"stream\">{}</select></label></p>\n",
             options) +
         canvas("chart-fifo", "Share of the time at which a FIFO held so many tokens") + table.html();
}

std::string storage_section(const ReportInput& input) {
  const Json& tree = input.timing;
  Table table(
      "Memory on the chip, as declared: line buffers and the like of the stages, and the FIFOs (depth times "
      "width). How a device packs them into blocks is not said here.",
      {"part", "line buffers", "its FIFOs to other stages", "together"});
  double all_lines = 0, all_fifos = 0;
  const auto kibibits = [](double bits) { return number_text(bits / 1024, 1) + " Kibit"; };
  for (const auto& [name, stage] : tree.at("stages").items()) {
    const double lines = metric_number(stage, "storage");
    double fifos = 0;
    for (const Json& stream : tree.at("streams")) {
      const std::string writer = metric_word(stream, "writer");
      if (writer.substr(writer.rfind('.') + 1) == name)
        fifos += metric_number(stream, "depth") * metric_number(stream, "width");
    }
    all_lines += lines;
    all_fifos += fifos;
    table.row({escaped(name), kibibits(lines), kibibits(fifos), kibibits(lines + fifos)});
  }
  if (table.empty()) return "";
  table.row({"<b>all</b>", kibibits(all_lines), kibibits(all_fifos), kibibits(all_lines + all_fifos)});
  return table.html();
}

}  // namespace parallax

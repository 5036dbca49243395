// SPDX-License-Identifier: Apache-2.0
// Stages and the FIFOs between them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "traces/json_text.hpp"
#include "traces/metric_text.hpp"
#include "traces/number_text.hpp"
#include "traces/report/diagram.hpp"
#include "traces/report/html.hpp"
#include "traces/report/page_text.hpp"
#include "traces/report/sections.hpp"

namespace parallax {
namespace {

struct ActivityTitle {
  const char* name;
  const char* title;
};
constexpr std::array<ActivityTitle, 6> kActivities = {{{"busy", "busy"},
                                                       {"starved", "upstream empty"},
                                                       {"blocked", "downstream full"},
                                                       {"memory", "memory"},
                                                       {"synchroniser", "synchroniser"},
                                                       {"blanking", "blanking"}}};

double share(const MetricGroup& stage, const char* activity) {
  return stage.number(fmt::format("{}_share", activity));
}

std::string legend() {
  std::string html = "<p class=\"legend\">";
  for (const ActivityTitle& activity : kActivities)
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

const MetricGroup& group_or_none(const MetricGroup& tree, const char* name) {
  static const MetricGroup none;
  const MetricGroup* const found = tree.find_group(name);
  return found == nullptr ? none : *found;
}

// Who waits, or on what, when the machine got stuck; empty when it did not.
std::set<std::string> waiting(const MetricGroup& tree, const char* what) {
  std::set<std::string> names;
  for (const MetricGroup& wait : group_or_none(tree, "deadlock").groups) names.insert(wait.word(what));
  return names;
}

Diagram::Node stage_node(const MetricGroup& tree, const MetricGroup& stage) {
  const double pixels = tree.number("input/processed_width") * tree.number("input/processed_height");
  Diagram::Node node;
  node.title = stage.name;
  node.target = "stage-" + stage.name;
  node.line = fmt::format(
      "{} cycles/px, {}", page_number(stage.number("cycles_per_frame") / std::max(pixels, 1.0), "cycles/px"),
      plain_text(stage.at(tree.find_group("deadlock") != nullptr ? "busy_share" : "utilisation")));
  for (const ActivityTitle& activity : kActivities)
    node.shares.push_back({activity.name, share(stage, activity.name) / 100,
                           plain_text(stage.at(fmt::format("{}_share", activity.name)))});
  return node;
}

class PipelineDiagram {
 public:
  explicit PipelineDiagram(const MetricGroup& tree) : tree_(tree), waiters_(waiting(tree, "waiter")) {
    // In the order of the data: the order in which the keyboard goes through them.
    for (const char* group : {"streams", "buffers"}) {
      for (const MetricGroup& entry : group_or_none(tree, group).groups) {
        ends_.insert(entry.word("writer"));
        ends_.insert(entry.word("reader"));
      }
    }
    for (const MetricGroup& stage : tree.group_at("stages").groups) {
      for (const std::string& path : ends_) {
        if (last_name(path) == stage.name) add_node(path);
      }
    }
    for (const std::string& path : ends_) {
      if (!path.empty()) add_node(path);
    }
    add_limit();
    for (const MetricGroup& stream : tree.group_at("streams").groups) add_stream(stream);
    for (const MetricGroup& buffers : group_or_none(tree, "buffers").groups) {
      diagram_.edges.push_back({buffers.word("writer"),
                                buffers.word("reader"),
                                buffers.name + " buffers",
                                fmt::format("{} in memory", buffers.count("number")),
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
    if (const MetricGroup* const stage = tree_.group_at("stages").find_group(name)) {
      node = stage_node(tree_, *stage);
    } else {
      node.title = words(short_name(path));
      const Metric* const load = tree_.find("limit/utilisation_by_part/" + name);
      if (load != nullptr) node.line = plain_text(*load);
    }
    node.id = path;
    if (waiters_.count(path) != 0) node.mark = Diagram::Mark::kWaits;
    if (name == tree_.word_or("limit/part", "")) node.mark = Diagram::Mark::kLimits;
    diagram_.nodes.push_back(std::move(node));
  }

  // A part that is none of the modules here, such as the host, stands by itself.
  void add_limit() {
    const std::string part = tree_.word_or("limit/part", "");
    const auto limits = [](const Diagram::Node& node) { return node.mark == Diagram::Mark::kLimits; };
    if (part.empty() || part == "none" || std::any_of(diagram_.nodes.begin(), diagram_.nodes.end(), limits))
      return;
    Diagram::Node node;
    node.id = node.title = words(part);
    node.line = filled_in(tree_, "{limit/utilisation}, limits");
    node.mark = Diagram::Mark::kLimits;
    diagram_.nodes.push_back(std::move(node));
  }

  void add_stream(const MetricGroup& stream) {
    Diagram::Edge edge{stream.word("writer"), stream.word("reader"), stream.name, "", {}};
    if (edge.from.empty() || edge.to.empty()) return;
    const double depth = std::max(1.0, stream.number("depth"));
    const double mean = stream.number("mean_occupancy");
    edge.gauge =
        Diagram::Gauge{std::min(1.0, mean / depth), std::min(1.0, stream.number("high_water") / depth)};
    edge.line =
        fmt::format("{} of {}", page_number(stream.at("mean_occupancy")), page_number(stream.at("depth")));
    add_wait(stream.name, edge);
    diagram_.edges.push_back(std::move(edge));
  }

  // What a stream's FIFO was when the machine got stuck says more than its mean.
  void add_wait(const std::string& name, Diagram::Edge& edge) {
    for (const MetricGroup& wait : group_or_none(tree_, "deadlock").groups) {
      if (wait.word("stream") != name) continue;
      const bool full = wait.word("state") == "full";
      edge.mark = Diagram::Mark::kWaits;
      edge.gauge = Diagram::Gauge{full ? 1.0 : 0.0, full ? 1.0 : 0.0};
      edge.line = fmt::format("{}, depth {}", full ? "full" : "empty", wait.count("depth"));
    }
  }

  const MetricGroup& tree_;
  const std::set<std::string> waiters_;
  std::set<std::string> ends_;
  std::set<std::string> known_;
  Diagram diagram_;
};

// The parts of the machine around the stages, and how much of the time each is at work.
std::string parts_table(const MetricGroup& tree) {
  const MetricGroup* const parts = tree.find_group("limit/utilisation_by_part");
  if (parts == nullptr) return "";
  const std::string& limit = tree.word("limit/part");
  Table table("How much of the time each part of the machine is at work", {"part", "at work", ""});
  for (const Metric& metric : parts->metrics) {
    if (tree.group_at("stages").find_group(metric.name) != nullptr) continue;
    const double load = metric.number();
    const bool limits = metric.name == limit;
    table.row(
        {term(words(metric.name), metric.description), page_text(metric),
         fmt::format("<span class=\"bar\"><i class=\"busy\" style=\"width:{:.1f}%\"></i></span>", load)},
        limits ? "class=\"limits\"" : "");
  }
  return table.html();
}

}  // namespace

std::string pipeline_section(const ReportInput& input) {
  const MetricGroup& tree = input.metrics;
  if (tree.group_at("streams").groups.empty()) return "";
  return fmt::format(
      "<p class=\"soft\">A box is a stage: its cycles a pixel, how busy it is, and where its time goes; a "
      "round box is an engine of a memory port, a sensor or the link. A line is a FIFO: tokens held on "
      "average of its depth, and a mark at the largest number held; or buffers in memory. {}</p>\n{}"
      "<div class=\"pipeline\"><div>{}</div>\n<aside class=\"details script-only\" id=\"details\" "
      "aria-live=\"polite\"><p class=\"soft\">Choose a stage for its numbers: with the pointer, or with tab, "
      "arrows and space.</p></aside></div>\n{}",
      tree.find_group("deadlock") != nullptr ? "Red: who waits in a circle, and on what."
                                             : "The part that limits has a thick border.",
      legend(),
      draw(PipelineDiagram(tree).diagram(),
           "The stages and the FIFOs between them; the tables below say the same"),
      parts_table(tree));
}

std::string stages_section(const ReportInput& input) {
  const MetricGroup& tree = input.metrics;
  const std::vector<MetricGroup>& stages = tree.group_at("stages").groups;
  if (stages.empty()) return "";
  std::vector<std::string> headings = {
      "stage", metric_term(stages.front(), "cycles_per_frame", "cycles a frame"), "interval",
      metric_term(stages.front(), "utilisation", "utilisation"), "where its time goes"};
  for (const ActivityTitle& activity : kActivities)
    headings.push_back(metric_term(stages.front(), activity.name, activity.title));
  Table table("Where the time of each stage goes", headings);
  const std::string limit = tree.word_or("limit/part", "");
  for (const MetricGroup& stage : stages) {
    std::string bar = "<span class=\"bar\">";
    for (const ActivityTitle& activity : kActivities)
      bar += fmt::format("<i class=\"{}\" style=\"width:{:.1f}%\"></i>", activity.name,
                         share(stage, activity.name));
    const nlohmann::ordered_json::json_pointer interval("/" + stage.name + "/interval");
    std::vector<std::string> cells = {
        escaped(stage.name), page_number(stage.at("cycles_per_frame")),
        input.configuration.contains(interval) ? escaped(json_text(input.configuration.at(interval))) : "1",
        page_text(stage.at("utilisation")), bar + "</span>"};
    for (const ActivityTitle& activity : kActivities)
      cells.push_back(page_text(stage.at(fmt::format("{}_share", activity.name))));
    table.row(cells, fmt::format("id=\"stage-{}\"{}", escaped(stage.name),
                                 stage.name == limit ? " class=\"limits\"" : ""));
  }
  return legend() + canvas("chart-stages", "Where the time of each stage goes", true) + table.html();
}

std::string fifos_section(const ReportInput& input) {
  const std::vector<MetricGroup>& streams = input.metrics.group_at("streams").groups;
  if (streams.empty()) return "";
  const auto heading = [&](const char* name, const char* title) {
    return metric_term(streams.front(), name, title);
  };
  Table table("How full each FIFO was, over the whole run",
              {"FIFO", heading("depth", "depth"), heading("width", "width"), heading("kind", "kind"),
               heading("mean_occupancy", "mean"), heading("high_water", "largest"), heading("full", "full"),
               heading("empty", "empty"), heading("blocked_on_full", "held its writer back"),
               heading("starved_on_empty", "held its reader back")});
  // First shown: the deepest one, in a deadlock one of those that take part.
  const std::set<std::string> stuck = waiting(input.metrics, "stream");
  std::string options, shown;
  double most = -1;
  for (const MetricGroup& stream : streams) {
    const double depth = stream.number("depth");
    table.row({escaped(stream.name), page_number(stream.at("depth")), page_text(stream.at("width")),
               escaped(stream.word("kind")), page_number(stream.at("mean_occupancy")),
               page_number(stream.at("high_water")), page_text(stream.at("full")),
               page_text(stream.at("empty")), page_text(stream.at("blocked_on_full")),
               page_text(stream.at("starved_on_empty"))});
    const double interest = depth + (stuck.count(stream.name) != 0 ? 1e9 : 0);
    if (interest > most) shown = stream.name;
    most = std::max(most, interest);
  }
  for (const MetricGroup& stream : streams) {
    options +=
        fmt::format("<option{}>{}</option>", stream.name == shown ? " selected" : "", escaped(stream.name));
  }
  return fmt::format(
             "<p class=\"script-only\"><label>Tokens held in <select id=\"stream\">{}</select></label></p>\n",
             options) +
         canvas("chart-fifo", "Share of the time at which a FIFO held so many tokens") + table.html();
}

std::string storage_section(const ReportInput& input) {
  const MetricGroup& tree = input.metrics;
  Table table(
      "Memory on the chip, as declared: line buffers and the like of the stages, and the FIFOs (depth times "
      "width) at the part that writes them, those of the DMA engines, sensors and link as well. How a device "
      "packs "
      "them into blocks is not said here.",
      {"part", "line buffers", "FIFOs that it writes", "together"});
  const auto row = [&table](const std::string& name, double lines, double fifos) {
    const auto kibibits = [](double bits) { return page_number(bits / 1024, "Kibit") + " Kibit"; };
    table.row({name, kibibits(lines), kibibits(fifos), kibibits(lines + fifos)});
  };
  std::map<std::string, double> of_writer;  // bits, by the writer's path
  for (const MetricGroup& stream : tree.group_at("streams").groups)
    of_writer[stream.word("writer")] += stream.number("depth") * stream.number("width");
  double all_lines = 0, all_fifos = 0;
  for (const auto& [writer, bits] : of_writer) all_fifos += bits;
  for (const MetricGroup& stage : tree.group_at("stages").groups) {
    double fifos = 0;
    for (auto it = of_writer.begin(); it != of_writer.end();) {
      const bool own = it->first.substr(it->first.rfind('.') + 1) == stage.name;
      fifos += own ? it->second : 0;
      it = own ? of_writer.erase(it) : std::next(it);
    }
    all_lines += stage.number("storage");
    row(escaped(stage.name), stage.number("storage"), fifos);
  }
  if (table.empty()) return "";
  for (const auto& [writer, bits] : of_writer) row(escaped(words(short_name(writer))), 0, bits);
  row("<b>all</b>", all_lines, all_fifos);
  return table.html();
}

}  // namespace parallax

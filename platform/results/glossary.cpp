// SPDX-License-Identifier: Apache-2.0
#include "platform/results/glossary.hpp"

#include <fmt/format.h>

#include <regex>
#include <sstream>
#include <utility>
#include <vector>

#include "platform/config/energy_config.hpp"
#include "platform/estimate/estimate_metrics.hpp"
#include "platform/machine/frame_latencies.hpp"
#include "platform/results/deadlock_report.hpp"
#include "platform/results/energy.hpp"
#include "platform/results/memory_metrics.hpp"
#include "platform/results/pipeline_metrics.hpp"
#include "platform/results/rate_metrics.hpp"
#include "platform/results/replay_metrics.hpp"
#include "platform/results/run_metrics.hpp"

namespace parallax {
namespace {

struct Section {
  const char* title;
  const char* introduction;
  std::vector<const MetricTable*> tables;
};

const std::vector<Section>& sections() {
  static const std::vector<Section> all{
      {"Numbers of a run",
       "The names are those of timing.json. A machine that got stuck has deadlock in place of rates, "
       "latencies "
       "and what follows from them. The steady state is measured after all frame buffers have been full "
       "once, "
       "between two arrivals at the host, while the cameras go on; a number's window in the file says which "
       "frames these were. Where the link is off, frames are at the host when their results are in memory.",
       {&run_table(), &rate_table(), &memory_table(), &energy_table(), &pipeline_table(), &deadlock_table()}},
      {"Numbers of parallax memory",
       "What an address trace, replayed against the DRAM alone, comes to.",
       {&replay_table()}},
      {"Numbers of parallax estimate",
       "What the machine takes of an FPGA: cells of its circuits, and the share of a device.",
       {&estimate_table()}}};
  return all;
}

struct Name {
  std::string name;
  std::string meaning;
};

// What the angle brackets stand for.
std::vector<Name> names() {
  std::vector<Name> all{
      {"<port>",
       "A port of the memory: camera_left and camera_right write frames; left, right and map read for the "
       "pipeline; output writes results, link reads them; buffer_row_write, buffer_row_read, "
       "buffer_frame_write "
       "and buffer_frame_read are those of what the matcher keeps in memory."},
      {"<stage>",
       "A stage of the pipeline; those that have keys are named as in the configuration. Where frames "
       "overlap, a stage "
       "that looks ahead has two sides: `<name>` reads, `<name>_writing` writes."},
      {"<stream>", "A FIFO between two stages, or between a stage and a memory port."},
      {"<buffer>", "What a stage keeps in a memory: lines of an image, path costs, a burst."},
      {"<device>", "A device, by the name of its file; - is _."},
      {"<buffers>", "left, right or output: buffers in memory between two engines."},
      {"<wait>", "wait_1, wait_2 and so on."},
      {"limit/utilisation_by_part/<part>",
       "The memory, the cameras and their rate, the DMA engines, software, the core, the stages, the link "
       "and the "
       "host."}};
  for (const FrameSpan& span : frame_spans())
    all.push_back({fmt::format("<span>: {}", span.name), span.description});
  for (const EnergyEstimate::Part& part : estimate_energy(EnergyConfig{}, EnergyActivity{}).parts)
    all.push_back({fmt::format("energy/power_<part>: {}", part.name), part.description});
  return all;
}

// Lines of at most 100 characters, each after `indent`.
std::string wrapped(const std::string& text, const std::string& indent) {
  constexpr std::size_t kWidest = 100;
  std::istringstream words(text);
  std::string lines, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && indent.size() + line.size() + 1 + word.size() > kWidest) {
      lines += indent + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + indent + line + "\n";
}

// Names of keys, options, files and other numbers as code.
std::string with_code(const std::string& text) {
  static const std::regex code("(--[a-z][a-z-]*|[a-z_]+\\.[a-z_]+|[a-z]+_[a-z0-9_]+|<[a-z]+>)");
  return std::regex_replace(text, code, "`$1`");
}

std::string unit_of(const MetricInfo& info) { return info.unit.empty() ? "-" : info.unit; }

// Whether the row's name, in which angle brackets stand for any name, is this.
bool matches(std::string_view path, std::string_view row) {
  const std::size_t open = row.find('<');
  if (open == std::string_view::npos) return path == row;
  const std::string_view before = row.substr(0, open);
  const std::string_view after = row.substr(row.find('>') + 1);
  if (path.size() <= before.size() + after.size()) return false;
  const std::string_view name = path.substr(before.size(), path.size() - before.size() - after.size());
  return path.substr(0, before.size()) == before && path.substr(path.size() - after.size()) == after &&
         name.find('/') == std::string_view::npos;
}

const MetricInfo* find_in(const std::vector<const MetricTable*>& tables, std::string_view path) {
  for (const MetricTable* table : tables) {
    for (const MetricInfo& row : table->rows()) {
      if (matches(path, row.path)) return &row;
    }
  }
  return nullptr;
}

}  // namespace

std::string glossary_as_text() {
  std::string text;
  for (const Section& section : sections()) {
    text += fmt::format("{}\n{}\n", section.title, wrapped(section.introduction, "  "));
    for (const MetricTable* table : section.tables) {
      for (const MetricInfo& info : table->rows()) {
        text += fmt::format("{}{}{}\n", info.path, info.unit.empty() ? "" : ", " + info.unit,
                            info.window.empty() ? "" : "; over " + info.window);
        text += wrapped(info.description, "    ");
      }
    }
    text += "\n";
  }
  text += "Names in angle brackets\n\n";
  for (const Name& name : names()) text += name.name + "\n" + wrapped(name.meaning, "    ");
  return text;
}

std::string glossary_as_markdown() {
  std::string text = "# Glossary\n\nMade by `parallax glossary --markdown`.\n";
  for (const Section& section : sections()) {
    text += fmt::format("\n## {}\n\n{}\n| name | unit | meaning | over |\n|---|---|---|---|\n", section.title,
                        wrapped(with_code(section.introduction), ""));
    for (const MetricTable* table : section.tables) {
      for (const MetricInfo& info : table->rows()) {
        text += fmt::format("| `{}` | {} | {} | {} |\n", info.path, unit_of(info),
                            with_code(info.description), info.window.empty() ? "-" : info.window);
      }
    }
  }
  text += "\n## Names in angle brackets\n\n| name | meaning |\n|---|---|\n";
  for (const Name& name : names()) text += fmt::format("| `{}` | {} |\n", name.name, with_code(name.meaning));
  return text;
}

nlohmann::ordered_json glossary_as_json() {
  auto metrics = nlohmann::ordered_json::array();
  for (const Section& section : sections()) {
    for (const MetricTable* table : section.tables) {
      for (const MetricInfo& info : table->rows()) {
        metrics.push_back({{"of", section.title},
                           {"name", info.path},
                           {"unit", info.unit},
                           {"description", info.description},
                           {"window", info.window}});
      }
    }
  }
  auto names_in_brackets = nlohmann::ordered_json::array();
  for (const Name& name : names())
    names_in_brackets.push_back({{"name", name.name}, {"meaning", name.meaning}});
  return {{"metrics", std::move(metrics)}, {"names", std::move(names_in_brackets)}};
}

const MetricInfo* find_run_metric(std::string_view path) { return find_in(sections().front().tables, path); }

const MetricInfo* find_estimate_metric(std::string_view path) { return find_in({&estimate_table()}, path); }

std::vector<std::string> run_metric_names() {
  std::vector<std::string> names;
  for (const MetricTable* table : sections().front().tables) {
    for (const MetricInfo& row : table->rows()) names.push_back(row.path);
  }
  return names;
}

}  // namespace parallax

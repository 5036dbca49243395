// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/exploration_spec.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

#include "platform/config/machine_config.hpp"
#include "platform/config/nearest_key.hpp"
#include "platform/config/nearest_name.hpp"
#include "platform/config/toml_text.hpp"
#include "platform/explore/axis_reader.hpp"
#include "platform/explore/toml_part.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::size_t kMostPoints = 1'000'000;
constexpr std::array<std::pair<const char*, SamplingMethod>, 6> kMethods{
    {{"grid", SamplingMethod::kGrid},
     {"one-at-a-time", SamplingMethod::kOneAtATime},
     {"random", SamplingMethod::kRandom},
     {"latin-hypercube", SamplingMethod::kLatinHypercube},
     {"sobol", SamplingMethod::kSobol},
     {"search", SamplingMethod::kSearch}}};

class Reader {
 public:
  Reader(const std::filesystem::path& file, const std::vector<std::string>& run_options)
      : file_(file.string()), run_options_(run_options) {
    describe(schema_, machine_);
  }

  ExplorationSpec read(const toml::table& table) {
    for (const auto& [key, node] : table) {
      const auto part = std::find_if(kParts.begin(), kParts.end(),
                                     [&name = key](const Part& known) { return name == known.name; });
      if (part == kParts.end()) {
        std::vector<std::string> names;
        for (const Part& known : kParts) names.emplace_back(known.name);
        const std::string name(key.str());
        fail(node,
             fmt::format("unknown part {}; the nearest is {}", excerpt(name), nearest_name(name, names)));
      }
      (this->*part->read)(TomlPart{file_, part->name, &node});
    }
    check_names();
    return std::move(spec_);
  }

 private:
  struct Part {
    const char* name;
    void (Reader::*read)(const TomlPart& part);
  };
  static const std::array<Part, 11> kParts;

  [[noreturn]] void fail(const toml::node& node, const std::string& why) const {
    throw UserError(fmt::format("{}: {}", toml_origin(file_, node), why));
  }

  void read_description(const TomlPart& part) { spec_.description = part.text(); }

  void read_device(const TomlPart& part) { spec_.device = part.text(); }

  void read_run(const TomlPart& part) {
    for (const TomlPart& entry : part.entries()) {
      if (!is_option(entry.name)) {
        entry.fail(fmt::format("no option of parallax run that bears on the time; the nearest is {}",
                               nearest_name(entry.name, run_options_)));
      }
      say(entry);
      RunWord word{entry.name, {}};
      if (const toml::value<bool>* const flag = entry.node->as_boolean()) {
        if (flag->get()) spec_.run.push_back(word);
        continue;
      }
      word.values = entry.values();
      spec_.run.push_back(std::move(word));
    }
  }

  void read_set(const TomlPart& part) {
    for (const TomlPart& entry : part.leaves()) {
      require_key(entry);
      say(entry);
      spec_.assignments.push_back(entry.name + "=" + entry.value());
    }
  }

  void read_vary(const TomlPart& part) {
    for (const TomlPart& entry : part.leaves()) {
      const bool option = is_option(entry.name);
      say(entry);
      spec_.axes.push_back(read_axis(entry, option ? nullptr : &require_key(entry)));
    }
  }

  void read_link(const TomlPart& part) {
    for (const TomlPart& entry : part.leaves()) {
      if (is_option(entry.name)) entry.fail("is an option of parallax run, and only keys can be linked");
      const bool truth = require_key(entry).type == KeyType::kBoolean;
      say(entry);
      spec_.links.push_back({entry.name, entry.text(), entry.origin(), truth});
    }
  }

  void read_conditions(const TomlPart& part) {
    for (const TomlPart& entry : part.elements()) spec_.conditions.push_back({entry.text(), entry.origin()});
  }

  void read_sampling(const TomlPart& part) {
    for (const TomlPart& entry : part.entries()) {
      if (entry.name == "method") {
        spec_.sampling.method = method_of(entry);
      } else if (entry.name == "points") {
        spec_.sampling.points = static_cast<std::size_t>(entry.whole(1, kMostPoints));
      } else if (entry.name == "seed") {
        spec_.sampling.seed = static_cast<std::uint64_t>(entry.whole(0, 999'999'999'999'999'999));
      } else {
        entry.fail("unknown; [sampling] has method, points and seed");
      }
    }
    const bool drawn = draws(spec_.sampling.method);
    if (!drawn && spec_.sampling.points != 0)
      part.fail("a grid has all points, and so has one-at-a-time; points goes with the others");
    if (drawn && spec_.sampling.points == 0) part.fail("points = NUMBER is missing: how many to take");
  }

  SamplingMethod method_of(const TomlPart& entry) const {
    const std::string name = entry.text();
    for (const auto& [known, method] : kMethods) {
      if (name == known) return method;
    }
    std::vector<std::string> names;
    for (const auto& [known, method] : kMethods) names.emplace_back(known);
    entry.fail(fmt::format("'{}' is none of {}", excerpt(name), fmt::join(names, ", ")));
  }

  void read_constraints(const TomlPart& part) {
    for (const TomlPart& entry : part.leaves()) {
      Constraint constraint{entry.name, {}, {}, entry.origin()};
      for (const TomlPart& bound : entry.entries()) {
        if (bound.name != "at_least" && bound.name != "at_most")
          bound.fail("unknown; a constraint has at_least, at_most, or both");
        (bound.name == "at_least" ? constraint.at_least : constraint.at_most) = bound.number();
      }
      if (!constraint.at_least && !constraint.at_most)
        entry.fail("a constraint has at_least, at_most, or both");
      if (constraint.at_least && constraint.at_most && *constraint.at_least > *constraint.at_most)
        entry.fail("at_least is above at_most: nothing can satisfy that");
      spec_.constraints.push_back(std::move(constraint));
    }
  }

  void read_objectives(const TomlPart& part) {
    for (const TomlPart& entry : part.leaves()) {
      const std::string sense = entry.text();
      if (sense != "most" && sense != "least") entry.fail("must be \"most\" or \"least\"");
      spec_.objectives.push_back({entry.name, sense == "most", entry.origin()});
    }
  }

  void read_metrics(const TomlPart& part) {
    for (const TomlPart& entry : part.elements()) spec_.metrics.push_back(entry.text());
  }

  const Key& require_key(const TomlPart& entry) const {
    if (const Key* key = schema_.find(entry.name)) return *key;
    std::vector<std::string> names;
    for (const Key& key : schema_.keys()) names.push_back(key.path);
    if (entry.section == "vary") names.insert(names.end(), run_options_.begin(), run_options_.end());
    entry.fail(fmt::format("unknown key; the nearest is {}", nearest_key(entry.name, names)));
  }

  bool is_option(const std::string& name) const {
    return std::find(run_options_.begin(), run_options_.end(), name) != run_options_.end();
  }

  // What is said of a name in two places contradicts itself.
  void say(const TomlPart& entry) {
    const auto [other, first] = said_.emplace(entry.name, entry.origin());
    const std::string& where = other->second;
    if (!first)
      entry.fail(fmt::format("is given in line {} too: a point's value of it has one source",
                             where.substr(where.rfind(':') + 1)));
  }

  void check_names() const {
    if (const auto range = said_.find("disparities");
        range != said_.end() && said_.count("matching.iterations") != 0)
      throw UserError(fmt::format(
          "{}: disparities and matching.iterations exclude each other: both set the range", range->second));
    if (spec_.axes.empty()) throw UserError(fmt::format("{}: nothing varies; [vary] says what does", file_));
    if (spec_.sampling.method == SamplingMethod::kSearch && spec_.objectives.empty() &&
        spec_.constraints.empty())
      throw UserError(
          fmt::format("{}: a search needs [objectives], [constraints] or both: what it searches for", file_));
    const auto span = std::find_if(spec_.axes.begin(), spec_.axes.end(),
                                   [](const Axis& axis) { return axis.span.has_value(); });
    if (span != spec_.axes.end() && !draws(spec_.sampling.method))
      throw UserError(fmt::format(
          "{}: {}: a grid needs a step or a factor between from and to; or [sampling] another method",
          said_.at(span->name), span->name));
  }

  const std::string file_;
  const std::vector<std::string>& run_options_;
  MachineConfig machine_;
  Schema schema_;
  std::map<std::string, std::string> said_;  // where each name has its value
  ExplorationSpec spec_;
};

const std::array<Reader::Part, 11> Reader::kParts{{{"description", &Reader::read_description},
                                                   {"device", &Reader::read_device},
                                                   {"run", &Reader::read_run},
                                                   {"set", &Reader::read_set},
                                                   {"vary", &Reader::read_vary},
                                                   {"link", &Reader::read_link},
                                                   {"conditions", &Reader::read_conditions},
                                                   {"sampling", &Reader::read_sampling},
                                                   {"constraints", &Reader::read_constraints},
                                                   {"objectives", &Reader::read_objectives},
                                                   {"metrics", &Reader::read_metrics}}};

}  // namespace

std::vector<std::string> ExplorationSpec::varied_names() const {
  std::vector<std::string> names;
  for (const Axis& axis : axes) names.push_back(axis.name);
  for (const LinkedKey& link : links) names.push_back(link.key);
  return names;
}

std::vector<std::string> ExplorationSpec::named_metrics() const {
  std::vector<std::string> names;
  const std::vector<std::string> varied = varied_names();
  const auto add = [&](const std::string& name) {
    if (std::find(varied.begin(), varied.end(), name) != varied.end()) return;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const Objective& objective : objectives) add(objective.metric);
  for (const Constraint& constraint : constraints) add(constraint.metric);
  for (const std::string& name : metrics) add(name);
  return names;
}

ExplorationSpec read_exploration_spec(const std::filesystem::path& file,
                                      const std::vector<std::string>& run_options) {
  const toml::table table = read_toml(file, "exploration");
  ExplorationSpec spec = Reader(file, run_options).read(table);
  std::ostringstream text;
  // The table alone has lost the order in which the points are numbered.
  text << table << fmt::format("\n# varies: {}", fmt::join(spec.varied_names(), ", "));
  spec.text = text.str();
  return spec;
}

}  // namespace parallax

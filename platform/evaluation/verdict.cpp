// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "platform/machine/part.hpp"
#include "platform/results/rate_metrics.hpp"

namespace parallax {
namespace {

// Whether the part that is at work all the time would be faster.
bool relieves_the_busiest(const Relaxation& relaxation, const EvaluationResult& base) {
  const std::vector<std::string>& names = base.limit.relieved_by;
  return std::find(names.begin(), names.end(), relaxation.name) != names.end();
}

std::string sentence(const EvaluationResult& base, const RelaxedLimits& limits) {
  const bool busy = base.limit.part != "none";
  const std::string part = spoken(base.limit.part);
  if (!limits.limit) return "nothing limits alone, and nothing that was tried gains anything together";
  const RelaxedLimit& found = *limits.limit;
  std::string text;
  if (found.relaxation.limits.size() > 1) {
    text = fmt::format("{} limit together", found.relaxation.subject);
  } else if (busy && relieves_the_busiest(found.relaxation, base)) {
    text = fmt::format("{} limits at {:.1f} %", part, base.limit.utilisation);
  } else {
    text = found.relaxation.subject + " limits";
    if (busy)
      text += fmt::format(", though {} is at work for {:.1f} % of the time", part, base.limit.utilisation);
  }
  text += fmt::format("; {} {} {:.1f} fps", found.relaxation.remedy,
                      found.relaxation.limits.size() > 1 ? "give" : "gives", found.frame_rate);
  if (found.next_part == "none") return text + ", and then no part limits alone";
  if (found.next_part == base.limit.part) return text + fmt::format(", and {} still limits", part);
  return text + fmt::format(", then {} limits", spoken(found.next_part));
}

struct Interrupted {};

class Search {
 public:
  Search(const MachineConfig& config, const EvaluationResult& base, const Trial& trial)
      : config_(config), base_(base), trial_(trial) {
    limits_.frame_rate = base.rate;
    limits_.latency = base.latency.exposure_to_host;
  }

  Verdict find(Thoroughness thoroughness) {
    try {
      search(thoroughness);
    } catch (const Interrupted&) {
    }
    return {sentence(base_, limits_), limits_};
  }

 private:
  // Relaxations of the busiest part come first: of two that gain as much these are named.
  void search(Thoroughness thoroughness) {
    std::vector<Relaxation> all = relaxations(config_, base_.metrics);
    const auto others = std::stable_partition(
        all.begin(), all.end(), [this](const Relaxation& r) { return relieves_the_busiest(r, base_); });
    if (thoroughness == Thoroughness::kAll || others == all.begin()) {
      try_alone(all);
    } else if (const std::vector<Relaxation> rest(others, all.end());
               !gain_most({all.begin(), others}, rest)) {
      try_alone(rest);
    }
    if (!limits_.alone.front().gains()) {
      limits_.limit = fewest(all, kLeastTogether);
    } else if (limits_.alone.front().relaxation.name == name_of(Relief::kFifos)) {
      name_fifos(limits_.alone.front());
    } else {
      limits_.limit = limits_.alone.front();
    }
  }

  std::vector<RelaxedLimit> measure(const std::vector<Relaxation>& some) {
    const std::vector<EvaluationResult> results = trial_(some);
    if (results.size() < some.size()) throw Interrupted();
    std::vector<RelaxedLimit> measured;
    for (std::size_t i = 0; i < some.size(); ++i)
      measured.push_back(relaxed_limit(base_, some[i], results[i]));
    return measured;
  }

  void try_alone(const std::vector<Relaxation>& some) {
    for (RelaxedLimit& relaxed : measure(some)) limits_.add(std::move(relaxed));
  }

  // Tries `own` alone, and all the others at once: none of these gains more alone than together.
  bool gain_most(std::vector<Relaxation> own, const std::vector<Relaxation>& others) {
    own.push_back(together(others));
    std::vector<RelaxedLimit> measured = measure(own);
    const RelaxedLimit rest = std::move(measured.back());
    measured.pop_back();
    for (RelaxedLimit& relaxed : measured) limits_.add(std::move(relaxed));
    const RelaxedLimit& best = limits_.alone.front();
    return best.gains() && rest.measured && rest.gain <= best.gain;
  }

  // `all`: what deeper FIFOs gain, all of them. Names the one that does it and the least depth of those tried
  // that is enough, or the fewest.
  void name_fifos(const RelaxedLimit& all) {
    limits_.limit = all;
    const double enough = all.gain - RelaxedLimit::kNoise;
    const std::vector<Relaxation> fifos = fifo_relaxations(base_.metrics);
    if (fifos.empty()) return;
    std::vector<RelaxedLimit> each = measure(fifos);
    const auto best =
        std::max_element(each.begin(), each.end(),
                         [](const RelaxedLimit& a, const RelaxedLimit& b) { return a.gain < b.gain; });
    if (best->gain >= enough) {
      *best = shallowest(*best, enough);
      limits_.limit = *best;
    } else if (std::optional<RelaxedLimit> several = fewest(fifos, enough)) {
      limits_.limit = std::move(several);
    }
    for (RelaxedLimit& relaxed : each) {
      if (relaxed.gains()) limits_.add(std::move(relaxed));
    }
  }

  // The FIFO with the least depth of those tried with which it gains enough.
  RelaxedLimit shallowest(const RelaxedLimit& deep, double enough) {
    const std::string& stream = deep.relaxation.fifo;
    std::vector<Relaxation> tried;
    for (const std::int64_t tokens : fifo_depths(config_, base_.metrics, stream))
      tried.push_back(fifo_relaxation(base_.metrics, stream, tokens));
    const std::vector<EvaluationResult> results = trial_(tried);
    if (results.size() < tried.size()) throw Interrupted();
    RelaxedLimit least = deep;
    std::int64_t depth = std::numeric_limits<std::int64_t>::max();
    for (const EvaluationResult& result : results) {
      if (!result.done()) continue;
      const std::int64_t tokens = result.metrics.count("streams/" + stream + "/depth");
      const RelaxedLimit relaxed =
          relaxed_limit(base_, fifo_relaxation(base_.metrics, stream, tokens), result);
      if (relaxed.gain < enough || tokens >= depth) continue;
      least = relaxed;
      depth = tokens;
    }
    return least;
  }

  // The fewest of them that together gain `least`, if all do: halves of them are left out, then quarters, as
  // long as enough is left.
  std::optional<RelaxedLimit> fewest(std::vector<Relaxation> some, double least) {
    RelaxedLimit found = measure({together(some)}).front();
    if (!found.measured || found.gain < least) return std::nullopt;
    for (std::size_t part = some.size() / 2; part > 0; part /= 2) {
      for (std::size_t i = 0; i < some.size() && some.size() > 1;) {
        std::vector<Relaxation> left(some.begin(), some.begin() + i);
        left.insert(left.end(), some.begin() + std::min(i + part, some.size()), some.end());
        RelaxedLimit without;
        if (!left.empty()) without = measure({together(left)}).front();
        if (without.measured && without.gain >= least) {
          some = std::move(left);
          found = std::move(without);
        } else {
          i += part;
        }
      }
    }
    return found;
  }

  static constexpr double kLeastTogether = 1;  // %

  const MachineConfig& config_;
  const EvaluationResult& base_;
  const Trial& trial_;
  RelaxedLimits limits_;
};

}  // namespace

Verdict find_verdict(const MachineConfig& config, const EvaluationResult& base, Thoroughness thoroughness,
                     const Trial& trial) {
  return Search(config, base, trial).find(thoroughness);
}

void add_verdict(MetricGroup& root, const Verdict& verdict) {
  const RelaxedLimits& limits = verdict.limits;
  const MetricWriter out(root, rate_table());
  out.add("limit/verdict", verdict.sentence);
  out.add("limit/relaxation", limits.limit_name());
  out.add("limit/relaxed_frame_rate", limits.limit ? limits.limit->frame_rate : limits.frame_rate);
  out.add("limit/relaxed_part", limits.limit ? limits.limit->next_part : std::string("none"));
}

}  // namespace parallax

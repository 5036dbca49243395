// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "platform/evaluation/alone_search.hpp"
#include "platform/evaluation/fifo_search.hpp"
#include "platform/evaluation/trials.hpp"
#include "platform/machine/part.hpp"
#include "platform/results/rate_metrics.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

// Whether the part that is at work all the time would be faster.
bool relieves_the_busiest(const Relaxation& relaxation, const EvaluationResult& base) {
  const std::vector<std::string>& names = base.limit.relieved_by;
  return std::find(names.begin(), names.end(), relaxation.name) != names.end();
}

std::string sentence_of_all(const EvaluationResult& base, const RelaxedLimits& limits) {
  const bool busy = base.limit.part != "none";
  const std::string part = spoken(base.limit.part);
  if (!limits.limit) return "nothing limits alone, and nothing that was tried gains anything together";
  const RelaxedLimit& found = *limits.limit;
  std::string text;
  if (found.relaxation.limits.size() > 1) {
    text = fmt::format("{} limit together", found.relaxation.subject);
  } else if (busy && relieves_the_busiest(found.relaxation, base)) {
    text = fmt::format("{} limits at {}", part, quantity_text(base.limit.utilisation, "%"));
  } else {
    text = found.relaxation.subject + " limits";
    if (busy)
      text += fmt::format(", though {} is at work for {} of the time", part,
                          quantity_text(base.limit.utilisation, "%"));
  }
  text += fmt::format("; {} {} {}", found.relaxation.remedy,
                      found.relaxation.limits.size() > 1 ? "give" : "gives",
                      quantity_text(found.frame_rate, "frames/s"));
  if (found.next_part == "none") return text + ", and then no part limits alone";
  if (found.next_part == base.limit.part) return text + fmt::format(", and {} still limits", part);
  return text + fmt::format(", then {} limits", spoken(found.next_part));
}

std::string sentence(const EvaluationResult& base, const RelaxedLimits& limits, bool complete) {
  if (complete) return sentence_of_all(base, limits);
  if (!limits.limit)
    return "the time for trials was over before a limit was found; --relax takes the time that it needs";
  return sentence_of_all(base, limits) +
         "; the time for trials was over before all others were tried, --relax tries them";
}

class Search {
 public:
  Search(const MachineConfig& config, const EvaluationResult& base, const Trial& trial)
      : config_(config), trials_(base, trial) {
    limits_.frame_rate = base.rate;
    limits_.latency = base.latency.exposure_to_host;
  }

  Verdict find(Thoroughness thoroughness) {
    bool complete = true;
    try {
      search(thoroughness);
    } catch (const TrialsEnded&) {
      complete = false;
      if (!limits_.limit && !limits_.alone.empty() && limits_.alone.front().gains())
        limits_.limit = limits_.alone.front();
    }
    return {sentence(trials_.base(), limits_, complete), limits_, complete};
  }

 private:
  // Relaxations of the busiest part come first: of two that gain as much these are named.
  void search(Thoroughness thoroughness) {
    all_ = relaxations(config_, trials_.base().metrics);
    const auto others = std::stable_partition(all_.begin(), all_.end(), [this](const Relaxation& relaxation) {
      return relieves_the_busiest(relaxation, trials_.base());
    });
    AloneSearch alone(trials_, [this](const RelaxedLimit& limit) { add(limit); });
    if (thoroughness == Thoroughness::kAll) {
      alone.run(all_, {});
    } else {
      alone.run({all_.begin(), others}, {others, all_.end()});
    }
    if (limits_.alone.empty() || !limits_.alone.front().gains()) {
      limits_.limit = fewest(all_, kLeastTogether);
    } else if (limits_.alone.front().relaxation.name == name_of(Relief::kFifos)) {
      name_fifos(RelaxedLimit(limits_.alone.front()), thoroughness);
    } else {
      limits_.limit = limits_.alone.front();
    }
  }

  std::size_t rank(const RelaxedLimit& limit) const {
    return static_cast<std::size_t>(
        std::find_if(all_.begin(), all_.end(),
                     [&](const Relaxation& one) { return one.name == limit.relaxation.name; }) -
        all_.begin());
  }

  // Of two that gain as much the one that comes first in all_ stays first, whichever was tried first.
  void add(const RelaxedLimit& limit) {
    const auto after =
        std::find_if(limits_.alone.begin(), limits_.alone.end(), [&](const RelaxedLimit& other) {
          return other.gain < limit.gain || (other.gain == limit.gain && rank(other) > rank(limit));
        });
    limits_.alone.insert(after, limit);
  }

  // `all`: what deeper FIFOs gain, all of them. Names the one that does it and the least depth of those tried
  // that is enough, or the fewest.
  void name_fifos(const RelaxedLimit& all, Thoroughness thoroughness) {
    limits_.limit = all;
    const double enough = all.gain - RelaxedLimit::kNoise;
    const std::vector<Relaxation> fifos = fifo_relaxations(trials_.base().metrics);
    if (thoroughness == Thoroughness::kAll) trials_.measure(fifos);
    if (std::optional<RelaxedLimit> one = first_fifo(trials_, fifos, enough)) {
      limits_.limit = one;
      limits_.limit = shallowest(trials_, config_, *one, enough);
    } else if (std::optional<RelaxedLimit> several = fewest(fifos, enough)) {
      limits_.limit = std::move(several);
    }
    for (const Relaxation& fifo : fifos) {
      const bool named = limits_.limit_name() == fifo.name;
      const std::optional<RelaxedLimit> tried = named ? limits_.limit : trials_.measured(fifo);
      if (tried && tried->gains()) add(*tried);
    }
  }

  // The fewest of them that together gain `least`, if all do: halves of them are left out, then quarters, as
  // long as enough is left.
  std::optional<RelaxedLimit> fewest(std::vector<Relaxation> some, double least) {
    if (some.empty()) return std::nullopt;
    RelaxedLimit found = trials_.measure(together(some));
    if (!found.measured || found.gain < least) return std::nullopt;
    for (std::size_t part = some.size() / 2; part > 0; part /= 2) {
      for (std::size_t i = 0; i < some.size() && some.size() > 1;) {
        std::vector<Relaxation> left(some.begin(), some.begin() + i);
        left.insert(left.end(), some.begin() + std::min(i + part, some.size()), some.end());
        RelaxedLimit without;
        if (!left.empty()) without = trials_.measure(together(left));
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
  Trials trials_;
  std::vector<Relaxation> all_;
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

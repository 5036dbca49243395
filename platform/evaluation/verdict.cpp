// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "platform/evaluation/alone_search.hpp"
#include "platform/evaluation/fifo_search.hpp"
#include "platform/evaluation/own_work.hpp"
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

std::string gives(const RelaxedLimit& limit) {
  return fmt::format("{} {} {}", limit.relaxation.remedy,
                     limit.relaxation.remedy_is_plural ? "give" : "gives",
                     quantity_text(limit.frame_rate, "frames/s"));
}

// The core is at work while it waits for software, so that says nothing where software limits.
bool is_at_work_itself(const EvaluationResult& base, const Relaxation& relaxation) {
  return relieves_the_busiest(relaxation, base) &&
         !(base.limit.part == "core" && relaxation.is(Relief::kSoftware));
}

std::string sentence_of_limit(const EvaluationResult& base, const RelaxedLimit& found) {
  const Relaxation& relaxation = found.relaxation;
  const std::string part = spoken(base.limit.part);
  const std::string utilisation = quantity_text(base.limit.utilisation, "%");
  const bool own = is_at_work_itself(base, relaxation);
  std::string text;
  if (relaxation.limits.size() > 1) {
    text = relaxation.subject + " limit together";
  } else if (own) {
    text = fmt::format("{} limits at {}", part, utilisation);
  } else {
    text = relaxation.subject + (relaxation.subject_is_plural ? " limit" : " limits");
    if (base.limit.part != "none" && !relieves_the_busiest(relaxation, base))
      text += fmt::format(", though {} is at work for {} of the time", part, utilisation);
  }
  text += "; " + gives(found);
  if (found.next_part == "none") return text + ", and then no part limits alone";
  if (own && found.next_part == base.limit.part) return text + fmt::format(", and {} still limits", part);
  return text + fmt::format(", then {} limits", spoken(found.next_part));
}

std::string sentence_of_all(const EvaluationResult& base, const Verdict& verdict) {
  if (!verdict.limits.limit)
    return "nothing limits alone, and nothing that was tried gains anything together";
  std::string text = sentence_of_limit(base, *verdict.limits.limit);
  if (verdict.all_fifos)
    text += "; all FIFOs deeper give " + quantity_text(verdict.all_fifos->frame_rate, "frames/s");
  if (verdict.faster_clock)
    text += fmt::format("; {}, as it shortens these waits too", gives(*verdict.faster_clock));
  return text;
}

std::string sentence(const EvaluationResult& base, const Verdict& verdict) {
  if (verdict.complete) return sentence_of_all(base, verdict);
  if (!verdict.limits.limit)
    return "the time for trials was over before a limit was found; --relax takes the time that it needs";
  return sentence_of_all(base, verdict) +
         "; the time for trials was over before all others were tried, --relax tries them";
}

// The share of a frame's time that goes when a limit does, which gains so much, %.
double share_of(double gain) { return 1 - 1 / (1 + gain / 100); }
double share_of(const RelaxedLimit& limit) { return share_of(limit.gain); }

class Search {
 public:
  Search(const MachineConfig& config, const EvaluationResult& base, const Trial& trial)
      : config_(config), trials_(base, trial) {
    limits_.frame_rate = base.rate;
    limits_.latency = base.latency.exposure_to_host;
  }

  Verdict find(Thoroughness thoroughness) {
    try {
      search(thoroughness);
    } catch (const TrialsEnded&) {
      found_.complete = false;
      if (!limits_.limit && !limits_.alone.empty() && limits_.alone.front().gains())
        limits_.limit = limits_.alone.front();
    }
    found_.sentence = sentence(trials_.base(), found_);
    return found_;
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
      if (limits_.limit && limits_.limit->relaxation.limits.size() == 2) name_best_pair();
      return;
    }
    limits_.limit = limits_.alone.front();
    if (limits_.limit->relaxation.is(Relief::kCoreClock)) look_behind_the_clock();
    if (limits_.limit->relaxation.is(Relief::kFifos)) name_fifos(RelaxedLimit(*limits_.limit), thoroughness);
  }

  // Of two that gain together, either may gain more with a third: where cameras have the core's pace, a
  // faster core gains a little, and software that takes no time much.
  void name_best_pair() {
    const std::vector<Relief> pair = limits_.limit->relaxation.limits;
    for (const Relief of_pair : pair) {
      const auto one =
          std::find_if(all_.begin(), all_.end(), [&](const Relaxation& r) { return r.is(of_pair); });
      std::vector<Relaxation> others;
      std::copy_if(all_.begin(), all_.end(), std::back_inserter(others),
                   [&](const Relaxation& other) { return !other.is(of_pair); });
      AloneSearch(trials_,
                  [&](const RelaxedLimit& limit) {
                    if (limit.measured && limit.gain > limits_.limit->gain + RelaxedLimit::kNoise)
                      limits_.limit = limit;
                  },
                  {*one})
          .run({}, others);
    }
  }

  // A faster clock shortens every cycle of the core, those in which it waits for a FIFO or a buffer, too: all
  // gains by it are in proportion. Where what a limit costs is a part of the core's own cycles, that limit is
  // named; not what lies between frames, a stage's look-ahead and a core that is started with one after the
  // other.
  void look_behind_the_clock() {
    const RelaxedLimit clock = *limits_.limit;
    const double outside = 1 - 2 * share_of(clock);  // of a frame's time, as half of the rest went
    const auto inside = [&](const RelaxedLimit& limit) {
      return limit.measured && share_of(limit) > outside + kLeastInside;
    };
    std::vector<Relaxation> others;
    std::copy_if(all_.begin(), all_.end(), std::back_inserter(others), [&](const Relaxation& relaxation) {
      return !is_clock(relaxation) && !relaxation.is(Relief::kFrameGap) &&
             !relaxation.is(Relief::kSoftware) && !relieves_the_busiest(relaxation, trials_.base()) &&
             share_of(most_gain(relaxation, trials_.base().metrics)) > outside + kLeastInside;
    });
    if (others.empty() || !inside(trials_.measure(together(others)))) return;
    std::optional<RelaxedLimit> best;
    AloneSearch(trials_, [&](const RelaxedLimit& limit) {
      add_once(limit);
      if (inside(limit) && (!best || limit.gain > best->gain)) best = limit;
    }).run({}, others);
    if (!best) return;
    limits_.limit = best;
    found_.faster_clock = clock;
  }

  static bool is_clock(const Relaxation& relaxation) {
    return relaxation.is(Relief::kCoreClock) || relaxation.is(Relief::kMemoryClock) ||
           relaxation.is(Relief::kCameraClock) || relaxation.is(Relief::kLinkClock);
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

  void add_once(const RelaxedLimit& limit) {
    const bool known = std::any_of(
        limits_.alone.begin(), limits_.alone.end(),
        [&](const RelaxedLimit& other) { return other.relaxation.name == limit.relaxation.name; });
    if (!known) add(limit);
  }

  // `all`: what deeper FIFOs gain, all of them. Names the one that does it, or most of it, and the least
  // depth of those tried that is enough; or the default depth that does it; or the fewest.
  void name_fifos(const RelaxedLimit& all, Thoroughness thoroughness) {
    limits_.limit = all;
    const double enough = all.gain - RelaxedLimit::kNoise;
    const std::vector<Relaxation> fifos = fifo_relaxations(trials_.base().metrics, true);
    if (thoroughness == Thoroughness::kAll) trials_.measure(fifos);
    if (std::optional<RelaxedLimit> one = first_fifo(trials_, fifos, enough)) {
      limits_.limit = one;
      limits_.limit = shallowest(trials_, config_, *one, enough);
    } else if (std::optional<RelaxedLimit> most = best_fifo(fifos);
               most && most->gain >= kMostOfIt * all.gain) {
      limits_.limit = most;
      found_.all_fifos = all;
      limits_.limit = shallowest(trials_, config_, *most, most->gain - RelaxedLimit::kNoise);
    } else if (std::optional<RelaxedLimit> by_default =
                   least_default_depth(trials_, config_, fifos, enough)) {
      limits_.limit = std::move(by_default);
    } else if (std::optional<RelaxedLimit> several = fewest_fifos(fifos, enough)) {
      limits_.limit = several;
      limits_.limit = shallowest_of_several(trials_, *several, enough);
    }
    for (const Relaxation& fifo : fifos) {
      const bool named = limits_.limit_name() == fifo.name;
      const std::optional<RelaxedLimit> tried = named ? limits_.limit : trials_.measured(fifo);
      if (tried && tried->gains()) add(*tried);
    }
  }

  std::optional<RelaxedLimit> best_fifo(const std::vector<Relaxation>& fifos) {
    std::optional<RelaxedLimit> best;
    AloneSearch(trials_, [&](const RelaxedLimit& limit) {
      if (limit.gains() && (!best || limit.gain > best->gain)) best = limit;
    }).run({}, fifos);
    return best;
  }

  // Of those that are full, or of all: as these hand more on, others may hold it up.
  std::optional<RelaxedLimit> fewest_fifos(const std::vector<Relaxation>& full, double enough) {
    const std::optional<RelaxedLimit> some = fewest(full, enough);
    return some ? some : fewest(fifo_relaxations(trials_.base().metrics, false), enough);
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

  static constexpr double kLeastTogether = 1;   // %
  static constexpr double kLeastInside = 0.05;  // of a frame's time
  static constexpr double kMostOfIt = 0.5;      // of what all FIFOs gain

  const MachineConfig& config_;
  Trials trials_;
  std::vector<Relaxation> all_;
  Verdict found_;
  RelaxedLimits& limits_ = found_.limits;
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
  if (verdict.all_fifos) out.add("limit/all_fifos_frame_rate", verdict.all_fifos->frame_rate);
  if (verdict.faster_clock) out.add("limit/faster_clock_frame_rate", verdict.faster_clock->frame_rate);
  out.add("limit/relaxed_part", limits.limit ? limits.limit->next_part : std::string("none"));
}

}  // namespace parallax

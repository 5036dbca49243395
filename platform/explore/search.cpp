// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <set>
#include <utility>

namespace parallax {
namespace {

// Of the budget, what a turn of the genetic algorithm may take before the neighbours' turn.
constexpr double kGeneticShare = 0.7;
constexpr std::size_t kLeastPopulation = 8;  // the least that the library takes
constexpr std::size_t kLargestPopulation = 64;
// The population is so small a part of the budget that there are some generations of it.
constexpr std::size_t kPopulations = 10;
// Generations without a machine that was not seen before: the population has settled.
constexpr int kSettled = 3;
// Turns without a new machine: what is left are places that chance does not reach.
constexpr int kTurnsWithoutNews = 10;

// The usual ones (Deb et al., 2002).
constexpr double kCrossover = 0.95;
constexpr double kCrossoverIndex = 10;
constexpr double kMutationIndex = 50;

// Costs beyond those of any machine that satisfies all constraints: with them plain domination, which is all
// that the library knows, becomes Deb's.
constexpr double kInfeasible = 1e30;
constexpr double kMostMissed = 1e6;
constexpr double kFailed = 1e38;
constexpr double kExcluded = 1e39;

class FrontSearch {
 public:
  FrontSearch(const SearchPlan& plan, const Evaluate& evaluate) : plan_(plan), evaluate_(evaluate) {}

  SearchEnd run() {
    try {
      if (space() <= static_cast<double>(plan_.budget)) {
        enumerate();
      } else {
        alternate();
      }
    } catch (const Ended& ended) {
      return ended.how;
    }
    return SearchEnd::kExhausted;
  }

  // How the genetic algorithm sees merits.
  const Merit& merit(const Place& place) {
    see({place});
    return seen_.at(place);
  }
  void see(const std::vector<Place>& places) {
    std::vector<Place> fresh;
    std::set<Place> asked;
    for (const Place& place : places) {
      if (seen_.count(place) == 0 && asked.insert(place).second) fresh.push_back(place);
    }
    ask(fresh);
  }
  std::size_t objectives() const { return std::max<std::size_t>(objectives_, 2); }
  std::vector<double> costs(const Place& place) {
    const Merit& merit = this->merit(place);
    if (merit.kind == Merit::Kind::kFailed) return std::vector<double>(objectives(), kFailed);
    if (merit.kind == Merit::Kind::kExcluded) return std::vector<double>(objectives(), kExcluded);
    if (merit.missed > 0)
      return std::vector<double>(objectives(), kInfeasible * (1 + std::min(merit.missed, kMostMissed)));
    std::vector<double> costs = merit.costs;
    // It wants two; of one the same twice is the same order.
    while (costs.size() < objectives()) costs.push_back(costs.empty() ? 0 : costs.front());
    return costs;
  }
  const std::vector<std::size_t>& sizes() const { return plan_.sizes; }

 private:
  struct Ended {
    SearchEnd how;
  };

  double space() const {
    double product = 1;
    for (const std::size_t size : plan_.sizes) product *= static_cast<double>(size);
    return product;
  }

  // Excluded ones cost nothing; so as many as are left of the budget at a time.
  void ask(const std::vector<Place>& places) {
    for (auto next = places.begin(); next != places.end();) {
      if (evaluated_ == plan_.budget) throw Ended{SearchEnd::kBudget};
      const auto left = static_cast<std::ptrdiff_t>(plan_.budget - evaluated_);
      const auto last = next + std::min(left, places.end() - next);
      const std::vector<Place> some(next, last);
      const std::vector<Merit> merits = evaluate_(some);
      for (std::size_t i = 0; i < merits.size(); ++i) note(some[i], merits[i]);
      if (merits.size() < some.size()) throw Ended{SearchEnd::kInterrupted};
      next = last;
    }
  }

  void note(const Place& place, const Merit& merit) {
    objectives_ = std::max(objectives_, merit.costs.size());
    if (merit.kind != Merit::Kind::kExcluded) ++evaluated_;
    seen_[place] = merit;
    const auto beaten = [&](const Place& other) { return beats(merit, seen_.at(other)); };
    if (std::any_of(front_.begin(), front_.end(),
                    [&](const Place& other) { return beats(seen_.at(other), merit); }))
      return;
    front_.erase(std::remove_if(front_.begin(), front_.end(), beaten), front_.end());
    front_.push_back(place);
  }

  void enumerate() {
    std::vector<Place> all;
    Place place(plan_.sizes.size(), 0);
    for (bool more = true; more;) {
      all.push_back(place);
      std::size_t axis = place.size();
      while (axis != 0 && ++place[axis - 1] == plan_.sizes[axis - 1]) place[--axis] = 0;
      more = axis != 0;
    }
    see(all);
  }

  void alternate() {
    see(some_places());  // now the number of objectives is known
    auto seed = static_cast<unsigned>(plan_.seed ^ (plan_.seed >> 32));
    for (int without_news = 0; without_news < kTurnsWithoutNews && !all_seen(); ++seed) {
      const std::size_t before = seen_.size();
      evolve(seed);
      look_around();
      without_news = seen_.size() == before ? without_news + 1 : 0;
    }
    if (space() <= static_cast<double>(kSmallSpace)) enumerate();
  }

  bool all_seen() const { return static_cast<double>(seen_.size()) == space(); }

  // The middle, and the corners that differ from it in one axis.
  std::vector<Place> some_places() const {
    Place middle;
    for (const std::size_t size : plan_.sizes) middle.push_back(size / 2);
    std::vector<Place> places{middle};
    for (std::size_t axis = 0; axis < middle.size(); ++axis) {
      for (const std::size_t end : {std::size_t{0}, plan_.sizes[axis] - 1}) {
        Place place = middle;
        place[axis] = end;
        places.push_back(std::move(place));
      }
    }
    return places;
  }

  void evolve(unsigned seed);

  // Until every neighbour of every place on the front was seen: first those one step away on one axis, then
  // on two.
  void look_around() {
    for (;;) {
      if (look_around(false)) continue;
      if (!look_around(true)) return;
    }
  }

  // Whether there was anything new to look at.
  bool look_around(bool pairs) {
    const std::vector<Place> front = front_;
    std::vector<Place> next;
    for (const Place& place : front) {
      if (!expanded_[pairs ? 1 : 0].insert(place).second) continue;
      for (Place& neighbour : neighbours(place, pairs)) next.push_back(std::move(neighbour));
    }
    const std::size_t before = seen_.size();
    see(next);
    return seen_.size() != before;
  }

  std::vector<Place> neighbours(const Place& place, bool pairs) const {
    std::vector<Place> all;
    for (std::size_t axis = 0; axis < place.size(); ++axis) {
      for (const int step : {-1, 1}) {
        const std::optional<Place> one = moved(place, axis, step);
        if (!one) continue;
        if (!pairs) {
          all.push_back(*one);
          continue;
        }
        for (std::size_t other = axis + 1; other < place.size(); ++other) {
          for (const int second : {-1, 1}) {
            if (std::optional<Place> two = moved(*one, other, second)) all.push_back(std::move(*two));
          }
        }
      }
    }
    return all;
  }

  std::optional<Place> moved(Place place, std::size_t axis, int step) const {
    if (step < 0 && place[axis] == 0) return std::nullopt;
    if (step > 0 && place[axis] + 1 == plan_.sizes[axis]) return std::nullopt;
    place[axis] = step < 0 ? place[axis] - 1 : place[axis] + 1;
    return place;
  }

  // So many can be gone through to find the last that chance did not reach.
  static constexpr std::size_t kSmallSpace = 100'000;

  const SearchPlan& plan_;
  const Evaluate& evaluate_;
  std::map<Place, Merit> seen_;
  std::vector<Place> front_;     // of what was seen, what is not beaten
  std::set<Place> expanded_[2];  // whose neighbours were seen
  std::size_t evaluated_ = 0;
  std::size_t objectives_ = 0;
};

Place place_in(const pagmo::vector_double& numbers, std::size_t first, std::size_t axes) {
  Place place;
  for (std::size_t i = first; i < first + axes; ++i) place.push_back(static_cast<std::size_t>(numbers[i]));
  return place;
}

// The space as the library has it: whole numbers between bounds. A problem is copied, so it points to the
// search.
struct SpaceProblem {
  FrontSearch* search = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& numbers) const {
    return search->costs(place_in(numbers, 0, numbers.size()));
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    pagmo::vector_double least, most;
    for (const std::size_t size : search->sizes()) {
      least.push_back(0);
      most.push_back(static_cast<double>(size - 1));
    }
    return {least, most};
  }
  pagmo::vector_double::size_type get_nobj() const { return search->objectives(); }
  pagmo::vector_double::size_type get_nix() const { return search->sizes().size(); }
};

// A generation at once, so that all processors have work.
struct GenerationAtOnce {
  FrontSearch* search = nullptr;

  pagmo::vector_double operator()(const pagmo::problem&, const pagmo::vector_double& numbers) const {
    const std::size_t axes = search->sizes().size();
    std::vector<Place> places;
    for (std::size_t i = 0; i < numbers.size(); i += axes) places.push_back(place_in(numbers, i, axes));
    search->see(places);
    pagmo::vector_double all;
    for (const Place& place : places) {
      const std::vector<double> costs = search->costs(place);
      all.insert(all.end(), costs.begin(), costs.end());
    }
    return all;
  }
};

void FrontSearch::evolve(unsigned seed) {
  std::size_t population = std::clamp(plan_.budget / kPopulations, kLeastPopulation, kLargestPopulation);
  population -= population % 4;  // as the library wants it
  const auto most =
      evaluated_ + static_cast<std::size_t>(kGeneticShare * static_cast<double>(plan_.budget - evaluated_));
  const pagmo::problem problem{SpaceProblem{this}};
  const pagmo::bfe at_once{GenerationAtOnce{this}};
  pagmo::population machines(problem, at_once, population, seed);
  pagmo::nsga2 algorithm(1, kCrossover, kCrossoverIndex, 1.0 / static_cast<double>(plan_.sizes.size()),
                         kMutationIndex, seed);
  algorithm.set_bfe(at_once);
  for (int settled = 0; settled < kSettled && evaluated_ < most;) {
    const std::size_t before = seen_.size();
    machines = algorithm.evolve(machines);
    settled = seen_.size() == before ? settled + 1 : 0;
  }
}

}  // namespace

SearchEnd search(const SearchPlan& plan, const Evaluate& evaluate) {
  return FrontSearch(plan, evaluate).run();
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/sampling.hpp"

#include <boost/random/sobol.hpp>
#include <numeric>
#include <utility>

namespace parallax {
namespace {

// The standard's distributions may differ from library to library.
double unit_number(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

class RandomPlaces final : public PlaceSource {
 public:
  RandomPlaces(std::uint64_t seed, std::size_t dimensions) : random_(seed), place_(dimensions) {}

  std::optional<std::vector<double>> next() override {
    for (double& number : place_) number = unit_number(random_());
    return place_;
  }

 private:
  std::mt19937_64 random_;
  std::vector<double> place_;
};

class LatinPlaces final : public PlaceSource {
 public:
  LatinPlaces(const SamplingPlan& plan, std::size_t dimensions)
      : random_(plan.seed), points_(plan.points), strata_(dimensions) {
    for (std::vector<std::uint32_t>& order : strata_) {
      order.resize(points_);
      std::iota(order.begin(), order.end(), 0U);
      for (std::size_t left = points_; left > 1; --left) std::swap(order[left - 1], order[random_() % left]);
    }
  }

  std::optional<std::vector<double>> next() override {
    if (taken_ == points_) return std::nullopt;
    std::vector<double> place;
    for (const std::vector<std::uint32_t>& order : strata_)
      place.push_back((order[taken_] + unit_number(random_())) / static_cast<double>(points_));
    ++taken_;
    return place;
  }

 private:
  std::mt19937_64 random_;
  std::size_t points_;
  std::size_t taken_ = 0;
  std::vector<std::vector<std::uint32_t>> strata_;  // by dimension: which part each point lies in
};

class SobolPlaces final : public PlaceSource {
 public:
  SobolPlaces(std::uint64_t seed, std::size_t dimensions) : sequence_(dimensions) {
    std::mt19937_64 random(seed);
    for (std::size_t i = 0; i < dimensions; ++i) shift_.push_back(random());
  }

  std::optional<std::vector<double>> next() override {
    // The library leaves out the first point, the origin, without which 2^k points do not lie evenly.
    const bool first = std::exchange(first_, false);
    std::vector<double> place;
    for (const std::uint64_t shift : shift_) place.push_back(unit_number((first ? 0 : sequence_()) ^ shift));
    return place;
  }

 private:
  boost::random::sobol sequence_;  // 64 bits a number, dimension after dimension
  std::vector<std::uint64_t> shift_;
  bool first_ = true;
};

}  // namespace

std::unique_ptr<PlaceSource> make_place_source(const SamplingPlan& plan, std::size_t dimensions) {
  if (plan.method == SamplingMethod::kLatinHypercube) return std::make_unique<LatinPlaces>(plan, dimensions);
  if (plan.method == SamplingMethod::kSobol) return std::make_unique<SobolPlaces>(plan.seed, dimensions);
  return std::make_unique<RandomPlaces>(plan.seed, dimensions);
}

Sampling::Sampling(const std::vector<Axis>& axes, const SamplingPlan& plan)
    : axes_(axes), method_(plan.method) {
  if (method_ == SamplingMethod::kGrid) at_.resize(axes.size());
  if (draws(method_)) {
    places_ = make_place_source(plan, axes.size());
  }
}

std::optional<std::vector<std::string>> Sampling::next() {
  if (method_ == SamplingMethod::kGrid) return next_of_grid();
  if (method_ == SamplingMethod::kOneAtATime) return next_at_a_time();
  const std::optional<std::vector<double>> place = places_->next();
  if (!place) return std::nullopt;
  std::vector<std::string> values;
  for (std::size_t i = 0; i < axes_.size(); ++i) values.push_back(value_at(axes_[i], (*place)[i]));
  return values;
}

std::optional<std::vector<std::string>> Sampling::next_at_a_time() {
  if (axis_ == axes_.size()) return std::nullopt;
  std::vector<std::string> values;
  for (const Axis& axis : axes_) values.push_back(axis.values.front());
  values[axis_] = axes_[axis_].values[value_];
  // The first value of an axis is the base, which was there.
  for (++value_; axis_ < axes_.size() && value_ >= axes_[axis_].values.size(); ++axis_) value_ = 1;
  return values;
}

std::optional<std::vector<std::string>> Sampling::next_of_grid() {
  if (at_.empty()) return std::nullopt;
  std::vector<std::string> values;
  for (std::size_t i = 0; i < axes_.size(); ++i) values.push_back(axes_[i].values[at_[i]]);
  std::size_t axis = axes_.size();
  while (axis != 0 && ++at_[axis - 1] == axes_[axis - 1].values.size()) at_[--axis] = 0;
  if (axis == 0) at_.clear();
  return values;
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/results/rate_metrics.hpp"

namespace parallax {
namespace {

std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace

std::string verdict(const nlohmann::ordered_json& base, const Part* part, const RelaxedLimits& limits) {
  const RelaxedLimit* const found = limits.limit();
  const std::string share =
      part == nullptr
          ? ""
          : fmt::format(" at {:.1f} %", base.at("limit").at("utilisation").at("value").get<double>());
  if (found == nullptr) {
    return part == nullptr
               ? "no limit gains anything alone: each frame fills the look-ahead anew, or two are equal"
               : fmt::format("{} limits{}, and so does another: alone, neither gains", spoken(part->name),
                             share);
  }
  const bool named = part != nullptr && part->is_relieved_by(found->relaxation.limit);
  const std::string limiting = named ? part->name : found->relaxation.name();
  std::string text = fmt::format("{} limits{}; {} gives {:.1f} fps", spoken(limiting), named ? share : "",
                                 found->relaxation.remedy, found->frame_rate);
  if (found->next_part == "none") return text + ", and then no part limits alone";
  if (part != nullptr && found->next_part == part->name)
    return text + fmt::format(", and {} still limits", spoken(part->name));
  return text + fmt::format(", then {} limits", spoken(found->next_part));
}

void add_verdict(MetricGroup& root, const std::string& sentence, const RelaxedLimits& limits) {
  const MetricWriter out(root, rate_table());
  const RelaxedLimit* const found = limits.limit();
  out.add("limit/verdict", sentence);
  out.add("limit/relaxation", found == nullptr ? std::string("none") : found->relaxation.name());
  out.add("limit/relaxed_frame_rate", found == nullptr ? limits.frame_rate : found->frame_rate);
  out.add("limit/relaxed_part", found == nullptr ? std::string("none") : found->next_part);
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/input/partner_names.hpp"

#include <filesystem>

#include "platform/input/letters.hpp"

namespace parallax {
namespace {

std::string without_extension(const std::string& name) {
  return std::filesystem::path(name).replace_extension().string();
}

}  // namespace

PartnerNames::PartnerNames(const std::vector<std::string>& names, bool any_case) : any_case_(any_case) {
  for (const std::string& name : names) {
    by_name_.emplace(key(name), name);
    by_stem_[key(without_extension(name))].push_back(name);
  }
}

std::string PartnerNames::key(const std::string& name) const { return any_case_ ? lower(name) : name; }

std::optional<std::string> PartnerNames::named(const std::string& wanted) const {
  const auto found = by_name_.find(key(wanted));
  if (found == by_name_.end()) return std::nullopt;
  return found->second;
}

std::optional<std::string> PartnerNames::of_other_format(const std::string& wanted,
                                                         const std::set<std::string>& paired) const {
  const auto found = by_stem_.find(key(without_extension(wanted)));
  if (found == by_stem_.end()) return std::nullopt;
  std::optional<std::string> only;
  for (const std::string& name : found->second) {
    if (paired.count(name) > 0) continue;
    if (only) return std::nullopt;
    only = name;
  }
  return only;
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace parallax {

/// The images of a folder that may be the partner of another, by the name that is wanted.
class PartnerNames {
 public:
  /// `any_case`: names that differ in capital and small letters alone are one.
  PartnerNames(const std::vector<std::string>& names, bool any_case);

  std::optional<std::string> named(const std::string& wanted) const;

  /// The only one that is not `paired` and differs from the name in its extension alone: left.png, right.jpg.
  std::optional<std::string> of_other_format(const std::string& wanted,
                                             const std::set<std::string>& paired) const;

 private:
  std::string key(const std::string& name) const;

  bool any_case_;
  std::map<std::string, std::string> by_name_;
  std::map<std::string, std::vector<std::string>> by_stem_;
};

}  // namespace parallax

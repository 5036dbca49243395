// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "platform/estimate/device_file.hpp"
#include "platform/evaluation/evaluation_pool.hpp"

namespace parallax {

/// The numbers of an estimate that belong to those of a run, where they are asked for.
class CaseEstimate {
 public:
  /// `device`: whose shares are asked for, too; empty: none, and cells of the 7 series if `metrics` names any
  /// of an estimate. Throws UserError: no such device.
  CaseEstimate(const std::string& device, const std::vector<std::string>& metrics);

  /// Adds them to a case whose input is there. Throws UserError where the image does not fit into the tiles.
  void add_to(EvaluationCase& one) const;
  /// Of all that the device's file says: the same for the same device; empty where nothing is asked for.
  const std::string& identity() const { return identity_; }

 private:
  const bool shares_;
  const std::optional<DeviceFile> device_;
  const std::string identity_;
};

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "platform/config/energy_config.hpp"
#include "platform/results/limits.hpp"
#include "traces/metric_table.hpp"

namespace parallax {

/// What the machine did in some time, in the units that EnergyConfig prices.
struct EnergyActivity {
  double seconds = 0;                 ///< that all of it took, above 0
  double frames = 0;                  ///< that were delivered, above 0
  double census_bits = 0;             ///< that the matcher compared
  double path_updates = 0;            ///< evaluations times paths
  double stage_bits = 0;              ///< read by the other stages, memory ports left out
  double core_cycles = 0;             ///< cycles of the core's clock
  double on_chip_bytes = 0;           ///< written and read
  double memory_bytes = 0;            ///< through all ports of the memory
  std::optional<double> rows_opened;  ///< by the DRAM's controller; none: estimated from the bytes
  double link_bits = 0;               ///< on the wire
  double camera_bytes = 0;            ///< from both cameras
  bool link = true;                   ///< whether there is one
};

/// Of the steady window; when it holds no frame, from the run's begin until the host has the only frame, with
/// what the cameras deliver of later frames until then.
///
/// What stages and FIFOs do follows from their schedules, for each frame the same. A line buffer is taken to
/// be written and read once for each row that passes, and a FIFO for each token; the buffer of a memory port
/// for each byte. Rows and columns that tiles share count for each of them.
EnergyActivity energy_activity(const Machine& machine, const SteadyWindow& window);

/// An estimate: activity times what a unit of it costs, and what each part takes all the time.
struct EnergyEstimate {
  struct Part {
    std::string name;         ///< "matcher", as in `energy/power_matcher`
    std::string description;  ///< what it holds
    double joules = 0;
  };
  std::vector<Part> parts;
  double seconds = 0;
  double frames = 0;

  double joules() const;  ///< of all parts
  double watts(double part_joules) const { return part_joules / seconds; }
  double millijoules_per_frame(double part_joules) const { return part_joules / frames * 1e3; }
};

/// `activity.seconds` and `.frames` must be above 0.
EnergyEstimate estimate_energy(const EnergyConfig& config, const EnergyActivity& activity);

/// Power and energy of a frame, for each part and for all.
void add_energy(MetricGroup& root, const EnergyEstimate& estimate, const std::string& window);
const MetricTable& energy_table();

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "platform/evaluation/depth_search.hpp"
#include "platform/evaluation/frame_period.hpp"
#include "platform/evaluation/machine_fifos.hpp"

namespace parallax {

/// What the FIFOs have to be deep enough for.
struct FifoGoal {
  enum class Kind {
    kFullRate,      ///< the rate of the machine with all FIFOs deep
    kRate,          ///< this rate
    kDeadlockFree,  ///< that all frames come out
  };
  Kind kind = Kind::kFullRate;
  double rate = 0;       ///< frames/s, of kRate
  double tolerance = 0;  ///< of kFullRate: the share by which a frame may take longer
  /// Whatever comes to its end reaches it: of short runs that end early when the core is too slow for it.
  bool by_core = false;
  bool front = false;  ///< FifoSizing::front is wanted
};

/// A machine with certain depths.
struct SizedRun {
  Depths depths;
  bool done = false;
  bool too_slow = false;  ///< it is not, as a frame took longer than the goal allows
  std::string message;    ///< why it is not, one line
  FramePeriod period;     ///< if done
  double latency = 0;     ///< ms, from exposure to the host, mean of the steady state; if done
  Depths high_water;      ///< tokens; if done
  std::string limit;      ///< part that limits, "none"; if done
  std::string limit_key;  ///< keys that move it
};

/// What was found, and what shows it.
struct FifoSizing {
  std::vector<MachineFifo> fifos;
  FifoGoal goal;
  SizedRun now;                 ///< as configured
  SizedRun deep;                ///< all FIFOs deep (deep_enough())
  SizedRun found;               ///< the smallest; without depths where the goal is not reached
  std::vector<SizedRun> proof;  ///< with one token less in one FIFO; of the others there is one only
  /// Rate, latency and bits against each other, the fastest first: the depths now and found, and some on the
  /// way to those that only avoid a deadlock; what another one beats in all three is left out.
  std::vector<SizedRun> front;
  std::vector<std::size_t> less;  ///< in which
  std::size_t runs = 0;           ///< of the machine, in all

  std::int64_t bits(const Depths& depths) const;
};

/// Depths that no longer matter: each many times what is configured, or derived.
Depths deep_depths(const std::vector<MachineFifo>& fifos);

/// "key=value" of each.
std::vector<std::string> assignments(const std::vector<MachineFifo>& fifos, const Depths& depths);

/// The smallest depths of a machine's FIFOs with which it reaches the goal (DepthSearch).
///
/// `evaluate`: runs of the machine with these keys set, "key=value", in their order; fewer: no more are
/// wanted, then TrialsEnded is thrown. Those in which the core takes longer for a frame than
/// `longest_frame_ps` may end early (EvaluationInput). UserError where the machine cannot be, or does not
/// come to its end with all FIFOs deep.
class FifoSizer {
 public:
  using Evaluate = std::function<std::vector<EvaluationResult>(
      const std::vector<std::vector<std::string>>& assignments, std::int64_t longest_frame_ps)>;

  FifoSizer(std::vector<MachineFifo> fifos, Evaluate evaluate);

  /// `guess`: depths that may be the smallest, or none; wrong ones cost time only.
  FifoSizing size(const FifoGoal& goal, const Depths& guess = {});

 private:
  std::vector<SizedRun> run(const std::vector<Depths>& all);
  SizedRun sized(const Depths& depths, const EvaluationResult& result) const;
  bool reaches(const FifoGoal& goal, const SizedRun& run) const;
  Depths enough(const SizedRun& run) const;
  Depths start(const FifoGoal& goal);
  std::int64_t longest_frame(const FifoGoal& goal) const;
  void prove();
  std::vector<SizedRun> front();

  const Evaluate evaluate_;
  FifoSizing sizing_;
  std::map<Depths, SizedRun> known_;
  std::int64_t longest_frame_ps_ = 0;  // that reaches the goal
};

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <utility>

namespace parallax {

/// When the simulation of a run ends: when the machine has nothing left to do, when it is interrupted, or
/// when a frame fails and those before it are at the host.
class Simulation {
 public:
  /// `frames`: of the run. `interrupted` is asked ten times a second and with every frame, if between two of
  /// these nothing takes longer.
  Simulation(std::int64_t frames, std::function<bool()> interrupted)
      : frames_(frames), interrupted_(std::move(interrupted)) {}

  /// Throws what a frame's load or take has thrown, and UserError when the machine is so slow that simulated
  /// time does not hold the run. `reached` hears now and then of the simulated time, s.
  void run(const std::function<void(double seconds)>& reached);
  /// Whether run() ended before the machine had nothing left to do: it was interrupted.
  bool stopped() const { return stopped_; }

  /// The machine asks for a frame: `load` brings it.
  template <class Load>
  auto at_exposure(std::int64_t frame, const Load& load) -> decltype(load()) {
    if (interrupted_()) stop();
    return guarded(frame, load);
  }
  /// The host has the next frame: `take` keeps it. The last one is kept even when interrupted.
  template <class Take>
  void at_delivery(const Take& take) {
    if (interrupted_() && delivered_ + 1 < frames_) stop();
    guarded(delivered_, [&] {
      take();
      if (++delivered_ == broken_) stop();
      return 0;
    });
  }

 private:
  // The kernel must not see an exception: it would lose its line.
  template <class Action>
  auto guarded(std::int64_t frame, const Action& action) -> decltype(action()) {
    if (stopped_) return {};
    try {
      if (frame < broken_) return action();
    } catch (...) {
      failure_ = std::current_exception();
      broken_ = frame;
      if (delivered_ >= broken_) stop();
    }
    return {};
  }
  void stop();

  const std::int64_t frames_;
  const std::function<bool()> interrupted_;
  std::int64_t delivered_ = 0;
  std::int64_t broken_ = std::numeric_limits<std::int64_t>::max();  ///< the first frame that failed
  std::exception_ptr failure_;
  bool stopped_ = false;
};

}  // namespace parallax

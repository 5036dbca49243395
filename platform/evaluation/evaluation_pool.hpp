// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "platform/config/configuration.hpp"
#include "platform/evaluation/evaluate.hpp"
#include "platform/evaluation/worker_process.hpp"
#include "platform/input/image_input.hpp"

namespace parallax {

/// A machine like one that a pool was made for, with further keys set.
struct Variant {
  std::vector<std::string> assignments;  ///< "key=value"
  std::size_t base = 0;                  ///< which of these machines, if they are several
};

/// A machine and what it is timed on.
struct EvaluationCase {
  Configuration configuration;
  EvaluationInput input;
  MetricGroup further{};  ///< what is known of it beside its time: groups that go into the result's metrics
};

/// Processes that evaluate variants of machines, as many at a time as this computer has processors for. They
/// are copies of this process as it was when the pool was made, so a pool made before this process simulates
/// can be used after. The results do not depend on their number.
class EvaluationPool {
 public:
  /// Makes a variant's case, in one of these processes; throws UserError where it is not possible. What the
  /// case points to must last until the next call.
  using Preparation = std::function<EvaluationCase(const Variant&, const NoticeSink&)>;
  /// The result of a variant, by its number.
  using Taker = std::function<void(std::size_t, EvaluationResult)>;

  /// One for each processor, of many-core computers eight.
  static unsigned usual_processes();
  explicit EvaluationPool(const Preparation& prepare, unsigned processes = usual_processes());

  enum class Order {
    kOfVariants,  ///< each as soon as it and all before are there
    kOfResults,   ///< each as soon as it is there
  };

  /// Hands each variant's result to `take`, in this order; with `configuration`. A process that dies is a
  /// failure of its variant alone. `interrupted` is asked some ten times a second; when it says yes, what is
  /// under way is given up. Returns how many results were taken: all, unless interrupted.
  std::size_t evaluate(const std::vector<Variant>& variants, const std::function<bool()>& interrupted,
                       const Taker& take, Order order = Order::kOfVariants);

 private:
  std::vector<std::unique_ptr<WorkerProcess>> processes_;
};

}  // namespace parallax

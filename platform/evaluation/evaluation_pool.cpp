// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/evaluation_pool.hpp"

#include <poll.h>
#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <thread>
#include <utility>

#include "platform/config/config_writer.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"

namespace parallax {
namespace {

using Json = nlohmann::ordered_json;
using State = WorkerProcess::State;
using Status = EvaluationResult::Status;

constexpr unsigned kMostProcesses = 8;
// So many variants may be done before one that takes long: what is kept until then is bounded.
constexpr std::size_t kAheadOfEach = 16;

// Names of files, as they may be among the values, are any bytes, which JSON's text would not hold.
std::string request_of(const Variant& variant) {
  const std::vector<std::uint8_t> bytes =
      Json::to_cbor(Json{{"base", variant.base}, {"assignments", variant.assignments}});
  return {bytes.begin(), bytes.end()};
}

// What this process and those that it has waited for have had of a processor, s.
double processor_seconds() {
  double seconds = 0;
  for (const int whose : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    ::getrusage(whose, &usage);
    for (const timeval& part : {usage.ru_utime, usage.ru_stime})
      seconds += static_cast<double>(part.tv_sec) + static_cast<double>(part.tv_usec) * 1e-6;
  }
  return seconds;
}

// In one of the processes; the simulation has one of its own.
std::string answer(const EvaluationPool::Preparation& prepare, const std::string& request) {
  EvaluationResult result;
  std::vector<std::string> notes;
  const auto begin = std::chrono::steady_clock::now();
  const double processor_before = processor_seconds();
  try {
    const Json tree = Json::from_cbor(request);
    const Variant variant{tree.at("assignments").get<std::vector<std::string>>(), tree.at("base")};
    const EvaluationCase one = prepare(variant, [&notes](const std::string& line) { notes.push_back(line); });
    result = evaluate(one.configuration.machine, one.input);
    if (result.done()) {
      std::vector<MetricGroup>& groups = result.metrics.groups;
      groups.insert(groups.end(), one.further.groups.begin(), one.further.groups.end());
    }
    result.configuration = json_text(to_json(one.configuration, false));
  } catch (const UserError& error) {
    result = not_measured(Status::kInvalid, error.what());
  } catch (const std::exception& error) {
    result = not_measured(Status::kFailed, error.what());
  }
  result.notes = std::move(notes);
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.processor_seconds = processor_seconds() - processor_before;
  return to_bytes(result);
}

// One round of variants through the processes.
class Round {
 public:
  Round(const std::vector<std::unique_ptr<WorkerProcess>>& processes, const std::vector<Variant>& variants,
        const EvaluationPool::Taker& take, EvaluationPool::Order order)
      : processes_(processes),
        variants_(variants),
        take_(take),
        in_order_(order == EvaluationPool::Order::kOfVariants),
        working_on_(processes.size()) {}

  std::size_t run(const std::function<bool()>& interrupted) {
    for (;;) {
      hand_out();
      if (taken_ == variants_.size()) return taken_;
      if (interrupted()) {
        give_up();
        return taken_;
      }
      collect(interrupted);
      hand_on();
    }
  }

 private:
  // A process that died takes nothing; when none is left, the variants fail without one.
  void hand_out() {
    bool any = false;
    for (std::size_t i = 0; i < processes_.size(); ++i) {
      WorkerProcess& process = *processes_[i];
      if (process.state() == State::kIdle && next_ < variants_.size() &&
          (!in_order_ || next_ < taken_ + kAheadOfEach * processes_.size())) {
        working_on_[i] = next_;
        process.ask(request_of(variants_[next_++]));
        if (process.state() == State::kDied) results_[working_on_[i]] = without_result(process.signal());
      }
      any = any || process.state() != State::kDied;
    }
    if (any) return;
    while (next_ < variants_.size()) results_[next_++] = not_measured(Status::kFailed, "no process is left");
    hand_on();
  }

  void collect(const std::function<bool()>& interrupted) {
    std::vector<pollfd> waiting;
    for (const auto& process : processes_)
      waiting.push_back({process->state() == State::kWorking ? process->descriptor() : -1, POLLIN, 0});
    if (::poll(waiting.data(), waiting.size(), WorkerProcess::kPollMilliseconds) <= 0) return;
    for (std::size_t i = 0; i < processes_.size(); ++i) {
      if (waiting[i].revents == 0) continue;
      WorkerProcess& process = *processes_[i];
      const State state = process.receive(0);
      // A signal from the terminal reaches all: this process has noted it, the others have ended.
      if (state == State::kDied && interrupted()) return;
      if (state == State::kDied) results_[working_on_[i]] = without_result(process.signal());
      if (state == State::kAnswered) results_[working_on_[i]] = evaluation_result(process.take_answer());
    }
  }

  void hand_on() {
    if (!in_order_) {
      for (auto& [variant, result] : std::exchange(results_, {})) {
        ++taken_;
        take_(variant, std::move(result));
      }
      return;
    }
    for (auto first = results_.find(taken_); first != results_.end(); first = results_.find(taken_)) {
      EvaluationResult result = std::move(first->second);
      results_.erase(first);
      take_(taken_++, std::move(result));
    }
  }

  // What is under way would answer the next round.
  void give_up() {
    for (const auto& process : processes_) {
      if (process->state() != State::kIdle) process->kill();
    }
  }

  const std::vector<std::unique_ptr<WorkerProcess>>& processes_;
  const std::vector<Variant>& variants_;
  const EvaluationPool::Taker& take_;
  const bool in_order_;
  std::vector<std::size_t> working_on_;              // by process
  std::map<std::size_t, EvaluationResult> results_;  // that wait for others before them
  std::size_t next_ = 0;
  std::size_t taken_ = 0;
};

}  // namespace

unsigned EvaluationPool::usual_processes() {
  // Those that this process may use: a task of a cluster has its share of a computer.
  cpu_set_t usable;
  const unsigned processors = ::sched_getaffinity(0, sizeof usable, &usable) == 0
                                  ? static_cast<unsigned>(CPU_COUNT(&usable))
                                  : std::thread::hardware_concurrency();
  return std::clamp(processors, 1U, kMostProcesses);
}

EvaluationPool::EvaluationPool(const Preparation& prepare, unsigned processes) {
  for (unsigned i = 0; i < processes; ++i) {
    processes_.push_back(std::make_unique<WorkerProcess>(
        [&prepare](const std::string& request) { return answer(prepare, request); }));
  }
}

std::size_t EvaluationPool::evaluate(const std::vector<Variant>& variants,
                                     const std::function<bool()>& interrupted, const Taker& take,
                                     Order order) {
  return Round(processes_, variants, take, order).run(interrupted);
}

}  // namespace parallax

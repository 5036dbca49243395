// SPDX-License-Identifier: Apache-2.0
#include "platform/evaluation/own_process.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <exception>
#include <stdexcept>
#include <systemc>

#include "platform/evaluation/worker_process.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// The last letter of an answer, which may be large: whether the rest is the result, or what was thrown.
constexpr char kDone = '+';
constexpr char kUserError = '-';
constexpr char kFailed = '!';

std::string answer(const std::function<std::string()>& work) {
  try {
    sc_core::sc_report_handler::set_actions(sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
    sc_core::sc_report_handler::set_actions(sc_core::SC_ID_NO_SC_START_ACTIVITY_, sc_core::SC_DO_NOTHING);
    std::string result = work();
    result.push_back(kDone);
    return result;
  } catch (const UserError& error) {
    return std::string(error.what()) + kUserError;
  } catch (const sc_core::sc_report& report) {
    return fmt::format("{}: {}", report.get_msg_type(), report.get_msg()) + kFailed;
  } catch (const std::exception& error) {
    return std::string(error.what()) + kFailed;
  }
}

}  // namespace

std::optional<std::string> in_own_process(const std::function<std::string()>& work,
                                          const std::function<bool()>& interrupted) {
  WorkerProcess process([&work](const std::string&) { return answer(work); });
  process.ask({});
  while (process.state() == WorkerProcess::State::kWorking) {
    if (interrupted()) return std::nullopt;
    process.receive(WorkerProcess::kPollMilliseconds);
  }
  // It has said why (CircuitWatch), as it would have here.
  if (process.state() == WorkerProcess::State::kDied && process.exit_code() != 0)
    ::_exit(process.exit_code());
  if (process.state() != WorkerProcess::State::kAnswered)
    throw std::runtime_error(fmt::format("a simulation's process ended by signal {}", process.signal()));
  std::string text = process.take_answer();
  const char kind = text.back();
  text.pop_back();
  if (kind == kUserError) throw UserError(text);
  if (kind == kFailed) throw std::runtime_error(text);
  return text;
}

}  // namespace parallax

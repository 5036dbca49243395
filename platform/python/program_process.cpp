// SPDX-License-Identifier: Apache-2.0
#include "platform/python/program_process.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "platform/commands/cli.hpp"
#include "platform/evaluation/evaluation_result.hpp"
#include "platform/python/process_start.hpp"

namespace parallax {
namespace {

using Json = nlohmann::json;

// Names of files, as they may be among what is said, are any bytes: JSON's text would not hold them, CBOR
// does.
std::string answer(const std::vector<std::string>& words) {
  prepare_process();
  std::vector<const char*> arguments{"parallax"};
  for (const std::string& word : words) arguments.push_back(word.c_str());
  std::ostringstream out, err;
  const int code = run_command_line(static_cast<int>(arguments.size()), arguments.data(), out, err);
  const std::vector<std::uint8_t> bytes =
      Json::to_cbor(Json{{"code", code}, {"out", out.str()}, {"err", err.str()}});
  return {bytes.begin(), bytes.end()};
}

}  // namespace

ProgramProcess::ProgramProcess(std::vector<std::string> words)
    : words_(std::move(words)), process_([this](const std::string&) { return answer(words_); }) {
  process_.ask({});
}

bool ProgramProcess::wait() {
  return process_.receive(WorkerProcess::kPollMilliseconds) != WorkerProcess::State::kWorking;
}

ProgramOutcome ProgramProcess::outcome() {
  if (process_.state() != WorkerProcess::State::kAnswered)
    throw std::runtime_error(without_result(process_.signal()).message);
  const Json result = Json::from_cbor(process_.take_answer());
  return {result.at("code"), result.at("out"), result.at("err")};
}

}  // namespace parallax

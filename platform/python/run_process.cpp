// SPDX-License-Identifier: Apache-2.0
#include "platform/python/run_process.hpp"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <systemc>
#include <utility>

#include "platform/commands/command_context.hpp"
#include "platform/commands/run.hpp"
#include "platform/evaluation/evaluation_result.hpp"
#include "platform/python/process_start.hpp"
#include "platform/python/run_line.hpp"
#include "platform/results/frame_results.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

using Json = nlohmann::json;

Json share(SharedPages& pages, std::int64_t index, const FrameImages& frame) {
  const auto append = [&pages](const auto& values) {
    return pages.append(values.data(), values.size() * sizeof(*values.data()));
  };
  std::vector<std::uint16_t> values;
  std::vector<Cause> causes;
  values.reserve(frame.disparities.size());
  causes.reserve(frame.disparities.size());
  for (const Disparity& disparity : frame.disparities) {
    values.push_back(disparity.value);
    causes.push_back(disparity.cause);
  }
  const std::vector<Gray> left(frame.left.begin<Gray>(), frame.left.end<Gray>());
  const std::vector<Gray> right(frame.right.begin<Gray>(), frame.right.end<Gray>());
  Json planes{{"index", index},
              {"width", frame.left.cols},
              {"height", frame.left.rows},
              {"disparities", append(values)},
              {"causes", append(causes)},
              {"left", append(left)},
              {"right", append(right)}};
  if (!frame.truth) return planes;
  planes["truth"] = append(frame.truth->disparity);
  if (!frame.truth->mask.empty()) planes["mask"] = append(frame.truth->mask);
  return planes;
}

std::vector<FramePlanes> frames_of(const Json& tree) {
  const auto maybe = [](const Json& frame, const char* name) {
    return frame.contains(name) ? std::optional<std::size_t>(frame.at(name)) : std::nullopt;
  };
  std::vector<FramePlanes> frames;
  for (const Json& frame : tree) {
    frames.push_back({frame.at("index"), frame.at("width"), frame.at("height"), frame.at("disparities"),
                      frame.at("causes"), frame.at("left"), frame.at("right"), maybe(frame, "truth"),
                      maybe(frame, "mask")});
  }
  return frames;
}

// What is said may hold names of files, which are any bytes: JSON's text would not hold them, CBOR does.
std::string packed(const Json& tree) {
  const std::vector<std::uint8_t> bytes = Json::to_cbor(tree);
  return {bytes.begin(), bytes.end()};
}

Json run_here(const RunOptions& options, const CommandLine& line) {
  std::ostringstream out, err;
  // What the run was is told by names that stand for its arrays.
  const std::vector<std::string> arrays{"--left", "left", "--right", "right"};
  CommandContext context{out, err, options.images.empty() ? line : line.with({}, arrays)};
  context.progress = false;
  const int code = run(options, context);
  return {{"code", code}, {"timing", out.str()}, {"said", err.str()}};
}

// What this process says, whatever happens.
std::string answer(const RunRequest& request, RunOptions& options, SharedPages& pages) {
  try {
    prepare_process();
    options.images = request.images;
    options.json = true;
    Json frames = Json::array();
    if (request.keep_images) {
      options.take = [&](std::int64_t index, const FrameImages& frame) {
        frames.push_back(share(pages, index, frame));
      };
    }
    Json result = run_here(options, run_line(request.words));
    result["frames"] = std::move(frames);
    return packed(result);
  } catch (const UserError& error) {
    return packed({{"refused", error.what()}});
  } catch (const sc_core::sc_report& report) {
    return packed({{"failed", fmt::format("{}: {}", report.get_msg_type(), report.get_msg())}});
  } catch (const std::bad_alloc&) {
    return packed({{"failed", "out of memory"}});
  } catch (const std::exception& error) {
    return packed({{"failed", error.what()}});
  }
}

}  // namespace

RunProcess::RunProcess(RunRequest request)
    : request_(std::move(request)),
      options_(run_options(request_.words)),
      process_([this](const std::string&) { return answer(request_, *options_, pages_); }) {
  process_.ask({});
}

bool RunProcess::wait() {
  return process_.receive(WorkerProcess::kPollMilliseconds) != WorkerProcess::State::kWorking;
}

RunOutcome RunProcess::outcome() {
  if (process_.state() != WorkerProcess::State::kAnswered)
    throw std::runtime_error(without_result(process_.signal()).message);
  const Json result = Json::from_cbor(process_.take_answer());
  if (result.contains("refused")) throw UserError(result.at("refused"));
  if (result.contains("failed")) throw std::runtime_error(result.at("failed").get<std::string>());
  return {result.at("code"), result.at("timing"), result.at("said"), frames_of(result.at("frames")),
          pages_.map()};
}

}  // namespace parallax

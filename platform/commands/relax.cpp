// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/relax.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "platform/commands/command_context.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/timing_inputs.hpp"
#include "platform/config/preset.hpp"
#include "platform/relaxation.hpp"
#include "platform/results/output_folder.hpp"
#include "platform/results/progress.hpp"
#include "platform/results/result_names.hpp"

namespace parallax {
namespace {

constexpr int kNotMeasured = 1;
constexpr int kSignalled = 128;  // as shells report a program that a signal ended

using Status = TimingResult::Status;

struct Rates {
  double frame_rate;  // frames/s
  double latency;     // ms, from exposure to the host
};

struct Gain {
  Relaxation relaxation;
  std::optional<Rates> rates;
  std::string message;  // why there are none
  double percent = 0;   // of the frame rate
};

Rates rates(const nlohmann::ordered_json& metrics) {
  return {metrics.at("performance").at("frame_rate").at("value"),
          metrics.at("latency").at("exposure_to_host_mean").at("value")};
}

class Relaxing {
 public:
  Relaxing(const RunOptions& options, CommandContext& context)
      : options_(options), context_(context), inputs_(options, [this](const std::string& line) {
          if (context_.verbosity != Verbosity::kQuiet && said_.insert(line).second) {
            context_.err << "parallax: note: " << line << '\n';
          }
        }) {}

  int run() {
    const TimingResult base = measure({});
    if (interruption_.requested()) return interrupted();
    if (base.status != Status::kDone) {
      context_.err << "parallax: error: " << base.message << (base.message.back() == '\n' ? "" : "\n");
      return base.status == Status::kInvalid ? 2 : kNotMeasured;
    }
    base_ = rates(base.metrics);
    const MachineConfig config = load_configuration(options_.configuration, preset_folders()).machine;
    const std::vector<Relaxation> all = relaxations(config, base.metrics);
    {
      Progress progress(context_.err, context_.verbosity != Verbosity::kQuiet && standard_error_is_terminal(),
                        "limits", static_cast<std::int64_t>(all.size()));
      for (const Relaxation& relaxation : all) {
        add(relaxation, measure(relaxation.assignments));
        if (interruption_.requested()) return interrupted();
        progress.advance();
      }
    }
    std::stable_sort(gains_.begin(), gains_.end(),
                     [](const Gain& a, const Gain& b) { return a.percent > b.percent; });
    report();
    return 0;
  }

 private:
  TimingResult measure(const std::vector<std::string>& assignments) {
    ConfigurationRequest request = options_.configuration;
    request.assignments.insert(request.assignments.end(), assignments.begin(), assignments.end());
    const MachineConfig config = load_configuration(request, preset_folders()).machine;
    TimingInput input = inputs_.prepare(config);
    input.command = context_.command_line.text();
    return TimingEvaluator(std::move(input), [this] { return interruption_.requested(); }).evaluate(config);
  }

  void add(const Relaxation& relaxation, const TimingResult& result) {
    Gain gain{relaxation, std::nullopt, result.message.substr(0, result.message.find('\n'))};
    if (result.status == Status::kDone) {
      gain.rates = rates(result.metrics);
      // To a thousandth of a percent: what is less are the roundings of a period.
      gain.percent = std::round(1e5 * (gain.rates->frame_rate / base_.frame_rate - 1)) / 1e3 + 0.0;
    }
    gains_.push_back(std::move(gain));
  }

  // Gains below this are those of the steady state's own rounding.
  const Gain* limit() const {
    constexpr double kNoise = 0.1;
    return gains_.empty() || gains_.front().percent < kNoise ? nullptr : &gains_.front();
  }

  void report() {
    const nlohmann::ordered_json tree = as_json();
    if (!options_.out.empty()) {
      OutputFolder folder(options_.out);
      folder.replace(is_result_name);
      folder.write("relaxations.json", tree.dump(2) + "\n");
      folder.publish();
    }
    if (options_.json) {
      context_.out << tree.dump(2) << '\n';
    } else if (context_.verbosity != Verbosity::kQuiet) {
      context_.out << text();
    }
  }

  std::string text() const {
    std::string lines =
        fmt::format("{:20}{:>9}  {:>15}  {:>8}\n{:20}{:>9.2f} fps {:>11.3f} ms\n", "limit taken away",
                    "frame rate", "latency", "gain", "none", base_.frame_rate, base_.latency);
    for (const Gain& gain : gains_) {
      lines += gain.rates ? fmt::format("{:20}{:>9.2f} fps {:>11.3f} ms  {:>+6.2f} %  {}\n",
                                        gain.relaxation.name, gain.rates->frame_rate, gain.rates->latency,
                                        gain.percent, gain.relaxation.meaning)
                          : fmt::format("{:20}{}\n", gain.relaxation.name, gain.message);
    }
    const Gain* const found = limit();
    return lines + fmt::format("limit               {}\n",
                               found == nullptr ? "none of them alone" : found->relaxation.name);
  }

  nlohmann::ordered_json as_json() const {
    const auto metric = [](double value, const char* unit, const char* description) {
      return nlohmann::ordered_json{{"value", value}, {"unit", unit}, {"description", description}};
    };
    const auto add = [&](nlohmann::ordered_json& entry, const Rates& rates) {
      entry["frame_rate"] =
          metric(rates.frame_rate, "frames/s", "Steady-state rate at which the host receives frames.");
      entry["latency"] =
          metric(rates.latency, "ms",
                 "From the end of exposure to the frame's last bit at the host, mean of the steady state.");
    };
    nlohmann::ordered_json tree;
    const Gain* const found = limit();
    tree["limit"] = found == nullptr ? "none" : found->relaxation.name;
    add(tree["base"], base_);
    for (const Gain& gain : gains_) {
      nlohmann::ordered_json entry{{"name", gain.relaxation.name},
                                   {"meaning", gain.relaxation.meaning},
                                   {"set", gain.relaxation.assignments}};
      if (gain.rates) {
        add(entry, *gain.rates);
        entry["gain"] = metric(gain.percent, "%", "Of the frame rate, with this limit alone taken away.");
      } else {
        entry["message"] = gain.message;
      }
      tree["relaxations"].push_back(entry);
    }
    return tree;
  }

  int interrupted() {
    context_.err << fmt::format("parallax: interrupted after {} limits\n", gains_.size());
    return kSignalled + interruption_.signal();
  }

  const RunOptions& options_;
  CommandContext& context_;
  const Interruption interruption_;
  std::set<std::string> said_;  // notes, once each
  TimingInputs inputs_;
  Rates base_{};
  std::vector<Gain> gains_;
};

}  // namespace

int relax(const RunOptions& options, CommandContext& context) { return Relaxing(options, context).run(); }

}  // namespace parallax

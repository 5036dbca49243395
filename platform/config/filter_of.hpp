// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "platform/config/disparity_filter.hpp"
#include "platform/config/machine_config.hpp"
#include "platform/config/schema.hpp"

namespace parallax {

/// The configuration of a filter is kept by the filter itself.
template <class Config>
struct KeptConfig {
  Config function{};
  StageTiming time{};

  Config& config(MachineConfig&) { return function; }
  const Config& config(const MachineConfig&) const { return function; }
  StageTiming& timing(MachineConfig&) { return time; }
  const StageTiming& timing(const MachineConfig&) const { return time; }
};

/// It is kept by the machine's configuration, since its run-time registers set it.
template <class Config>
struct SharedConfig {
  Config MachineConfig::*function;
  StageTiming PipelineTiming::*time;

  Config& config(MachineConfig& machine) { return machine.*function; }
  const Config& config(const MachineConfig& machine) const { return machine.*function; }
  StageTiming& timing(MachineConfig& machine) { return machine.timing.*time; }
  const StageTiming& timing(const MachineConfig& machine) const { return machine.timing.*time; }
};

/// Where the filter of a machine that has the configuration `Kept` keeps it. std::logic_error when there is
/// no such filter.
template <class Kept>
Kept& kept_part(const MachineConfig& machine) {
  for (const auto& filter : machine.filters.all()) {
    if (auto* const kept = dynamic_cast<Kept*>(filter.get())) return *kept;
  }
  throw std::logic_error("the machine has no filter with this configuration");
}

/// A filter by its kernel (DisparityFilterStage), its configuration and where that is kept. There is a
/// function `describe(Schema&, Config&)`, and the configuration has a member `validate()`.
template <class Kernel, class Config, class Kept>
class FilterOf final : public DisparityFilter, public Kept {
 public:
  using Enabled = bool (*)(const Config& config);

  FilterOf(std::string name, std::string stream, Kept kept, Enabled is_on)
      : DisparityFilter(std::move(name), std::move(stream)), Kept(std::move(kept)), enabled_(is_on) {}

  std::unique_ptr<DisparityFilter> clone() const override { return std::make_unique<FilterOf>(*this); }
  void describe_function(Schema& schema, MachineConfig& machine) override {
    describe(schema, Kept::config(machine));
  }
  StageTiming& timing(MachineConfig& machine) override { return Kept::timing(machine); }
  void validate(const MachineConfig& machine) const override { Kept::config(machine).validate(); }
  bool enabled(const MachineConfig& machine) const override { return enabled_(Kept::config(machine)); }
  FilterNeeds needs(const MachineConfig& machine, int width, int height, int at_once) const override {
    const Kernel kernel(Kept::config(machine), width, height);
    return {kernel.look_ahead_rows(), kernel.look_ahead_pixels(), Kept::timing(machine).latency,
            storage_of(kernel, at_once)};
  }
  Made make(const std::string& name, const MachineConfig& machine,
            const StageContext& context) const override {
    auto stage = std::make_unique<DisparityFilterStage<Kernel, Config>>(name.c_str(), Kept::config(machine),
                                                                        Kept::timing(machine), context);
    Follow follow = [followed = stage.get()](const MachineConfig* next) {
      followed->configure(next != nullptr ? std::optional<Config>(kept_part<Kept>(*next).config(*next))
                                          : std::nullopt);
    };
    return {std::move(stage), std::move(follow)};
  }

 private:
  Enabled enabled_;
};

/// A filter that keeps its configuration itself and is always on; its stream is `<name>_out`.
template <class Kernel, class Config>
std::unique_ptr<DisparityFilter> filter(const std::string& name, const Config& config = {},
                                        const StageTiming& timing = {}) {
  return std::make_unique<FilterOf<Kernel, Config, KeptConfig<Config>>>(
      name, name + "_out", KeptConfig<Config>{config, timing}, [](const Config&) { return true; });
}

/// A filter whose configuration lies in the machine's.
template <class Kernel, class Config>
std::unique_ptr<DisparityFilter> shared_filter(const std::string& name, const std::string& stream,
                                               const SharedConfig<Config>& shared,
                                               bool (*enabled)(const Config& config)) {
  return std::make_unique<FilterOf<Kernel, Config, SharedConfig<Config>>>(name, stream, shared, enabled);
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "modules/disparity_filter_stage.hpp"

namespace parallax {

class Schema;
struct MachineConfig;

/// What a filter's circuit holds, without its stage being made.
struct FilterNeeds {
  int look_ahead_rows = 0;
  int look_ahead_pixels = 0;
  std::uint32_t latency = 0;  ///< cycles
  Bits storage{0};
};

/// A filter of the disparity map, as the machine can hold it: its keys and its stage (disparity_filters.hpp
/// is the list of them, filter_of.hpp the way to make one).
class DisparityFilter {
 public:
  /// Tells a stage of the configuration of the next frame, or (nullptr) that it is as before.
  using Follow = std::function<void(const MachineConfig* next)>;
  struct Made {
    std::unique_ptr<FilterStage> stage;
    Follow follow;
  };

  /// `name`: of the stage, and of its section of keys. `stream`: of the stream that it writes.
  DisparityFilter(std::string name, std::string stream)
      : name_(std::move(name)), stream_(std::move(stream)) {}
  virtual ~DisparityFilter() = default;
  virtual std::unique_ptr<DisparityFilter> clone() const = 0;

  const std::string& name() const { return name_; }
  const std::string& stream() const { return stream_; }

  // `machine` is the configuration that this filter is a part of.

  /// Declares the keys of its function.
  virtual void describe_function(Schema& schema, MachineConfig& machine) = 0;
  virtual StageTiming& timing(MachineConfig& machine) = 0;
  /// Throws UserError when values are fine alone but not together.
  virtual void validate(const MachineConfig& machine) const = 0;
  /// False: disparities pass as they are.
  virtual bool enabled(const MachineConfig& machine) const = 0;
  /// For images, or tiles of them, of this size, of which `at_once` pixels of a row pass together.
  virtual FilterNeeds needs(const MachineConfig& machine, int width, int height, int at_once) const = 0;
  virtual Made make(const std::string& name, const MachineConfig& machine,
                    const StageContext& context) const = 0;

 protected:
  DisparityFilter(const DisparityFilter&) = default;
  DisparityFilter& operator=(const DisparityFilter&) = default;

 private:
  std::string name_;
  std::string stream_;
};

/// Filters in the order in which the disparities pass them; copies are of their own.
class DisparityFilters {
 public:
  DisparityFilters() = default;
  DisparityFilters(const DisparityFilters& other);
  DisparityFilters(DisparityFilters&&) = default;
  DisparityFilters& operator=(DisparityFilters other) {
    filters_.swap(other.filters_);
    return *this;
  }

  /// Appends one.
  DisparityFilters& add(std::unique_ptr<DisparityFilter> filter);
  const std::vector<std::unique_ptr<DisparityFilter>>& all() const { return filters_; }
  /// Names of the streams that they write.
  std::vector<std::string> streams() const;

 private:
  std::vector<std::unique_ptr<DisparityFilter>> filters_;
};

}  // namespace parallax

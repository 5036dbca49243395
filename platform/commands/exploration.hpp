// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "platform/commands/exploration_inputs.hpp"
#include "platform/explore/axis_effect.hpp"
#include "platform/explore/exploration_outcome.hpp"
#include "platform/explore/exploration_spec.hpp"
#include "platform/explore/explorer.hpp"
#include "platform/explore/point_share.hpp"
#include "platform/explore/result_store.hpp"
#include "platform/results/output_folder.hpp"

namespace parallax {

/// What the points of an exploration came to.
struct ExplorationReport {
  ExplorationCounts counts;
  ExplorationOutcome outcome;
  std::vector<AxisEffect> effects;  ///< of one that varies one at a time
};

/// What of an exploration is watched while it runs.
struct ExplorationWatch {
  std::function<bool()> interrupted;  ///< asked some ten times a second
  Explorer::Advance advance;
};

/// An exploration with its folder: results.db, points.csv, front.csv, sensitivity.csv. Who prints or plots it
/// asks for the rest.
class Exploration {
 public:
  /// `share`: the points that are evaluated here. Throws UserError: the specification is wrong, no point
  /// fulfils its conditions or has a possible input, or a search is to be shared.
  Exploration(const std::filesystem::path& spec, const std::filesystem::path& out, PointShare share = {});

  const ExplorationSpec& spec() const { return spec_; }
  /// What varies, and the numbers that are shown, one column each.
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<std::string>& metrics() const { return metrics_; }
  /// How many points it has, or its share; a search, before it has come to its end: at most.
  std::size_t size() const { return size_; }
  /// Of a search: from how many machines it chooses, conditions aside.
  std::optional<double> machines() const;

  /// Evaluates the points that the folder does not know, and writes its tables. Throws UserError.
  ExplorationReport run(const ExplorationWatch& watch);
  /// Takes over what these folders of the same exploration have, and writes its tables; evaluates nothing.
  /// Throws UserError: one of them is none.
  ExplorationReport merge(const std::vector<std::filesystem::path>& folders);
  /// What these found; after them.
  ResultStore& store() { return *store_; }

 private:
  void open(std::vector<NamedInput> further_inputs);
  ExplorationReport look(EvaluationPool* pool, const ExplorationWatch& watch);
  [[noreturn]] void fail(const std::string& line) const;
  std::size_t count() const;
  void check_metrics() const;
  void check_inputs();
  ExplorationSpec inputs_only() const;
  FolderPlan plan() const;
  void write_tables(OutputFolder& folder, const ExplorationReport& report);

  const std::filesystem::path file_;
  const std::filesystem::path out_;
  const PointShare share_;
  const ExplorationSpec spec_;
  const std::vector<std::string> names_;
  std::vector<std::string> metrics_;
  ExplorationInputs inputs_;
  std::size_t size_ = 0;
  std::unique_ptr<OutputFolder> folder_;
  std::unique_ptr<ResultStore> store_;
};

}  // namespace parallax

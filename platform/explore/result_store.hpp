// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace parallax {

/// A number or a word of a run; nothing where a machine has no such number.
using StoredValue = std::variant<std::monostate, double, std::string>;

/// What became of a machine on an input.
struct StoredResult {
  std::string identity;       ///< the same for the same machine, input and program (result_identity)
  std::string configuration;  ///< hash of it (configuration_hash)
  std::string input;          ///< as options of `parallax run`
  std::string status;         ///< "done", "invalid", "stuck", "failed"
  std::string message;        ///< why not
  std::string command;        ///< that runs it alone
  std::string limit;          ///< part that limits; empty unless done
  std::int64_t schema = 0;    ///< of the metrics (kResultSchema)
  std::string revision;       ///< of the program
  std::uint64_t seed = 0;     ///< of the built-in scene
  std::string host;           ///< name of the computer
  double wall_seconds = 0;
  double processor_seconds = 0;
  std::map<std::string, StoredValue> metrics;  ///< by path
};

/// A point of an exploration and its result.
struct StoredPoint {
  std::size_t number = 0;
  std::vector<std::string> values;  ///< of what varies
  StoredResult result;
};

/// A result that is there.
struct KnownResult {
  std::int64_t id = 0;
  bool done = false;
};

/// DIR/results.db: a SQLite database of explorations and results, which its page documents. What was added is
/// there when the call returns, and survives an end of the program at any moment. One writes at a time, which
/// is for the caller to see to; others may read meanwhile.
class ResultStore {
 public:
  static constexpr int kVersion = 1;  ///< of the tables

  /// Opens it, or makes one. Throws UserError: it is no such database, damaged, or of another version.
  explicit ResultStore(const std::filesystem::path& file);
  ~ResultStore();

  /// What follows belongs to the exploration of this text: begun before, or begun now. `names`: what varies.
  void begin(const std::string& spec, const std::vector<std::string>& names);
  /// The texts of all explorations that are there.
  std::vector<std::string> specifications();
  /// The exploration has all its points.
  void end();

  /// A result that has these metrics: who wants others has to evaluate anew, and so has one who finds what
  /// failed on this computer.
  std::optional<KnownResult> find(const std::string& identity, const std::vector<std::string>& metrics);
  /// Adds a result, in the place of an older one of its identity, and the point that asked for it. Throws
  /// UserError where the file has been removed or replaced meanwhile.
  void add(const StoredPoint& point);
  /// Adds a point whose result is known.
  void add(std::size_t number, const std::vector<std::string>& values, std::int64_t result);
  /// Whether the exploration has this point, with this result.
  bool has(std::size_t number, std::int64_t result);
  /// A point of the exploration, if it is there, with these metrics.
  std::optional<StoredPoint> point(std::size_t number, const std::vector<std::string>& metrics);
  /// Adds all that another such database has, of this exploration and of others; what is there stays, but for
  /// failures, of which the other may have results. All of it or nothing. Throws UserError: it is no such
  /// database, or has nothing of this exploration.
  void take_from(const std::filesystem::path& other);
  /// Says what a metric is measured in.
  void describe(const std::string& metric, const std::string& unit, const std::string& meaning);
  std::string unit(const std::string& metric);

  /// Hands out the points of the exploration, in the order of their numbers, with these metrics.
  void each_point(const std::vector<std::string>& metrics,
                  const std::function<void(const StoredPoint&)>& take);

 private:
  struct Database;
  std::unique_ptr<Database> database_;
};

}  // namespace parallax

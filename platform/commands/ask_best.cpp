// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/ask_best.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "platform/commands/case_estimate.hpp"
#include "platform/commands/command_context.hpp"
#include "platform/commands/exit_codes.hpp"
#include "platform/commands/exploration_metrics.hpp"
#include "platform/commands/interruption.hpp"
#include "platform/commands/notes.hpp"
#include "platform/commands/question.hpp"
#include "platform/commands/vary_axes.hpp"
#include "platform/commands/vary_inputs.hpp"
#include "platform/evaluation/evaluation_pool.hpp"
#include "platform/explore/judgement.hpp"
#include "platform/results/progress.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

constexpr std::size_t kMachinesShown = 10;

// The machine of a point, as it is told.
struct Row {
  std::size_t point = 0;
  std::string status;
  std::string said;                // its numbers, or why there are none
  std::vector<std::string> cells;  // the same, for a table
  nlohmann::ordered_json numbers;  // by name
  std::optional<double> value;     // of the number that is asked for
  bool holds = false;
  double miss = 0;  // the largest of the bounds, relative
};

class BestQuestion {
 public:
  BestQuestion(const AskOptions& options, CommandContext& context)
      : options_(options),
        context_(context),
        number_(options.subjects.front()),
        most_(options.which == "most"),
        grid_(options.run),
        axis_(axis_of_number()),
        holds_(read_holds(options)),
        names_(names()),
        estimate_(options.device, names_),
        inputs_(options.run, grid_) {
    inputs_.open([](const std::string&) {});
  }

  int run() {
    const Interruption interruption;
    const bool whole = evaluate(interruption);
    std::stable_sort(rows_.begin(), rows_.end(), [this](const Row& a, const Row& b) { return before(a, b); });
    if (!whole)
      return interrupted_after(fmt::format("{} of {} runs", rows_.size(), grid_.size()), context_,
                               interruption);
    if (options_.run.json) {
      context_.out << json_text(tree(), 2) << '\n';
    } else if (context_.verbosity != Verbosity::kQuiet) {
      context_.out << text();
    }
    return found() ? 0 : kNotAsExpected;
  }

 private:
  // Which of the axes the number is, if it is one.
  std::optional<std::size_t> axis_of_number() const {
    for (std::size_t i = 0; i < grid_.axes().size(); ++i) {
      if (grid_.axes()[i].name == number_) return i;
    }
    require_number(number_, options_.device, fmt::format("ask {}", options_.which));
    return std::nullopt;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all = names_of(holds_);
    if (!axis_ && std::find(all.begin(), all.end(), number_) == all.end()) all.insert(all.begin(), number_);
    return all;
  }

  bool evaluate(const Interruption& interruption) {
    EvaluationPool pool([this](const Variant& variant, const NoticeSink& notice) {
      EvaluationCase one = inputs_.prepare(variant.base, {}, notice);
      one.input.command = command(variant.base);
      estimate_.add_to(one);
      return one;
    });
    std::vector<Variant> variants;
    for (std::size_t i = 0; i < grid_.size(); ++i) variants.push_back({{}, i});
    Notes notes(context_);
    Progress progress(context_.err, shows_progress(context_), "runs", static_cast<std::int64_t>(grid_.size()),
                      notes.sink());
    const std::size_t taken = pool.evaluate(
        variants, [&] { return interruption.requested(); },
        [&](std::size_t point, const EvaluationResult& result) {
          for (const std::string& note : result.notes) notes(note);
          rows_.push_back(row_of(point, result));
          progress.advance();
        });
    return taken == grid_.size();
  }

  Row row_of(std::size_t point, const EvaluationResult& result) const {
    Row row;
    row.point = point;
    row.status = name(result.status);
    row.said = said_of(result, names_);
    row.cells = cells_of(result, names_);
    add_numbers(row.numbers, result, names_);
    if (!result.done()) {
      row.miss = std::numeric_limits<double>::infinity();
      return row;
    }
    row.value = axis_ ? axis_value(point) : number_of(result, number_);
    for (const Constraint& hold : holds_)
      row.miss = std::max(row.miss, miss(hold, number_of(result, hold.metric)));
    row.holds = row.miss == 0 && row.value.has_value();
    return row;
  }

  std::optional<double> axis_value(std::size_t point) const {
    const std::string& text = grid_.value(point, *axis_);
    double number = 0;
    const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || last != text.data() + text.size())
      throw UserError(fmt::format("ask {} {}: '{}' is no number", options_.which, number_, excerpt(text)));
    return number;
  }

  // Those that hold first, the best of them at the beginning; then the nearest.
  bool before(const Row& a, const Row& b) const {
    if (a.holds != b.holds) return a.holds;
    if (!a.holds) return a.miss < b.miss;
    return most_ ? *a.value > *b.value : *a.value < *b.value;
  }

  bool found() const { return !rows_.empty() && rows_.front().holds; }

  std::string machine(std::size_t point) const {
    std::string text;
    for (std::size_t i = 0; i < grid_.axes().size(); ++i)
      text += fmt::format("{}{} = {}", i == 0 ? "" : ", ", grid_.axes()[i].name, grid_.value(point, i));
    return text;
  }

  std::string answer_text() const {
    const Row& best = rows_.front();
    if (found()) {
      const auto as_good = std::count_if(rows_.begin() + 1, rows_.end(), [&best](const Row& row) {
        return row.holds && row.value == best.value;
      });
      return fmt::format("{}: {}{}", machine(best.point), said_of_row(best),
                         as_good == 0 ? "" : fmt::format("; {} more as good", as_good));
    }
    const std::string bounds = holds_.empty() ? number_ : bounds_text(holds_);
    return fmt::format("none has {}; the nearest, {}: {}", bounds, machine(best.point), said_of_row(best));
  }

  std::string said_of_row(const Row& row) const {
    return names_.size() == 1 && row.status == "done" ? names_.front() + " " + row.said : row.said;
  }

  std::string text() const {
    const auto held = std::count_if(rows_.begin(), rows_.end(), [](const Row& row) { return row.holds; });
    std::string lines = fmt::format("answer              {}\nruns                {}{}\n", answer_text(),
                                    rows_.size(), holds_.empty() ? "" : fmt::format("; {} hold", held));
    std::vector<std::vector<std::string>> table(1);
    for (const VaryAxis& axis : grid_.axes()) table.front().push_back(axis.name);
    table.front().insert(table.front().end(), names_.begin(), names_.end());
    table.front().emplace_back("what limits");
    for (std::size_t i = 0; i < std::min(rows_.size(), kMachinesShown); ++i) {
      const Row& row = rows_[i];
      table.emplace_back();
      for (std::size_t axis = 0; axis < grid_.axes().size(); ++axis)
        table.back().push_back(grid_.value(row.point, axis));
      table.back().insert(table.back().end(), row.cells.begin(), row.cells.end());
    }
    lines += table_text(table);
    if (rows_.size() > kMachinesShown) lines += fmt::format("... {} more\n", rows_.size() - kMachinesShown);
    return lines;
  }

  nlohmann::ordered_json tree() const {
    using Json = nlohmann::ordered_json;
    Json runs = Json::array();
    for (const Row& row : rows_) {
      Json run{{"values", Json::object()}, {"status", row.status}, {"holds", row.holds}};
      for (std::size_t i = 0; i < grid_.axes().size(); ++i)
        run["values"][grid_.axes()[i].name] = grid_.value(row.point, i);
      if (!row.numbers.is_null()) run.update(row.numbers);
      if (row.status == "done") run["limit"] = row.cells.back();
      if (row.status != "done") run["message"] = row.said;
      run["command"] = command(row.point);
      runs.push_back(std::move(run));
    }
    return {{"number", number_},
            {"answer", found() ? runs.front().at("values") : Json()},
            {"sentence", answer_text()},
            {"units", units_of(names_)},
            {"runs", runs}};
  }

  std::string command(std::size_t point) const {
    return run_command(context_.command_line, options_, grid_.words(point));
  }

  const AskOptions& options_;
  CommandContext& context_;
  const std::string& number_;
  const bool most_;  // of the number, not the least
  const VaryGrid grid_;
  const std::optional<std::size_t> axis_;  // that is the number
  const std::vector<Constraint> holds_;
  const std::vector<std::string> names_;  // of the numbers that are shown
  const CaseEstimate estimate_;
  VaryInputs inputs_;
  std::vector<Row> rows_;
};

}  // namespace

int ask_best(const AskOptions& options, CommandContext& context) {
  return BestQuestion(options, context).run();
}

}  // namespace parallax

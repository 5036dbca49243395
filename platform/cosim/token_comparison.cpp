// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/token_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/cosim/difference_pattern.hpp"
#include "platform/cosim/other_stream.hpp"

namespace parallax {
namespace {

constexpr std::size_t kLongestDecimal = 16;  // bits; what is wider is a code

std::string value_text(const TokenWords& words, std::uint64_t token, const TokenField& field) {
  if (words.unknown(token, field)) return "x";
  if (field.width > kLongestDecimal && !field.is_signed)
    return fmt::format("0x{:x}", words.raw(token, field));
  return std::to_string(words.value(token, field));
}

std::string plural(std::uint64_t number, const char* what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

struct Counted {
  const char* one;
  const char* several;
};

// "rows 3 to 20 (7 of them), most in 5: 12"
std::string spread(const Counted& what, const std::map<std::int64_t, std::uint64_t>& counts) {
  const auto most = std::max_element(counts.begin(), counts.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  if (counts.size() == 1) return fmt::format("{} {}", what.one, most->first);
  return fmt::format("{} {} to {} ({} of them), most in {}: {}", what.several, counts.begin()->first,
                     counts.rbegin()->first, counts.size(), most->first, most->second);
}

// How often each number came, for millions of them.
class Tally {
 public:
  void add(std::int64_t number) {
    if (number < 0) return;
    const auto index = static_cast<std::size_t>(number);
    if (index >= counts_.size()) counts_.resize(index + 1);
    ++counts_[index];
  }
  std::map<std::int64_t, std::uint64_t> counts() const {
    std::map<std::int64_t, std::uint64_t> out;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      if (counts_[i] > 0) out[static_cast<std::int64_t>(i)] = counts_[i];
    }
    return out;
  }

 private:
  std::vector<std::uint64_t> counts_;
};

nlohmann::ordered_json histogram(const std::map<std::int64_t, std::uint64_t>& counts) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (const auto& [index, count] : counts) out[std::to_string(index)] = count;
  return out;
}

}  // namespace

void for_each_difference(const VectorStream& stream, const TokenWords& expected, const TokenWords& got,
                         const std::function<void(std::uint64_t token, std::size_t field)>& take) {
  const std::vector<TokenField>& fields = stream.shape.format.all();
  const std::uint64_t tokens = std::min(expected.size(), got.size());
  for (std::uint64_t token = 0; token < tokens; ++token) {
    if (expected.same(token, got, token)) continue;
    for (std::size_t field = 0; field < fields.size(); ++field) {
      if (got.unknown(token, fields[field]) ||
          expected.raw(token, fields[field]) != got.raw(token, fields[field]))
        take(token, field);
    }
  }
}

TokenComparison compare_tokens(const VectorManifest& manifest, const VectorStream& stream,
                               const TokenWords& expected, const Dump& got, const ModelTokens& model) {
  const std::vector<TokenField>& fields = stream.shape.format.all();
  TokenComparison out;
  out.manifest = &manifest;
  out.stream = &stream;
  out.expected_tokens = expected.size();
  out.got_tokens = got.words.size();
  out.compared_tokens = std::min(out.expected_tokens, out.got_tokens);
  Tally rows, columns, disparities, in_field;
  std::uint64_t last = ~std::uint64_t{0};
  for_each_difference(stream, expected, got.words, [&](std::uint64_t token, std::size_t field) {
    const ValuePlace place = manifest.place(stream, token, field);
    if (!out.first) {
      out.first = FirstDifference{token,
                                  field,
                                  place,
                                  value_text(expected, token, fields[field]),
                                  value_text(got.words, token, fields[field]),
                                  std::nullopt};
      if (token < got.cycles.size()) out.first->cycle = got.cycles[token];
    }
    ++out.different_values;
    rows.add(place.row);
    columns.add(place.column);
    disparities.add(place.disparity);
    in_field.add(static_cast<std::int64_t>(field));
    if (token == last) return;
    last = token;
    ++out.different_tokens;
    if (got.words.unknown(token)) ++out.unknown_tokens;
  });
  out.rows = rows.counts();
  out.columns = columns.counts();
  out.disparities = disparities.counts();
  for (const auto& [field, count] : in_field.counts())
    out.fields[fields[static_cast<std::size_t>(field)].name] = count;
  if (!out.equal()) out.patterns = find_patterns(out, expected, got.words);
  if (const auto other = find_other_stream(out, got.words, model)) say_first(out, *other);
  out.effect = stage_effect(manifest, stream, expected, model);
  return out;
}

void say_first(TokenComparison& comparison, const DifferencePattern& pattern) {
  std::vector<DifferencePattern>& all = comparison.patterns;
  if (!all.empty() && all.front().name == "none") all.clear();
  all.insert(all.begin(), pattern);
}

std::string text(const TokenComparison& comparison) {
  const VectorStream& stream = *comparison.stream;
  if (comparison.equal())
    return fmt::format("{}: equal, {}\n", stream.name, plural(comparison.expected_tokens, "token")) +
           text(comparison.effect);
  std::string out;
  if (comparison.expected_tokens != comparison.got_tokens) {
    const bool few = comparison.got_tokens < comparison.expected_tokens;
    const std::uint64_t number = few ? comparison.expected_tokens - comparison.got_tokens
                                     : comparison.got_tokens - comparison.expected_tokens;
    out +=
        fmt::format("{}: {} in place of {}, {} too {}\n", stream.name, plural(comparison.got_tokens, "token"),
                    comparison.expected_tokens, number, few ? "few" : "many");
  }
  if (comparison.compared_tokens > 0) {
    out += fmt::format("{}: {} of {} tokens differ", stream.name, comparison.different_tokens,
                       comparison.compared_tokens);
    if (comparison.unknown_tokens > 0)
      out += fmt::format(", {} of them with unknown bits", comparison.unknown_tokens);
    out += "\n";
  }
  if (const auto& first = comparison.first) {
    out += fmt::format("first difference    frame {}", first->place.frame);
    if (comparison.manifest->tile_begins.size() > 1 && first->place.tile >= 0)
      out += fmt::format(", tile {}", first->place.tile);
    if (first->place.row >= 0)
      out += fmt::format(", row {}, column {}", first->place.row, first->place.column);
    if (first->place.disparity >= 0) out += fmt::format(", disparity {}", first->place.disparity);
    out += fmt::format(", {} of token {}", stream.shape.format.all()[first->field].name, first->token);
    if (first->cycle) out += fmt::format(", cycle {}", *first->cycle);
    out += fmt::format(": expected {}, got {}\n", first->expected, first->got);
  }
  for (const DifferencePattern& pattern : comparison.patterns)
    out += fmt::format("{:20}{}\n", &pattern == &comparison.patterns.front() ? "pattern" : "", pattern.text);
  const char* head = "where";
  const auto say_where = [&](const Counted& what, const std::map<std::int64_t, std::uint64_t>& counts) {
    if (counts.empty()) return;
    out += fmt::format("{:20}{}\n", head, spread(what, counts));
    head = "";
  };
  say_where({"row", "rows"}, comparison.rows);
  say_where({"column", "columns"}, comparison.columns);
  say_where({"disparity", "disparities"}, comparison.disparities);
  return out;
}

nlohmann::ordered_json to_json(const TokenComparison& comparison) {
  const VectorStream& stream = *comparison.stream;
  nlohmann::ordered_json out{{"stage", comparison.manifest->stage},
                             {"stream", stream.name},
                             {"equal", comparison.equal()},
                             {"expected_tokens", comparison.expected_tokens},
                             {"got_tokens", comparison.got_tokens},
                             {"compared_tokens", comparison.compared_tokens},
                             {"different_tokens", comparison.different_tokens},
                             {"unknown_tokens", comparison.unknown_tokens},
                             {"different_values", comparison.different_values}};
  add_to(out, comparison.effect);
  if (const auto& first = comparison.first) {
    nlohmann::ordered_json place{{"token", first->token}, {"frame", first->place.frame}};
    const auto add = [&place](const char* name, std::int64_t value) {
      if (value >= 0) place[name] = value;
    };
    add("tile", first->place.tile);
    add("row", first->place.row);
    add("column", first->place.column);
    add("disparity", first->place.disparity);
    place["field"] = stream.shape.format.all()[first->field].name;
    place["expected"] = first->expected;
    place["got"] = first->got;
    if (first->cycle) place["cycle"] = *first->cycle;
    out["first_difference"] = place;
  }
  if (!comparison.patterns.empty()) out["pattern"] = comparison.patterns.front().name;
  out["patterns"] = nlohmann::ordered_json::array();
  for (const DifferencePattern& pattern : comparison.patterns) {
    nlohmann::ordered_json one{{"name", pattern.name}, {"text", pattern.text}};
    if (pattern.frame) one["frame"] = *pattern.frame;
    out["patterns"].push_back(std::move(one));
  }
  out["rows"] = histogram(comparison.rows);
  out["columns"] = histogram(comparison.columns);
  out["disparities"] = histogram(comparison.disparities);
  out["fields"] = comparison.fields;
  return out;
}

}  // namespace parallax

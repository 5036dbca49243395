// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/token_dates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "platform/input/text_file.hpp"
#include "tlm/error.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

std::string range_text(std::int64_t least, std::int64_t most) {
  return least == most ? grouped(std::to_string(most))
                       : grouped(std::to_string(least)) + " to " + grouped(std::to_string(most));
}

}  // namespace

std::string cycles_text(std::int64_t cycles) {
  return grouped(std::to_string(cycles)) + (cycles == 1 ? " cycle" : " cycles");
}

std::vector<std::int64_t> read_dates(const std::string& path, const VectorStream& stream) {
  const std::string text = read_text_file(path);
  std::vector<std::int64_t> dates;
  const char* at = text.data();
  for (const char* const end = at + text.size(); at != end;) {
    std::int64_t date = 0;
    const auto [stop, error] = std::from_chars(at, end, date);
    if (error != std::errc() || stop == end || *stop != '\n')
      throw UserError(fmt::format("{}, line {}: no whole number", path, dates.size() + 1));
    dates.push_back(date);
    at = stop + 1;
  }
  if (dates.size() != stream.tokens) {
    throw UserError(fmt::format("{}: {} dates of {} tokens; run parallax vectors --dates again", path,
                                dates.size(), stream.tokens));
  }
  return dates;
}

TokenDates::TokenDates(const VectorStream& stream, const std::vector<std::int64_t>& got,
                       const std::vector<std::int64_t>& expected) {
  const std::size_t both = std::min(got.size(), expected.size());
  known_ = both > 0;
  for (std::size_t token = 0; token < both; ++token) {
    const std::int64_t later = got[token] - expected[token];
    if (token == 0 || later > latest_) {
      latest_ = later;
      latest_token_ = token;
    }
  }
  const auto add = [&](std::vector<Pair>& pairs, std::size_t size, std::size_t end) {
    if (size == 0) return;
    for (std::size_t last = size - 1; last < end; last += size) {
      const std::size_t first = last + 1 - size;
      pairs.push_back({got[last] - got[first] + 1, expected[last] - expected[first] + 1});
    }
  };
  add(frames_, stream.frame_tokens, both);
  if (!frames_.empty()) add(rows_, stream.shape.row_tokens, stream.frame_tokens);
}

std::string TokenDates::rows_text() const {
  const auto slowest = std::max_element(rows_.begin(), rows_.end(), [](const Pair& a, const Pair& b) {
    return a.circuit - a.model < b.circuit - b.model;
  });
  const auto range = [this](std::int64_t Pair::*of) {
    const auto [least, most] = std::minmax_element(
        rows_.begin(), rows_.end(), [of](const Pair& a, const Pair& b) { return a.*of < b.*of; });
    return range_text((*least).*of, (*most).*of);
  };
  std::string text = fmt::format("a row in {}; the model {}", range(&Pair::circuit), range(&Pair::model));
  if (slowest->circuit > slowest->model)
    text += fmt::format("; most more in row {}", slowest - rows_.begin());
  return text;
}

std::string TokenDates::text(const std::optional<std::int64_t>& bound) const {
  if (!known_) return {};
  std::string out;
  const auto say = [&out](const std::string& line) {
    out += fmt::format("{:20}{}\n", out.empty() ? "dates" : "", line);
  };
  if (!frames_.empty()) {
    say(fmt::format("{} from the first to the last token of frame 0; the model {}",
                    cycles_text(frames_[0].circuit), grouped(std::to_string(frames_[0].model))));
  }
  if (!rows_.empty()) say(rows_text());
  if (latest_ > 0) {
    say(fmt::format("at most {} later than the model, at token {}", cycles_text(latest_), latest_token_));
  } else if (latest_ < 0) {
    say(fmt::format("each at least {} earlier than the model", cycles_text(-latest_)));
  } else {
    say("never later than the model");
  }
  if (!within(bound)) say(fmt::format("more than the bound of {}", cycles_text(*bound)));
  return out;
}

nlohmann::ordered_json TokenDates::column(const std::vector<Pair>& pairs, std::int64_t Pair::*of) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Pair& pair : pairs) all.push_back(pair.*of);
  return all;
}

void TokenDates::add_to(nlohmann::ordered_json& tree) const {
  tree["frame_cycles"] = column(frames_, &Pair::circuit);
  tree["model_frame_cycles"] = column(frames_, &Pair::model);
  tree["row_cycles"] = column(rows_, &Pair::circuit);
  tree["model_row_cycles"] = column(rows_, &Pair::model);
  if (known_) tree["latest"] = {{"cycles", latest_}, {"token", latest_token_}};
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "tests/timing/graph.hpp"
#include "tlm/stream_base.hpp"

namespace parallax::test {

/// Notes every date of one stream.
struct DateLog final : StreamListener {
  explicit DateLog(EdgeDates& d) : dates(d) {}
  void written(const StreamBase&, Cycles cycle) override { dates.written.push_back(cycle.count()); }
  void read(const StreamBase&, Cycles cycle) override { dates.read.push_back(cycle.count()); }
  EdgeDates& dates;
};

/// The first date in which two runs differ, per edge and side; empty when they are equal.
inline std::string differences(const std::vector<EdgeDates>& expected, const std::vector<EdgeDates>& actual) {
  std::ostringstream out;
  const auto compare = [&](std::size_t e, const char* side, const auto& want, const auto& have) {
    if (want == have) return;
    const std::size_t shared = std::min(want.size(), have.size());
    std::size_t i = 0;
    while (i < shared && want[i] == have[i]) ++i;
    out << "edge " << e << " " << side << " token " << i << ": expected ";
    i < want.size() ? out << want[i] : out << "nothing";
    out << ", have ";
    i < have.size() ? out << have[i] : out << "nothing";
    out << "\n";
  };
  for (std::size_t e = 0; e < expected.size(); ++e) {
    compare(e, "written", expected[e].written, actual[e].written);
    compare(e, "read", expected[e].read, actual[e].read);
    // Tokens that were not read are not settled; where all were read the high-water mark is final.
    if (expected[e].written.size() == expected[e].read.size() &&
        expected[e].high_water != actual[e].high_water) {
      out << "edge " << e << " high water: expected " << expected[e].high_water << ", have "
          << actual[e].high_water << "\n";
    }
  }
  return out.str();
}

}  // namespace parallax::test

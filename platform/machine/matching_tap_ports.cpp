// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/matching_tap_ports.hpp"

#include <string>
#include <utility>

namespace parallax {
namespace {

// Cuts the rows of a tap into groups of costs.
class GroupTap final : public TokenTap {
 public:
  GroupTap(MatchingTaps::Take& at, const TokenShape& shape, Take take)
      : at_(at), format_(shape.format), row_tokens_(shape.row_tokens), take_(std::move(take)) {
    at_ = [this](const Cost* row) { hand_over(row); };
  }
  ~GroupTap() override { at_ = nullptr; }

 private:
  void hand_over(const Cost* row) {
    const std::size_t group = format_.all().size();
    for (std::uint64_t i = 0; i < row_tokens_; ++i) {
      pack_values(format_, row + i * group, group, bits_);
      take_({number_++, bits_, Cycles(0)});
    }
  }

  MatchingTaps::Take& at_;
  const TokenFormat format_;
  const std::uint64_t row_tokens_;
  const Take take_;
  std::uint64_t number_ = 0;
  std::vector<std::uint64_t> bits_;
};

}  // namespace

std::vector<TokenPort> matching_tap_ports(const MatchingConfig& config, int code_bits,
                                          const TokenShape& costs, MatchingStage& stage, MatchingTaps& taps) {
  std::vector<TokenPort> all;
  const auto add = [&](const std::string& name, int bits, TokenShape shape, MatchingTaps::Take& at) {
    shape.format =
        cost_group_format(static_cast<std::size_t>(config.parallelism), static_cast<std::size_t>(bits));
    all.push_back({name,
                   false,
                   {name},
                   shape,
                   [shape, &at, &stage, &taps](const TokenTap::Take& take) {
                     stage.open(taps);
                     return std::make_unique<GroupTap>(at, shape, take);
                   },
                   {}});
  };
  add("pixel_costs", pixel_cost_bits(config, code_bits), costs, taps.pixel_costs);
  for (std::size_t i = 0; i < taps.paths.size(); ++i) {
    const auto path = static_cast<PathBit>(1U << i);
    if ((config.paths & path) == 0) continue;
    TokenShape shape = costs;
    shape.order = path_order(path);
    shape.path = path_step(config, path);
    add(std::string("path_") + kPathNames[i], path_cost_bits(config, code_bits), shape, taps.paths[i]);
  }
  return all;
}

}  // namespace parallax

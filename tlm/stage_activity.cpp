// SPDX-License-Identifier: Apache-2.0
#include "tlm/stage_activity.hpp"

#include <array>

namespace parallax {

const char* name_of(StageActivity activity) {
  static constexpr std::array<const char*, kAllStageActivities.size()> kNames{
      "busy", "starved", "blocked", "memory", "synchroniser", "blanking"};
  return kNames.at(index_of(activity));
}

StageStatistics& StageStatistics::add(const StageStatistics& o, std::int64_t times) {
  firings += o.firings * times;
  busy += o.busy * times;
  starved += o.starved * times;
  blocked += o.blocked * times;
  memory += o.memory * times;
  synchroniser += o.synchroniser * times;
  blanking += o.blanking * times;
  return *this;
}

}  // namespace parallax

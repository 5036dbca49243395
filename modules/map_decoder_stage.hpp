// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>
#include <vector>

#include "modules/map_codec.hpp"
#include "modules/map_decoder.hpp"
#include "modules/raster_schedule.hpp"
#include "tlm/stage.hpp"

namespace parallax {

/// Map decoder: words of the compressed rectification map in, one pair of offsets a pixel out
/// (map_decoder.hpp). A word is read when the pixel at hand needs a bit of it, so the pace of reading is that
/// of the real map; at most one word a cycle, and a pixel that needs several waits for them.
class MapDecoderStage final : public Stage {
 public:
  StreamIn<std::uint8_t> in_words{"in_words"};  ///< a token is one word; values are the bytes of a row
  StreamOut<OffsetPair> out_map{"out_map"};

  /// `word`: bytes of an input token. `map` gives the schedule, not the values; its rows are those of all
  /// passes over an image that one transfer of the map serves.
  MapDecoderStage(const sc_core::sc_module_name& name, const EncodedMap& map, Bytes word,
                  const StageTiming& timing, const StageContext& context);

  Bits storage() const { return Bits(kernel_.storage_bits()); }

 private:
  MapDecoder kernel_;
  std::vector<OffsetPair> row_;
};

}  // namespace parallax

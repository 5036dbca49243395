// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <memory>
#include <systemc>
#include <vector>

#include "modules/pixel.hpp"
#include "modules/pixel_format.hpp"
#include "tlm/ratio.hpp"
#include "tlm/ring.hpp"
#include "tlm/stream.hpp"
#include "tlm/units.hpp"

namespace parallax {

struct SensorConfig {
  int width = 0;                          ///< px
  int height = 0;                         ///< px
  Cycles row{0};                          ///< pixel clocks from one row's first pixel to the next one's
  Ratio byte_time{1, 1'000'000'000'000};  ///< pixel clocks that a byte takes on the cable
  Cycles frame_blanking{0};
  Bytes burst{128};
  PixelFormat format = PixelFormat::kMono8;
};

/// One image as a sensor sees it; without pixels it has a size and a time only.
using SensorImage = std::shared_ptr<const std::vector<Gray>>;

/// What a receiver sees of an image by its end: start and end of a frame are marked on the cable.
struct Received {
  Cycles begin;      ///< of the read-out
  Cycles last_byte;  ///< when it is due
  int rows = 0;
};

/// Rows of an image that do not arrive; their time passes.
struct LostRows {
  int first = 0;
  int count = 0;
};

/// One sensor of the stereo camera with its cable: reads an exposed image out in raster order, a row every
/// `row` cycles, a pixel a cycle in its format, and hands its bytes on in bursts, none before the cable has
/// brought it and those of the row before it. It cannot wait: a burst
/// that finds the FIFO full is late. A burst's date is handed on as soon as it is known that there is room
/// for it then.
class Sensor final : public sc_core::sc_module, public Actor {
 public:
  StreamOut<std::uint8_t> out_bursts{"out_bursts"};

  Sensor(const sc_core::sc_module_name& name, const SensorConfig& config, const ClockDomain& clock,
         Dataflow& dataflow);

  /// Starts to read out an image `delay` cycles from now, after the one before is out. One with lost rows has
  /// no pixels. `received`, if there is one, is filled in when the read-out begins.
  void read_out(SensorImage image, Cycles delay = Cycles(0), LostRows lost = {},
                std::shared_ptr<Received> received = nullptr);
  /// Reads out a frame that nobody takes, beginning in a cycle in which the sensor was free: time passes, no
  /// bytes.
  void read_out_unheard(Cycles begin);
  /// Whether it reads out in `cycle`, which has come.
  bool reads_out_in(Cycles cycle) const;
  /// Whether it can begin a frame in `cycle`, unless what it reads out now gets late.
  bool free_by(Cycles cycle) const { return exposed_.empty() && std::max(free_, last_write_) <= cycle; }
  /// Pixel clocks from one row to the next.
  Cycles row_time() const { return config_.row; }
  /// Pixel clocks of one frame, blanking included.
  Cycles frame_time() const;
  /// Pixel clocks spent on frames, blanking included, until now.
  Cycles busy() const;
  /// Until now.
  std::uint64_t late_bursts() const;

 private:
  struct Exposed {
    SensorImage image;
    Cycles at;
    LostRows lost;
    std::shared_ptr<Received> received;
  };

  void advance() override;
  bool begin_image();
  void note_late_burst();
  bool has_come(Cycles cycle) const;
  std::int64_t row_bytes() const { return bytes_of(config_.format, config_.width); }
  std::int64_t image_bytes() const { return row_bytes() * (config_.height - lost_.count); }
  Cycles due(std::int64_t byte) const;
  void send(const SensorImage& image);

  const SensorConfig config_;
  const ClockDomain& clock_;
  Dataflow& dataflow_;
  std::deque<Exposed> exposed_;  // images that wait for their read-out
  sc_core::sc_event go_on_;
  LostRows lost_;    // rows of the image under way that do not arrive
  std::int64_t at_;  // bytes of the image under way that have been handed on
  Cycles begin_{0};  // begin of the last read-out
  Cycles free_{0};   // end of the last read-out
  Cycles busy_;      // of the read-outs until then
  Cycles last_write_{-1};
  std::uint64_t late_bursts_ = 0;
  Ring<Cycles> late_to_come_;  // dates of late bursts that are known and have not come
};

}  // namespace parallax

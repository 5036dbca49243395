// SPDX-License-Identifier: Apache-2.0
#include "platform/config/camera_config.hpp"

#include <fmt/format.h>

#include "platform/config/schema.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr double kSlowestRate = 0.001;  // frames/s; below, the dates of a run leave 64 bit

}  // namespace

void CameraConfig::validate() const {
  if (frame_rate != 0 && frame_rate < kSlowestRate) {
    throw UserError(
        fmt::format("camera.frame_rate = {}: must be 0 or at least {} frames/s", frame_rate, kSlowestRate));
  }
  if (jitter_ns > 0 && frame_rate == 0) {
    throw UserError(fmt::format(
        "camera.jitter_ns = {}: needs a camera.frame_rate above 0, exposures have no dates to miss",
        jitter_ns));
  }
  if (jitter_ns * frame_rate >= 1e9) {
    throw UserError(
        fmt::format("camera.jitter_ns = {}: must be below the period of camera.frame_rate, {:.0f} ns",
                    jitter_ns, 1e9 / frame_rate));
  }
}

void describe(Schema& schema, CameraConfig& config) {
  schema.choice(
      "camera.format", config.format,
      {{"mono8", PixelFormat::kMono8},
       {"mono12_packed", PixelFormat::kMono12Packed},
       {"mono12", PixelFormat::kMono12},
       {"rgb8", PixelFormat::kRgb8},
       {"bayer8", PixelFormat::kBayer8}},
      "Format of the pixels on the cable and in memory: 1, 1.5, 2, 3 or 1 bytes a pixel. The core makes "
      "8-bit grey of it (modules/pixel_format.hpp).",
      stated("published list of the device's input formats; which one is in use is a choice"));
  schema.real(
      "camera.frame_rate", config.frame_rate, {0.0, 100'000.0}, "frames/s",
      "Rate at which the cameras expose, whether the machine keeps up or not: a frame that finds no frame "
      "buffer free is dropped. 0: triggered as soon as one is, which shows the highest rate of the "
      "machine.",
      chosen("shows what the machine itself can do"));
  schema.integer("camera.jitter_ns", config.jitter_ns, {0, 1'000'000'000}, "ns",
                 "Largest delay of an exposure's end after its date by camera.frame_rate; uniform from 0.",
                 chosen("a perfect trigger"));
  schema.integer("camera.jitter_seed", config.jitter_seed, {0, 4'294'967'295}, "seed",
                 "Seed of these delays: the same seed gives the same dates.", chosen("any"));
  schema.integer("camera.bytes_per_second", config.bytes_per_second, {1, 1'000'000'000'000}, "B/s",
                 "Rate of the cable of each sensor; the slower of this and the pixel clock sets the pace.",
                 inferred("USB 3.0: 5 Gbit/s less line code and protocol"));
  schema.integer("camera.row_blanking", config.row_blanking, {0, 1'000'000}, "pixel clocks",
                 "Pause of the sensor between two rows.", chosen("not published"));
  schema.integer("camera.frame_blanking", config.frame_blanking, {0, 1'000'000'000}, "pixel clocks",
                 "Pause of the sensor between two frames.", chosen("not published"));
  schema.integer("camera.frame_buffers", config.frame_buffers, {1, 64}, "stereo frames",
                 "Frames that the memory holds, from the camera until the pipeline has read them.",
                 chosen("not published; one being written, one being read, one to spare"));
}

}  // namespace parallax

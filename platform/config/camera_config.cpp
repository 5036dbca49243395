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
  if (skew_ns > skew_limit_ns) {
    throw UserError(fmt::format(
        "camera.skew_ns = {}: must be at most camera.skew_limit_ns = {}, or no two images are one frame",
        skew_ns, skew_limit_ns));
  }
  if (fault != CameraFault::kNone && early_start_rows > 0) {
    throw UserError(
        fmt::format("camera.early_start_rows = {}: must be 0 with a camera.fault, which shows when the core "
                    "has begun the frame",
                    early_start_rows));
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
  schema.integer("camera.exposure_ns", config.exposure_ns, {0, 1'000'000'000}, "ns",
                 "Exposure time, before the read-out begins. With a frame rate it must fit into the period.",
                 chosen("no light is simulated; matters where it limits the rate"));
  schema.boolean("camera.overlap", config.overlap,
                 "Whether the sensors expose while the frame before is read out.",
                 chosen("usual for global shutters"));
  schema.integer("camera.skew_ns", config.skew_ns, {0, 1'000'000'000}, "ns",
                 "How much later than the left sensor the right one ends its exposure.",
                 chosen("a common trigger"));
  schema.integer("camera.skew_limit_ns", config.skew_limit_ns, {0, 1'000'000'000}, "ns",
                 "Largest skew of two images that count as one frame; beyond it they are out of step.",
                 chosen("not published; a rolling scene moves little in a millisecond"));
  schema.choice(
      "camera.fault", config.fault,
      {{"none", CameraFault::kNone},
       {"short_frame", CameraFault::kShortFrame},
       {"missing_row", CameraFault::kMissingRow},
       {"out_of_step", CameraFault::kOutOfStep}},
      "What is wrong with every camera.fault_every-th frame: the left sensor stops early, rows of it "
      "are lost in the middle, or the right one is late by twice camera.skew_limit_ns. Such a frame is "
      "flagged in the registers and not processed.",
      chosen("a perfect cable"));
  schema.integer("camera.fault_every", config.fault_every, {2, 1'000'000}, "frames",
                 "Every so many frames, one is faulty if there is a camera.fault.", chosen("any"));
  schema.integer("camera.fault_rows", config.fault_rows, {1, 65535}, "rows",
                 "Rows that a short frame, or one with missing rows, lacks; all but one at most.",
                 chosen("any"));
  schema.integer(
      "camera.early_start_rows", config.early_start_rows, {0, 65536}, "rows",
      "Rows of both images in memory with which software is told of the frame, so that the core may "
      "begin; it reads behind the cameras, row by row. 0: the whole frame.",
      chosen("not published; the device's registers count bytes available"));
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

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/input/calibration_request.hpp"
#include "platform/input/stated_calibration.hpp"
#include "platform/input/top_level.hpp"

namespace parallax {

bool is_opencv_calibration(const TopLevel& file);

/// OpenCV FileStorage (YAML, XML or JSON): one file, or several that complete each other (the intrinsics.yml
/// and extrinsics.yml of OpenCV's stereo_calib sample). Entries, with the other names they may have:
///   camera_model: pinhole_radtan (the default; pinhole, plumb_bob, radtan, rational_polynomial),
///     fisheye_equidistant (fisheye, equidistant, kannala_brandt) or rectified; distortion_model: the same
///     without rectified, and no other than camera_model says
///   image_width, image_height, or image_size: [w, h] (imageSize)
///   K1, K2 (M1, cameraMatrix1, ...), D1, D2 (distCoeffs1, ...), R (3x3 or rotation vector), T, T_unit
///   R1, R2, P1, P2: all or none; Q
///   of ORB-SLAM2 and its kin: LEFT.K, LEFT.D, LEFT.R, LEFT.P, LEFT.width, LEFT.height, and RIGHT.*, which
///   are
///     K1, D1, R1, P1 and the size, and those of the right camera
/// Without R1..P2 they are computed; with them R and T are not needed. A file with P1 and P2, or Q, and
/// nothing of lenses or rotations is of rectified images. Throws UserError naming file and entry.
StatedCalibration read_opencv_calibration(const CalibrationRequest& request);

}  // namespace parallax

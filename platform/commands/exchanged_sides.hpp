// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/scene/stereo_images.hpp"

namespace parallax {

/// Whether a pair would plainly match better the other way round. Counted are textured patches of the left
/// image, at a reduced size, that resemble the right image much more to their left, where a disparity of up
/// to `largest` px has them, than to their right: at least 16 when the sides are exchanged, and four times
/// those of the pair as it is given. Both pairs are rectified, 8 bit, of one size.
bool sides_look_exchanged(const StereoImages& given, const StereoImages& exchanged, int largest);

}  // namespace parallax

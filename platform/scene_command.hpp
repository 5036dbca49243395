// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace parallax {

/// `parallax scene`: writes the built-in scene as files that `parallax run` and other programs read: left and
/// right image, calib.yml, disp_gt.png (16 bit, disparity * 256, 0 = unknown) and mask_nocc.png. When the
/// command is called, `action` becomes what it does; it returns the exit code and throws UserError for bad
/// input.
void add_scene_command(CLI::App& app, std::function<int()>& action);

}  // namespace parallax

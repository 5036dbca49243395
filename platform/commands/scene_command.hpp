// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace parallax {

struct CommandContext;

/// `parallax scene`: writes the built-in scene as files that `parallax run` and other programs read: left and
/// right image, calib.yml, disp_gt.png (16 bit, disparity * 256, 0 = unknown) and mask_nocc.png.
void add_scene_command(CLI::App& app, CommandContext& context);

}  // namespace parallax

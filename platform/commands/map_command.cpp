// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/map_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "platform/commands/command_context.hpp"
#include "platform/commands/common_options.hpp"
#include "platform/commands/notes.hpp"
#include "platform/input/map_builder.hpp"
#include "platform/input/map_fit.hpp"
#include "platform/input/map_info.hpp"
#include "platform/input/map_storage.hpp"
#include "platform/input/raw_map_file.hpp"
#include "platform/input/read_calibration.hpp"
#include "platform/results/file_identity.hpp"
#include "tlm/error.hpp"
#include "traces/json_text.hpp"
#include "traces/number_text.hpp"

namespace parallax {

namespace {

struct EncodeOptions {
  std::vector<std::string> calibration;
  std::string cameras;
  std::vector<std::string> maps;
  std::string identity;
  std::string size;
  OffsetRange range;
  bool fit = false;
  std::string output;
};

// A checksum that is right does not make the rows so: say which file they are in.
template <class Action>
auto in_file(const std::string& path, const Action& action) {
  try {
    return action(read_map_file(path));
  } catch (const UserError& error) {
    const std::string line = error.what();
    throw UserError(line.compare(0, path.size(), path) == 0 ? line : fmt::format("{}: {}", path, line));
  }
}

std::vector<NamedInput> inputs_of(const EncodeOptions& options) {
  std::vector<NamedInput> inputs;
  for (const std::string& path : options.calibration) inputs.push_back({"--calibration " + path, path});
  for (const std::string& path : options.maps) inputs.push_back({"--maps " + path, path});
  return inputs;
}

ImageSize parse_size(const std::string& option, const std::string& text) {
  ImageSize size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%c", &size.width, &size.height, &rest) != 2 || size.width < 1 ||
      size.height < 1 || size.width > 65535 || size.height > 65535) {
    throw UserError(fmt::format("{}: \"{}\" is not a size such as 640x480", option, excerpt(text)));
  }
  return size;
}

RectificationMap map_of_calibration(const EncodeOptions& options, CommandContext& context,
                                    std::ostream& out) {
  const ImageSize size = options.size.empty() ? ImageSize{} : parse_size("--size", options.size);
  Calibration calibration =
      read_calibration(options.calibration, size, camera_pair("--cameras", options.cameras));
  if (!options.size.empty()) {
    check_size(calibration, size);
  }
  Notes notes(context);
  if (!calibration.choice.empty()) notes(fmt::format("{}: {}", calibration.source, calibration.choice));
  if (options.fit) {
    if (const std::optional<Fit> found = fit(calibration, options.range)) {
      out << fmt::format(
          "fit: {}; focal length {:.2f} px, principal points ({:.2f}, {:.2f}) left and ({:.2f}, {:.2f}) "
          "right\n",
          found->text(), found->calibration.P1(0, 0), found->calibration.P1(0, 2),
          found->calibration.P1(1, 2), found->calibration.P2(0, 2), found->calibration.P2(1, 2));
      calibration = found->calibration;
    }
  }
  return build_map(calibration, options.range);
}

RectificationMap map_of(const EncodeOptions& options, CommandContext& context, std::ostream& out) {
  options.range.validate();
  if (!options.calibration.empty()) {
    return map_of_calibration(options, context, out);
  }
  if (!options.maps.empty()) {
    return build_map(read_raw_maps(options.maps), options.range,
                     fmt::format("{}", fmt::join(options.maps, " + ")));
  }
  const ImageSize size = parse_size("--identity", options.identity);
  return identity_map(size.width, size.height, options.range);
}

// Reports what was done, unless the user wants quiet.
template <class Action>
int report(CommandContext& context, const Action& action) {
  std::ostream nowhere(nullptr);
  action(context.verbosity == Verbosity::kQuiet ? nowhere : context.out);
  return 0;
}

void add_encode(CLI::App& command, CommandContext& context) {
  auto options = std::make_shared<EncodeOptions>();
  CLI::App* encode_command = command.add_subcommand("encode", "Compress a rectification map");
  CLI::Option_group* source = encode_command->add_option_group("source", "Where the offsets come from");
  CLI::Option* calibration = source->add_option("--calibration", options->calibration,
                                                "Calibration of OpenCV (one file, or intrinsics and "
                                                "extrinsics), ROS (two files, left and right), Kalibr, "
                                                "KITTI, Middlebury or VINS-Fusion");
  source->add_option(
      "--maps", options->maps,
      "Raw maps: one .yml/.xml/.json with left_x, left_y, right_x, right_y, or four float images");
  source->add_option("--identity", options->identity, "Map of a rectified pair of this size: WxH");
  source->require_option(1);
  encode_command->add_option("--cameras", options->cameras, kCamerasHelp)
      ->type_name("L,R")
      ->needs(calibration);
  encode_command->add_option("--size", options->size, "Image size WxH, for calibrations that do not state it")
      ->needs(calibration);
  encode_command
      ->add_option("--window", options->range.window, "Rows and columns of the rectification window")
      ->capture_default_str();
  encode_command
      ->add_option("--fraction-bits", options->range.fraction_bits, "Fraction bits of an offset, 0..8")
      ->capture_default_str();
  encode_command->add_flag("--fit", options->fit, "Zoom and shift the rectified images until the offsets fit")
      ->needs(calibration);
  encode_command->add_option("-o,--out", options->output, "Map file to write")->required();
  encode_command->callback([options, &context] {
    context.action = [options, &context] {
      refuse_to_replace(inputs_of(*options), "--out " + options->output, options->output);
      return report(context, [&](std::ostream& out) {
        const EncodedMap map = encode(map_of(*options, context, out));
        write_map_file(options->output, map);
        out << fmt::format("{}: {}x{} px, {} bytes, {} bytes per pixel and image\n", options->output,
                           map.width, map.height, map.bytes.size(), number_text(map.bytes_per_pixel(), "B"));
      });
    };
  });
}

void add_decode(CLI::App& command, CommandContext& context) {
  struct Options {
    std::string input;
    std::string output;
  };
  auto options = std::make_shared<Options>();
  CLI::App* decode_command =
      command.add_subcommand("decode", "Expand a compressed map into raw x and y maps");
  decode_command->add_option("map", options->input, "Map file")->required();
  decode_command
      ->add_option("-o,--out", options->output, "File to write: .yml, .yaml, .xml, .json, .tif, .tiff")
      ->required();
  decode_command->callback([options, &context] {
    context.action = [options, &context] {
      const std::vector<NamedInput> inputs{{options->input, options->input}};
      for (const std::string& name : raw_map_names(options->output))
        refuse_to_replace(inputs, "--out " + options->output, name);
      return report(context, [&](std::ostream& out) {
        const RectificationMap map = in_file(options->input, decode);
        out << fmt::format("{}\n", fmt::join(write_raw_maps(options->output, raw_maps(map)), "\n"));
      });
    };
  });
}

void add_info(CLI::App& command, CommandContext& context) {
  struct Options {
    std::string input;
    bool json = false;
    bool rows = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* info_command = command.add_subcommand("info", "Say what a compressed map holds and needs");
  info_command->add_option("map", options->input, "Map file")->required();
  info_command->add_flag("--json", options->json, "Machine-readable, with the bytes of each row");
  info_command->add_flag("--rows", options->rows, "Also the bytes of each row");
  info_command->callback([options, &context] {
    context.action = [options, &context] {
      const MapInfo info = in_file(options->input, inspect);
      context.out << (options->json ? json_text(nlohmann::json(info), 2) + "\n" : info.text(options->rows));
      return 0;
    };
  });
}

}  // namespace

void add_map_command(CLI::App& app, CommandContext& context) {
  CLI::App& command = *app.add_subcommand("map", "Encode, decode and inspect rectification maps");
  command.require_subcommand(1);
  add_encode(command, context);
  add_decode(command, context);
  add_info(command, context);
}

}  // namespace parallax

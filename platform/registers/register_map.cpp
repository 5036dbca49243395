// SPDX-License-Identifier: Apache-2.0
#include "platform/registers/register_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "platform/registers/run_time_parameters.hpp"

namespace parallax {
namespace {

using A = FieldAccess;

Register whole(const char* name, std::uint32_t offset, const char* documentation, A access,
               const char* field) {
  return {name, offset, documentation, {{field, 0, 32, access, 0, documentation}}};
}

Register address_high(const char* name, std::uint32_t offset, const char* documentation) {
  return whole(name, offset, documentation, A::kReadWrite, "address");
}

Register image_size(std::uint32_t offset) {
  return {"image_size",
          offset,
          "Size of the images; both blocks must have the size that the machine was built for.",
          {{"width", 0, 16, A::kReadWrite, 0, "px; 65536 is 0."},
           {"height", 16, 16, A::kReadWrite, 0, "px; 65536 is 0."}}};
}

Register fifo_info(const char* name, std::uint32_t offset, const char* documentation) {
  return {name,
          offset,
          documentation,
          {{"under_way", 0, 16, A::kReadOnly, 0, "Bursts requested and not answered."},
           {"places", 16, 16, A::kReadOnly, 0, "Bursts that can be under way at most."}}};
}

RegisterBlock dma_block() {
  constexpr A kError = A::kWriteOneToClear;
  return {"dma",
          0x000,
          "Where the core's data lie, and the start of a frame.",
          {{"control",
            0x00,
            "Starts the core.",
            {{"start", 0, 1, A::kTrigger, 0, "1: process a frame as the registers say now."}}},
           {"status",
            0x04,
            "What the core is doing.",
            {{"busy", 0, 1, A::kReadOnly, 0, "A frame is being processed."},
             {"ready", 1, 1, A::kReadOnly, 1, "A start would be taken."},
             {"frames_done", 16, 16, A::kReadOnly, 0, "Frames whose results are in memory, modulo 65536."}}},
           image_size(0x08),
           address_high("output_address_high", 0x0C, "Upper half of the address of the results."),
           address_high("output_address_low", 0x10, "Lower half of the address of the results."),
           whole("output_bytes_available", 0x14, "Bytes of the frame's results that are in memory.",
                 A::kReadOnly, "bytes"),
           fifo_info("output_fifo_info", 0x18, "The engine that writes results."),
           address_high("left_address_high", 0x1C, "Upper half of the address of the left image."),
           address_high("left_address_low", 0x20, "Lower half of the address of the left image."),
           whole("left_bytes_available", 0x24,
                 "Bytes of the left image that are in memory at the start: all, or camera.early_start_rows "
                 "of its rows.",
                 A::kReadWrite, "bytes"),
           address_high("right_address_high", 0x28, "Upper half of the address of the right image."),
           address_high("right_address_low", 0x2C, "Lower half of the address of the right image."),
           whole("right_bytes_available", 0x30,
                 "Bytes of the right image that are in memory at the start: all, or camera.early_start_rows "
                 "of its rows.",
                 A::kReadWrite, "bytes"),
           fifo_info("input_fifo_info", 0x34, "The engines that read the two images, together."),
           address_high("map_address_high", 0x38, "Upper half of the address of the rectification map."),
           address_high("map_address_low", 0x3C, "Lower half of the address of the rectification map."),
           fifo_info("map_fifo_info", 0x40, "The engine that reads the rectification map."),
           address_high("buffer_address_high", 0x44,
                        "Upper half of the address of what the matcher keeps in memory, if it does."),
           address_high("buffer_address_low", 0x48,
                        "Lower half of the address of what the matcher keeps in memory, if it does."),
           fifo_info("buffer_fifo_info", 0x4C,
                     "The engines that write and read back what the matcher keeps in memory."),
           {"errors",
            0x50,
            "What was wrong with a start, which had no effect then. Write 1 to clear.",
            {{"address", 0, 1, kError, 0, "A buffer does not lie in memory."},
             {"size", 1, 1, kError, 0, "The image size is not the machine's, or differs between the blocks."},
             {"not_ready", 2, 1, kError, 0, "A start while the core could not take one."},
             {"bytes", 3, 1, kError, 0, "Too little of the images was in memory."},
             {"disabled", 4, 1, kError, 0, "The stereo block was not enabled."}}},
           {"input_errors",
            0x54,
            "What was wrong with frames of the cameras, which were not processed. Write 1 to clear.",
            {{"short_frame", 0, 1, kError, 0, "An image ended before its last row."},
             {"missing_row", 1, 1, kError, 0, "Rows were missing in the middle of an image."},
             {"out_of_step", 2, 1, kError, 0, "The left and the right image were too far apart in time."},
             {"frames", 16, 16, A::kReadOnly, 0, "Frames with such an error, modulo 65536."}}}}};
}

RegisterBlock stereo_block() {
  std::vector<RegisterField> control = parameter_fields("control");
  control.insert(control.begin(), {"enable", 0, 1, A::kReadWrite, 1, "Whether starts are taken."});
  const auto parameters = [](const char* name, std::uint32_t offset, const char* documentation) {
    return Register{name, offset, documentation, parameter_fields(name)};
  };
  return {"stereo",
          0x100,
          "What the core computes. Written while a frame is processed, it counts from the next one on.",
          {{"control", 0x00, "Enable and disparity range.", control},
           image_size(0x04),
           parameters("algorithm_parameters_1", 0x08, "Costs and uniqueness."),
           parameters("algorithm_parameters_2", 0x0C,
                      "Thresholds and switches. What the machine was built without cannot be switched on."),
           {"errors", 0x28,
            "Parameters that a start found to be impossible; the frame is processed with the last possible "
            "ones. Write 1 to clear.",
            parameter_error_fields()}}};
}

const char* text_of(A access) {
  switch (access) {
    case A::kReadWrite:
      return "RW";
    case A::kReadOnly:
      return "R";
    case A::kWriteOneToClear:
      return "W1C";
    case A::kTrigger:
      return "W1";
  }
  return "";
}

std::string bits(const RegisterField& f) {
  return f.width == 1 ? fmt::format("{}", f.low) : fmt::format("{}:{}", f.low + f.width - 1, f.low);
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

}  // namespace

const std::vector<RegisterBlock>& register_blocks() {
  static const std::vector<RegisterBlock> blocks{dma_block(), stereo_block()};
  return blocks;
}

std::string registers_as_markdown() {
  std::string text =
      "# Registers\n\nMade by `parallax registers --markdown`. 32-bit registers, little endian. RW: read and "
      "write; R: "
      "read only; W1C: write 1 to clear;\nW1: writing 1 starts something, reads as 0.\n";
  for (const RegisterBlock& block : register_blocks()) {
    text += fmt::format(
        "\n## {} block, at {:#05x}\n\n{}\n\n| offset | register | bits | field | access | reset | meaning |\n"
        "|---|---|---|---|---|---|---|\n",
        block.name, block.base, block.documentation);
    for (const Register& reg : block.registers) {
      // A register that is its only field is one row.
      const bool is_its_field = reg.fields.size() == 1 && reg.fields[0].documentation == reg.documentation;
      const std::string place = fmt::format("{:#04x} | {}", reg.offset, reg.name);
      if (!is_its_field) text += fmt::format("| {} | | | | | {} |\n", place, reg.documentation);
      for (const RegisterField& f : reg.fields) {
        text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", is_its_field ? place : " | ", bits(f),
                            f.name, text_of(f.access), f.reset, f.documentation);
      }
    }
  }
  return text;
}

std::string registers_as_header() {
  std::string text =
      "/* Made by `parallax registers --header`. */\n#ifndef PARALLAX_REGISTERS_H\n#define "
      "PARALLAX_REGISTERS_H\n";
  for (const RegisterBlock& block : register_blocks()) {
    text += fmt::format("\n/* {} */\n", block.documentation);
    for (const Register& reg : block.registers) {
      const std::string name = fmt::format("PARALLAX_{}_{}", upper(block.name), upper(reg.name));
      text += fmt::format("#define {} {:#05x}u /* {} */\n", name, block.base + reg.offset, reg.documentation);
      for (const RegisterField& f : reg.fields) {
        if (f.width == 32) continue;
        text += fmt::format("#define {0}_{1}_SHIFT {2}u\n#define {0}_{1}_MASK {3:#010x}u\n", name,
                            upper(f.name), f.low, f.mask());
      }
    }
  }
  return text + "\n#endif\n";
}

std::string registers_as_text() {
  std::string text;
  for (const RegisterBlock& block : register_blocks()) {
    for (const Register& reg : block.registers) {
      text += fmt::format("{:#05x} {}.{}\n", block.base + reg.offset, block.name, reg.name);
      for (const RegisterField& f : reg.fields) {
        text +=
            fmt::format("      {:>5}  {:<4}{:<22}{}\n", bits(f), text_of(f.access), f.name, f.documentation);
      }
    }
  }
  return text;
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/machine/token_shape.hpp"

namespace parallax {

/// The tokens of one port of a stage, in a file.
struct VectorStream {
  std::string name;               ///< of the stream at the port, as in the keys streams.NAME.depth
  std::vector<std::string> also;  ///< further streams that get the same tokens (a fork)
  std::string port;               ///< "in_left"
  bool is_input = false;
  bool is_tap = false;    ///< taken inside the stage; the port has its name
  std::string file;       ///< $readmemh, a token a line, first token first
  std::string dates_file; /**< a number a line: the cycle of the core's clock in which the token is read
                             (input) or written (output) in the machine; empty: not written */
  TokenShape shape;
  std::uint64_t tokens = 0;        ///< of all frames
  std::uint64_t frame_tokens = 0;  ///< of a frame, all tiles of it
  std::string check;               ///< VectorCheck of its words, hexadecimal
};

/// Where a value of a token lies. -1: not known of such tokens.
struct ValuePlace {
  std::int64_t frame = 0;
  std::int64_t tile = -1;
  std::int64_t row = -1;
  std::int64_t column = -1;     ///< of the processed image
  std::int64_t disparity = -1;  ///< px
};

/// What a folder of vectors holds: the tokens that went in and out of a stage while the machine processed
/// images.
struct VectorManifest {
  static constexpr const char* kFile = "manifest.json";
  static constexpr int kVersion = 1;

  std::string program;  ///< that wrote it
  std::string stage;
  int width = 0;  ///< px, of the images as they are processed
  int height = 0;
  int tile_width = 0;              ///< px
  std::vector<int> tile_begins{};  ///< first column of each tile
  std::int64_t frames = 0;
  std::int64_t first_frame = 0;  ///< number of the first one: 0 but where some are looked at alone
  std::int64_t clock_hz = 0;
  std::uint64_t interval = 0;           ///< cycles from one firing to the next, where nothing waits
  std::uint64_t latency = 0;            ///< cycles from reading to writing
  std::uint64_t look_ahead = 0;         ///< tokens of pixels that are read beyond the one that is written
  std::vector<VectorStream> streams{};  ///< inputs first, taps last

  /// Tokens that pass in one go over the image, or over a tile of it where the stage knows rows.
  std::uint64_t pass_tokens(const VectorStream& stream) const;
  ValuePlace place(const VectorStream& stream, std::uint64_t token, std::size_t field) const;
  /// The same without what is taken inside the stage.
  VectorManifest without_taps() const;
  /// By the name of the stream, of one that gets the same tokens, or of the port; nullptr if there is none.
  const VectorStream* find(const std::string& name) const;
};

nlohmann::ordered_json to_json(const VectorManifest& manifest);
/// What to_json() wrote. Throws nlohmann::json::exception or UserError for other trees.
VectorManifest vector_manifest(const nlohmann::ordered_json& tree);

/// Throws UserError when there is none, it is damaged, or of another version.
VectorManifest read_vector_manifest(const std::filesystem::path& folder);

/// A number that depends on each bit of each word and on their order, as cheap in a test bench as here: each
/// word is combined, by exclusive or, with the number so far, rotated by one place upwards. As wide as a
/// word.
class VectorCheck {
 public:
  explicit VectorCheck(std::size_t width);

  void add(const std::vector<std::uint64_t>& word);
  /// Hexadecimal, all digits.
  std::string text() const;

 private:
  std::size_t width_;
  std::vector<std::uint64_t> sum_;
};

/// The digits of a word of `width` bits, highest first: as $readmemh takes them and %h prints them.
void append_hex(std::string& text, const std::vector<std::uint64_t>& word, std::size_t width);

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/vector_manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "platform/input/text_file.hpp"
#include "platform/results/version.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr std::size_t kWord = 64;
constexpr const char* kFormat = "parallax vectors";
constexpr std::size_t kMostBytes = 16u << 20;                       // of a manifest
constexpr std::array kOrders{"raster", "right_to_left", "turned"};  // ScanOrder
constexpr std::array kStarts{"cost", "clamp", "carry", "delay_line",
                             "first_column"};  // as matching.path_start

using Json = nlohmann::ordered_json;

Json fields_json(const TokenFormat& format) {
  Json all = Json::array();
  for (const TokenField& field : format.all()) {
    all.push_back(
        {{"name", field.name}, {"low", field.low}, {"bits", field.width}, {"signed", field.is_signed}});
  }
  return all;
}

Json stream_json(const VectorStream& stream) {
  const TokenShape& shape = stream.shape;
  Json out{{"name", stream.name},
           {"also", stream.also},
           {"port", stream.port},
           {"direction", stream.is_input ? "in"
                         : stream.is_tap ? "tap"
                                         : "out"},
           {"file", stream.file}};
  if (!stream.dates_file.empty()) out["dates_file"] = stream.dates_file;
  out["width"] = shape.format.width().count();
  out["tokens"] = stream.tokens;
  out["tokens_per_frame"] = stream.frame_tokens;
  out["tokens_per_row"] = shape.row_tokens;
  out["tokens_per_pixel"] = shape.tokens_per_pixel;
  out["pixels_per_token"] = shape.pixels_per_token;
  if (shape.first_disparity) out["first_disparity"] = *shape.first_disparity;
  if (stream.is_tap) out["order"] = kOrders[static_cast<std::size_t>(shape.order)];
  if (shape.path) {
    out["path"] = {{"dx", shape.path->dx},
                   {"rows_up", shape.path->rows_up},
                   {"start", kStarts[static_cast<std::size_t>(shape.path->start)]}};
  }
  out["check"] = stream.check;
  out["fields"] = fields_json(shape.format);
  return out;
}

template <class E, std::size_t N>
E enumerator(const char* what, const std::array<const char*, N>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw UserError(fmt::format("the {} '{}' is not known", what, excerpt(name)));
  return static_cast<E>(found - names.begin());
}

VectorStream read_stream(const Json& in) {
  VectorStream stream;
  stream.name = in.at("name").get<std::string>();
  stream.also = in.at("also").get<std::vector<std::string>>();
  stream.port = in.at("port").get<std::string>();
  stream.is_input = in.at("direction").get<std::string>() == "in";
  stream.is_tap = in.at("direction").get<std::string>() == "tap";
  stream.file = in.at("file").get<std::string>();
  stream.dates_file = in.value("dates_file", "");
  stream.tokens = in.at("tokens").get<std::uint64_t>();
  stream.frame_tokens = in.at("tokens_per_frame").get<std::uint64_t>();
  stream.check = in.at("check").get<std::string>();
  TokenFormat format;
  for (const Json& field : in.at("fields")) {
    const auto bits = field.at("bits").get<std::size_t>();
    if (bits < 1 || bits > kWord) throw UserError(fmt::format("a field of {} bits", bits));
    format.field(field.at("name").get<std::string>(), bits, field.at("signed").get<bool>());
  }
  if (format.all().empty()) throw UserError("a stream without fields");
  stream.shape = TokenShape(format);
  stream.shape.row_tokens = in.at("tokens_per_row").get<std::uint64_t>();
  stream.shape.tokens_per_pixel = std::max<std::uint64_t>(in.at("tokens_per_pixel").get<std::uint64_t>(), 1);
  stream.shape.pixels_per_token = std::max<std::uint64_t>(in.at("pixels_per_token").get<std::uint64_t>(), 1);
  stream.shape.order = enumerator<ScanOrder>("order", kOrders, in.value("order", kOrders.front()));
  if (in.contains("path")) {
    const Json& path = in.at("path");
    stream.shape.path =
        PathStep{path.at("dx").get<int>(), path.at("rows_up").get<int>(),
                 enumerator<PathStart>("start", kStarts, path.at("start").get<std::string>())};
  }
  if (in.contains("first_disparity")) stream.shape.first_disparity = in.at("first_disparity").get<int>();
  return stream;
}

}  // namespace

VectorManifest vector_manifest(const Json& in) {
  VectorManifest manifest;
  manifest.program = in.at("program").get<std::string>();
  manifest.stage = in.at("stage").get<std::string>();
  const Json& size = in.at("size");
  manifest.width = size.at("width").get<int>();
  manifest.height = size.at("height").get<int>();
  manifest.tile_width = size.at("tile_width").get<int>();
  manifest.tile_begins = size.at("tile_begins").get<std::vector<int>>();
  if (manifest.tile_begins.empty()) throw UserError("an image without tiles");
  manifest.frames = in.at("frames").get<std::int64_t>();
  manifest.clock_hz = in.at("clock_hz").get<std::int64_t>();
  manifest.interval = in.at("interval").get<std::uint64_t>();
  manifest.latency = in.at("latency").get<std::uint64_t>();
  manifest.look_ahead = in.at("look_ahead").get<std::uint64_t>();
  for (const Json& stream : in.at("streams")) manifest.streams.push_back(read_stream(stream));
  return manifest;
}

std::uint64_t VectorManifest::pass_tokens(const VectorStream& stream) const {
  if (stream.shape.row_tokens == 0) return stream.frame_tokens;
  return std::max<std::uint64_t>(stream.frame_tokens / tile_begins.size(), 1);
}

ValuePlace VectorManifest::place(const VectorStream& stream, std::uint64_t token, std::size_t field) const {
  const TokenShape& shape = stream.shape;
  ValuePlace place;
  if (stream.frame_tokens == 0) return place;
  place.frame = first_frame + static_cast<std::int64_t>(token / stream.frame_tokens);
  std::uint64_t rest = token % stream.frame_tokens;
  if (shape.row_tokens == 0) return place;
  const std::uint64_t tile_tokens = pass_tokens(stream);
  const std::uint64_t tile = rest / tile_tokens;
  rest %= tile_tokens;
  place.tile = static_cast<std::int64_t>(tile);
  place.row = static_cast<std::int64_t>(rest / shape.row_tokens);
  const std::uint64_t in_row = rest % shape.row_tokens;
  const std::size_t fields_of_pixel =
      std::max<std::size_t>(shape.format.all().size() / shape.pixels_per_token, 1);
  auto pixel = static_cast<std::int64_t>(shape.tokens_per_pixel > 1
                                             ? in_row / shape.tokens_per_pixel
                                             : in_row * shape.pixels_per_token + field / fields_of_pixel);
  if (shape.order == ScanOrder::kTurned) place.row = height - 1 - place.row;
  if (shape.order != ScanOrder::kRaster) pixel = tile_width - 1 - pixel;
  place.column = pixel + tile_begins[std::min<std::size_t>(tile, tile_begins.size() - 1)];
  if (shape.first_disparity) {
    const std::uint64_t group = in_row % shape.tokens_per_pixel;
    place.disparity =
        *shape.first_disparity + static_cast<std::int64_t>(group * shape.format.all().size() + field);
  }
  return place;
}

VectorManifest VectorManifest::without_taps() const {
  VectorManifest out = *this;
  out.streams.erase(std::remove_if(out.streams.begin(), out.streams.end(),
                                   [](const VectorStream& stream) { return stream.is_tap; }),
                    out.streams.end());
  return out;
}

const VectorStream* VectorManifest::find(const std::string& name) const {
  for (const VectorStream& stream : streams) {
    if (stream.name == name || stream.port == name ||
        std::find(stream.also.begin(), stream.also.end(), name) != stream.also.end())
      return &stream;
  }
  return nullptr;
}

nlohmann::ordered_json to_json(const VectorManifest& manifest) {
  Json streams = Json::array();
  for (const VectorStream& stream : manifest.streams) streams.push_back(stream_json(stream));
  return {{"format", kFormat},
          {"version", VectorManifest::kVersion},
          {"program", manifest.program},
          {"stage", manifest.stage},
          {"size",
           {{"width", manifest.width},
            {"height", manifest.height},
            {"tile_width", manifest.tile_width},
            {"tile_begins", manifest.tile_begins}}},
          {"frames", manifest.frames},
          {"clock_hz", manifest.clock_hz},
          {"interval", manifest.interval},
          {"latency", manifest.latency},
          {"look_ahead", manifest.look_ahead},
          {"streams", streams}};
}

VectorManifest read_vector_manifest(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / VectorManifest::kFile;
  if (!std::filesystem::exists(path)) {
    throw UserError(fmt::format("{}: no folder of vectors, as it has no {}; parallax vectors writes one",
                                folder.string(), VectorManifest::kFile));
  }
  const auto damaged = [&](const std::string& why) {
    return UserError(
        fmt::format("{}: damaged, {}; run parallax vectors again", path.string(), excerpt(why, 200)));
  };
  const std::string text = read_text_file(path.string(), kMostBytes);
  try {
    const Json tree = Json::parse(text);
    if (tree.at("format").get<std::string>() != kFormat) throw UserError("not a manifest of vectors");
    const int version = tree.at("version").get<int>();
    if (version != VectorManifest::kVersion) {
      throw UserError(
          fmt::format("{}: vectors of version {}, this program reads version {}; run parallax vectors again",
                      path.string(), version, VectorManifest::kVersion));
    }
    return vector_manifest(tree);
  } catch (const Json::exception& error) {
    throw damaged(error.what());
  } catch (const UserError& error) {
    const std::string line = error.what();
    if (line.rfind(path.string(), 0) == 0) throw;
    throw damaged(line);
  }
}

VectorCheck::VectorCheck(std::size_t width) : width_(width), sum_((width + kWord - 1) / kWord) {}

void VectorCheck::add(const std::vector<std::uint64_t>& word) {
  const std::size_t top = (width_ - 1) % kWord;
  std::uint64_t carry = sum_.back() >> top & 1u;
  for (std::size_t i = 0; i < sum_.size(); ++i) {
    const std::uint64_t next = sum_[i] >> (kWord - 1);
    sum_[i] = (sum_[i] << 1 | carry) ^ word[i];
    carry = next;
  }
  if (top + 1 < kWord) sum_.back() &= (std::uint64_t{1} << (top + 1)) - 1;
}

std::string VectorCheck::text() const {
  std::string digits;
  append_hex(digits, sum_, width_);
  return digits;
}

void append_hex(std::string& text, const std::vector<std::uint64_t>& word, std::size_t width) {
  constexpr std::size_t kDigit = 4;
  for (std::size_t digit = (width + kDigit - 1) / kDigit; digit-- > 0;) {
    text += "0123456789abcdef"[word[digit * kDigit / kWord] >> (digit * kDigit % kWord) & 0xF];
  }
}

}  // namespace parallax

// SPDX-License-Identifier: Apache-2.0
// Each reader of the program as a function of bytes: it understands them, or throws UserError. Anything else,
// a crash, another exception, memory or time without bound, is a fault.
#pragma once

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "modules/map_file.hpp"
#include "platform/config/configuration.hpp"
#include "platform/config/dram_device.hpp"
#include "platform/config/preset.hpp"
#include "platform/cosim/dump_file.hpp"
#include "platform/cosim/fifo_description.hpp"
#include "platform/cosim/vector_manifest.hpp"
#include "platform/images/image_codecs.hpp"
#include "platform/input/address_trace.hpp"
#include "platform/input/image_input.hpp"
#include "platform/input/image_pairs.hpp"
#include "platform/input/map_info.hpp"
#include "platform/input/raw_map_file.hpp"
#include "platform/input/read_calibration.hpp"
#include "platform/report/comparison_page.hpp"
#include "platform/report/report_file.hpp"
#include "platform/report/run_comparison.hpp"
#include "platform/report/run_report.hpp"
#include "platform/results/truth_file.hpp"
#include "platform/validation/published_row.hpp"
#include "tests/fuzz/calibration_seeds.hpp"
#include "tests/fuzz/seeds.hpp"
#include "tests/platform/temporary_folder.hpp"
#include "tlm/error.hpp"

namespace parallax::test {

/// A reader, and what it understands. `read` says whether it understood.
struct FuzzedReader {
  std::string name;
  std::function<std::vector<std::string>()> seeds;
  std::function<void(const TemporaryFolder&, const std::string& bytes)> read;
};

inline bool understands(const FuzzedReader& reader, const TemporaryFolder& folder, const std::string& bytes) {
  try {
    reader.read(folder, bytes);
    return true;
  } catch (const UserError&) {
    return false;
  }
}

inline std::string put(const TemporaryFolder& folder, const std::string& name, const std::string& bytes) {
  std::ofstream(folder.path() / name, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return folder / name;
}

inline void read_preset(const TemporaryFolder& folder, const std::string& bytes) {
  ConfigurationRequest request;
  request.preset = put(folder, "p.toml", bytes);
  load_configuration(request, preset_folders());
}

inline void read_assignment_of(const TemporaryFolder&, const std::string& bytes) {
  ConfigurationRequest request;
  request.assignments = {bytes};
  load_configuration(request, preset_folders());
}

inline void read_device(const TemporaryFolder& folder, const std::string& bytes) {
  load_dram_device(put(folder, "d.toml", bytes), preset_folders());
}

inline void read_rows(const TemporaryFolder& folder, const std::string& bytes) {
  read_published_rows(put(folder, "r.toml", bytes), preset_folders());
}

inline void read_calibration_file(const TemporaryFolder& folder, const std::string& bytes) {
  read_calibration({put(folder, "c.yml", bytes)}, {64, 48});
}

inline void read_calibration_pair(const TemporaryFolder& folder, const std::string& bytes) {
  const std::size_t end = std::min(bytes.find(kNextFile), bytes.size());
  const std::size_t next = std::min(end + std::string(kNextFile).size(), bytes.size());
  read_calibration(
      {put(folder, "left.yml", bytes.substr(0, end)), put(folder, "right.yml", bytes.substr(next))},
      {64, 48});
}

inline void read_raw_maps_file(const TemporaryFolder& folder, const std::string& bytes) {
  read_raw_maps({put(folder, "m.yml", bytes)});
}

inline void read_list(const TemporaryFolder& folder, const std::string& bytes) {
  put(folder, "l.png", "");
  put(folder, "r.png", "");
  find_image_pairs(put(folder, "list.txt", bytes));
}

inline void read_map(const TemporaryFolder&, const std::string& bytes) {
  const EncodedMap map = from_file_bytes({bytes.begin(), bytes.end()}, "map");
  inspect(map);
  decode(map);
}

// A checksum keeps changed bytes from what is behind it, so it is made right again.
inline void read_map_with_checksum(const TemporaryFolder& folder, std::string bytes) {
  constexpr std::size_t kChecksumAt = 4, kSummedFrom = 8;
  if (bytes.size() > kSummedFrom) {
    FileContent content;
    content.add(bytes.data() + kSummedFrom, bytes.size() - kSummedFrom);
    for (std::size_t i = 0; i < 4; ++i) bytes[kChecksumAt + i] = static_cast<char>(content.crc >> (8 * i));
  }
  read_map(folder, bytes);
}

inline void read_pair(const TemporaryFolder& folder, const std::string& bytes) {
  const std::string path = put(folder, "left.png", bytes);
  ImageInput sequence({{path, path}}, {}, [](const std::string&) {});
  sequence.load(0);
}

inline void read_truth(const TemporaryFolder& folder, const std::string& bytes) {
  read_ground_truth({put(folder, "t.png", bytes), "", {}}, 16, 8, [](const std::string&) {});
}

inline void read_trace(const TemporaryFolder& folder, const std::string& bytes) {
  read_address_trace(put(folder, "t.csv", bytes));
}

inline void read_manifest(const TemporaryFolder& folder, const std::string& bytes) {
  put(folder, VectorManifest::kFile, bytes);
  const VectorManifest manifest = read_vector_manifest(folder.path());
  for (const VectorStream& stream : manifest.streams) manifest.place(stream, 12345, 0);
}

inline void read_fifo_waves(const TemporaryFolder& folder, const std::string& bytes) {
  describe_fifo({read_fifo_capture(put(folder, "f.txt", bytes), {})});
}

inline void read_dump_of(const TemporaryFolder& folder, const std::string& bytes) {
  VectorStream stream;
  stream.name = "left_codes";
  stream.port = "out_left";
  stream.shape = TokenShape(TokenFormat().field("code", 12).field("cause", 3, true));
  read_dump(put(folder, "d.txt", bytes), stream);
}

inline void read_results(const TemporaryFolder& folder, const std::string& bytes) {
  const RunReport report = read_run_report(put(folder, "timing.json", bytes));
  report_of(folder.path());
}

inline const std::vector<FuzzedReader>& fuzzed_readers() {
  static const std::vector<FuzzedReader> readers{
      {"preset", preset_seeds, read_preset},
      {"assignment", assignment_seeds, read_assignment_of},
      {"device", device_seeds, read_device},
      {"rows", row_seeds, read_rows},
      {"calibration", calibration_seeds, read_calibration_file},
      {"calibration_pair", calibration_pair_seeds, read_calibration_pair},
      {"raw_maps", raw_map_seeds, read_raw_maps_file},
      {"list", list_seeds, read_list},
      {"map", map_seeds, read_map},
      {"map_content", map_seeds, read_map_with_checksum},
      {"image", image_seeds, read_pair},
      {"truth", truth_seeds, read_truth},
      {"trace", trace_seeds, read_trace},
      {"manifest", manifest_seeds, read_manifest},
      {"dump", dump_seeds, read_dump_of},
      {"fifo", fifo_seeds, read_fifo_waves},
      {"results", result_seeds, read_results}};
  return readers;
}

}  // namespace parallax::test

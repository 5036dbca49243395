// SPDX-License-Identifier: Apache-2.0
#include "platform/input/map_storage.hpp"

#include "modules/map_file.hpp"
#include "platform/input/input_file.hpp"
#include "platform/results/output_file.hpp"

namespace parallax {

void write_map_file(const std::string& path, const EncodedMap& map) { write_file(path, to_file_bytes(map)); }

EncodedMap read_map_file(const std::string& path) { return from_file_bytes(read_file(path), path); }

}  // namespace parallax

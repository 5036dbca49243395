// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "platform/cosim/token_words.hpp"
#include "platform/cosim/vector_manifest.hpp"

namespace parallax {

/// Which signals of a VCD are the stream; empty: they are looked for by the names of port and stream.
struct DumpSignals {
  std::string data, valid, ready, clock;
};

/// What a simulator wrote down of a stream.
struct Dump {
  TokenWords words;
  std::vector<std::int64_t> cycles;  ///< of each token; empty: the file does not say
};

/// The words that a manifest's stream should have: its file, and that it is the one that was written with the
/// manifest. Throws UserError.
TokenWords read_vectors(const std::string& path, const VectorStream& stream);

/// A dump, by its content: a VCD, from whose waves the tokens are taken at rising clock edges with valid and
/// ready (ready may be missing); a CSV, whose first line names the columns: a column for each field, in
/// decimal or 0x, or one column data of hexadecimal words, and optionally cycle, and valid and ready, of
/// which both must be 1 for a token; else the text that $readmemh takes and $writememh writes. Plain or gzip.
/// Throws UserError with the line.
Dump read_dump(const std::string& path, const VectorStream& stream, const DumpSignals& signals = {});

}  // namespace parallax

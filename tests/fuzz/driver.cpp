// SPDX-License-Identifier: Apache-2.0
// One reader under libFuzzer: `fuzz_driver READER [options of libFuzzer] CORPUS...`. `fuzz_driver --seeds
// READER FOLDER` writes what it begins with, `fuzz_driver --list` the names of the readers. Built by
// tests/fuzz/run.
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "tests/fuzz/readers.hpp"

extern "C" int LLVMFuzzerRunDriver(int* argc, char*** argv,
                                   int (*read)(const std::uint8_t* data, std::size_t size));

namespace {

using parallax::test::FuzzedReader;

const FuzzedReader* chosen = nullptr;

const FuzzedReader* find(const std::string& name) {
  for (const FuzzedReader& reader : parallax::test::fuzzed_readers()) {
    if (reader.name == name) return &reader;
  }
  return nullptr;
}

int read(const std::uint8_t* data, std::size_t size) {
  static const parallax::TemporaryFolder folder;
  understands(*chosen, folder, {reinterpret_cast<const char*>(data), size});
  return 0;
}

}  // namespace

// libsystemc brings main().
int sc_main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "--list";
  if (first == "--list") {
    for (const FuzzedReader& reader : parallax::test::fuzzed_readers()) std::cout << reader.name << '\n';
    return 0;
  }
  chosen = find(first == "--seeds" && argc == 4 ? argv[2] : first);
  if (chosen == nullptr) {
    std::cerr << "there is no reader " << first << '\n';
    return 2;
  }
  if (first == "--seeds") {
    int number = 0;
    for (const std::string& seed : chosen->seeds())
      std::ofstream(std::string(argv[3]) + "/seed" + std::to_string(number++), std::ios::binary) << seed;
    return 0;
  }
  argv[1] = argv[0];
  --argc;
  ++argv;
  return LLVMFuzzerRunDriver(&argc, &argv, read);
}

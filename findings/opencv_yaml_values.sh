#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Of three lines of plain YAML, OpenCV 4.6.0's FileStorage (Debian's 4.6.0+dfsg-12) makes other values than they say, without an
# error; yaml-cpp 0.7.0, which many calibration tools read the same files with, makes those that they say.
#   - a comment behind a word is part of the word: "model: pinhole  # both cameras";
#   - a negative number behind its type is a list of one positive number: "x: !!float -1.5";
#   - an integer that 32 bits do not hold is another one: "stamp: 3000000000".
set -euo pipefail

version=4.6.0+dfsg-12
install() {
  [[ $(dpkg-query -W -f '${Version}' "$1" 2>/dev/null || true) == "$2" ]] ||
    apt-get install -y --no-install-recommends "$1=$2" >/dev/null
}
install libopencv-core-dev "$version"
install libyaml-cpp-dev 0.7.0+dfsg-8+b1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >values.cpp <<'CPP'
#include <iostream>
#include <opencv2/core.hpp>
#include <yaml-cpp/yaml.h>

int main() {
  const std::string text = "---\nmodel: pinhole  # both cameras\nx: !!float -1.5\nstamp: 3000000000\n";
  const YAML::Node node = YAML::Load(text);
  std::cout << "yaml-cpp: '" << node["model"].as<std::string>() << "', " << node["x"].as<double>() << ", "
            << node["stamp"].as<long>() << "\n";
  const cv::FileStorage file("%YAML:1.0\n" + text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  const cv::FileNode x = file["x"];
  std::cout << "OpenCV " << CV_VERSION << ": '" << static_cast<std::string>(file["model"]) << "', "
            << (x.isSeq() ? "list of " : "") << static_cast<double>(x.isSeq() ? x[0] : x) << ", "
            << static_cast<int>(file["stamp"]) << "\n";
}
CPP
g++ -std=c++17 -I/usr/include/opencv4 values.cpp -o values -lopencv_core -lyaml-cpp
./values >out
cat out
for line in "yaml-cpp: 'pinhole', -1.5, 3000000000" \
  "OpenCV 4.6.0: 'pinhole  # both cameras', list of 1.5, -1294967296"; do
  grep -qF "$line" out || { echo "changed: not seen: $line" && exit 1; }
done

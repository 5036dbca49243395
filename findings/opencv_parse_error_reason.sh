#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# OpenCV 4.6.0 (Debian's 4.6.0+dfsg-12) says where a file of FileStorage is wrong, and why, in the place of its exception's
# function name: cv::Exception::err, where the description of an error is elsewhere, has the name of its own function. A program
# that shows err tells its user "parseValue"; what() has both, in each other's place. YAML, XML and JSON alike.
set -euo pipefail

version=4.6.0+dfsg-12
install() {
  local package
  for package in "$@"; do
    [[ $(dpkg-query -W -f '${Version}' "$package" 2>/dev/null || true) == "$version" ]] ||
      apt-get install -y --no-install-recommends "$package=$version" >/dev/null
  done
}
install libopencv-core-dev
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >reason.cpp <<'CPP'
#include <cstdio>
#include <opencv2/core.hpp>

void show(const char* form, const char* text) {
  try {
    cv::FileStorage file(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    std::printf("%s: read\n", form);
  } catch (const cv::Exception& error) {
    std::printf("%s: err is '%s', func is '%s'\n", form, error.err.c_str(), error.func.c_str());
  }
}

int main() {
  std::printf("OpenCV %s\n", CV_VERSION);
  show("YAML", "%YAML:1.0\n---\nR: [1, 2, 3]\nK: [1, 2\n");
  show("XML", "<?xml version=\"1.0\"?>\n<opencv_storage>\n<K>1</L>\n</opencv_storage>\n");
  show("JSON", "{\n\"K\": [1, 2}\n");
}
CPP
g++ -std=c++17 -I/usr/include/opencv4 reason.cpp -o reason -lopencv_core
./reason 2>/dev/null >out
cat out
for line in "OpenCV 4.6.0" \
  "YAML: err is 'parseValue', func is '(4): Missing , between the elements'" \
  "XML: err is 'parseValue', func is '(3): Mismatched closing tag'" \
  "JSON: err is 'parseSeq', func is '(2): Unexpected character'"; do
  grep -qF "$line" out || { echo "changed: not seen: $line" && exit 1; }
done

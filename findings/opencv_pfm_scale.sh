#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# cv::imread of OpenCV 4.6.0 (Debian's 4.6.0+dfsg-12) divides the values of a portable float map by the size of the scale in its
# header. Middlebury's true disparities of 2014 and later are such maps, in px as they stand in the file, with 1/255 or the like
# there for viewers: their disparities come out 255 times too large, without a word.
set -euo pipefail

version=4.6.0+dfsg-12
install() {
  local package
  for package in "$@"; do
    [[ $(dpkg-query -W -f '${Version}' "$package" 2>/dev/null || true) == "$version" ]] ||
      apt-get install -y --no-install-recommends "$package=$version" >/dev/null
  done
}
install libopencv-imgcodecs-dev
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >pfm.cpp <<'CPP'
#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

int main() {
  std::printf("OpenCV %s\n", CV_VERSION);
  for (const char* scale : {"-1", "-0.5", "-0.003922"}) {
    const float disparities[] = {3, 12};
    std::ofstream file("disp.pfm", std::ios::binary);
    file << "Pf\n2 1\n" << scale << "\n";
    file.write(reinterpret_cast<const char*>(disparities), sizeof disparities);
    file.close();
    const cv::Mat read = cv::imread("disp.pfm", cv::IMREAD_UNCHANGED);
    std::printf("scale %s: 3 and 12 are read as %.1f and %.1f\n", scale, read.at<float>(0, 0),
                read.at<float>(0, 1));
  }
}
CPP
g++ -std=c++17 -I/usr/include/opencv4 pfm.cpp -o pfm -lopencv_imgcodecs -lopencv_core
./pfm >out
cat out
for line in "OpenCV 4.6.0" "scale -1: 3 and 12 are read as 3.0 and 12.0" "scale -0.5: 3 and 12 are read as 6.0 and 24.0" \
  "scale -0.003922: 3 and 12 are read as 764.9 and 3059.7"; do
  grep -qxF "$line" out || { echo "changed: not seen: $line" && exit 1; }
done

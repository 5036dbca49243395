#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Of two cameras above each other, cv::stereoRectify of OpenCV 4.6.0 (Debian's 4.6.0+dfsg-12) leaves the images upright and puts
# the baseline into P2(1,3): disparities are vertical. cv::fisheye::stereoRectify, of the same rig and with the same arguments,
# turns both images by a quarter about the optical axis, so that disparities are horizontal, and puts the baseline into P2(0,3).
# Who takes P2(0,3) != 0 for cameras side by side gets images that lie on their side.
set -euo pipefail

version=4.6.0+dfsg-12
install() {
  local package
  for package in "$@"; do
    [[ $(dpkg-query -W -f '${Version}' "$package" 2>/dev/null || true) == "$version" ]] ||
      apt-get install -y --no-install-recommends "$package=$version" >/dev/null
  done
}
install libopencv-calib3d-dev
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >vertical.cpp <<'CPP'
#include <cmath>
#include <cstdio>
#include <opencv2/calib3d.hpp>

void show(const char* name, const cv::Mat& r1, const cv::Mat& p2) {
  const double turn = std::atan2(r1.at<double>(1, 0), r1.at<double>(0, 0)) * 180 / CV_PI;
  std::printf("%s: turned by %.0f degrees, P2(0,3) %s, P2(1,3) %s\n", name, turn + 0.0,
              p2.at<double>(0, 3) < 0 ? "below 0" : "0", p2.at<double>(1, 3) < 0 ? "below 0" : "0");
}

int main() {
  std::printf("OpenCV %s\n", CV_VERSION);
  const cv::Mat k = (cv::Mat_<double>(3, 3) << 400, 0, 320, 0, 400, 240, 0, 0, 1);
  const cv::Mat d = cv::Mat::zeros(4, 1, CV_64F), r = cv::Mat::eye(3, 3, CV_64F);
  const cv::Mat t = (cv::Mat_<double>(3, 1) << 0, -0.1, 0);  // the second camera is below the first one
  const cv::Size size(640, 480);
  cv::Mat r1, r2, p1, p2, q;
  cv::stereoRectify(k, d, k, d, size, r, t, r1, r2, p1, p2, q, cv::CALIB_ZERO_DISPARITY, 0);
  show("stereoRectify", r1, p2);
  cv::fisheye::stereoRectify(k, d, k, d, size, r, t, r1, r2, p1, p2, q, cv::CALIB_ZERO_DISPARITY);
  show("fisheye::stereoRectify", r1, p2);
}
CPP
g++ -std=c++17 -I/usr/include/opencv4 vertical.cpp -o vertical -lopencv_calib3d -lopencv_core
./vertical >out
cat out
for line in "OpenCV 4.6.0" \
  "stereoRectify: turned by 0 degrees, P2(0,3) 0, P2(1,3) below 0" \
  "fisheye::stereoRectify: turned by -90 degrees, P2(0,3) below 0, P2(1,3) 0"; do
  grep -qxF "$line" out || { echo "changed: not seen: $line" && exit 1; }
done

// SPDX-License-Identifier: Apache-2.0
// Inputs that the readers understand, made here: what is changed in a thousand ways.
#pragma once

#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "modules/map_codec.hpp"
#include "modules/map_file.hpp"
#include "platform/images/image_codecs.hpp"
#include "tests/cli/program.hpp"
#include "tests/paths.hpp"
#include "tests/platform/zip_bytes.hpp"

namespace parallax::test {

inline std::string content_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline std::string text_of(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

inline std::vector<std::string> preset_seeds() {
  return {content_of(source_path("platform/presets/scenescan-pro.toml")),
          "inherits = \"scenescan-pro\"\ndescription = \"d\"\ncamera.row_blanking = 3\n[matching]\np2 = { "
          "value = "
          "40, tag = \"S\", "
          "source = \"s\" }\npaths = \"w, nw, n\"\n[clocks]\ncore_hz = 1e8\n[memory]\nmodel = \"dram\"\n"};
}

inline std::vector<std::string> assignment_seeds() {
  return {"matching.p1=3",
          "clocks.core_hz=1e8",
          "matching.paths=w,n",
          "memory.device=ddr3-1066-x32",
          "matching.p2={value = 40, tag = \"S\", source = \"s\"}",
          "streams.left_output.kind=\"block_ram\""};
}

inline std::vector<std::string> device_seeds() {
  return {content_of(source_path("platform/presets/memory/ddr3-1066-x32.toml"))};
}

inline std::vector<std::string> row_seeds() {
  return {content_of(source_path("platform/presets/validation/other-designs.toml")),
          "[[row]]\nname = \"a\"\nsource = \"b\"\nsize = \"64x48\"\nmetric = \"frame_time\"\nunit = "
          "\"ms\"\nleast = -1\n"
          "most = 1\npublished = 3.5\nset = [\"matching.iterations=8\"]\n"};
}

inline std::vector<std::string> raw_map_seeds() {
  std::vector<std::string> seeds;
  for (const char* format : {".yml", ".json", ".xml"}) {
    cv::FileStorage file(format, cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
    for (const char* name : {"left_x", "left_y", "right_x", "right_y"})
      file << name << cv::Mat(3, 4, CV_32F, cv::Scalar(1.5));
    seeds.push_back(file.releaseAndGetString());
  }
  return seeds;
}

inline std::vector<std::string> list_seeds() {
  return {"# a pair\nl.png r.png\n\n\"l.png\" r.png # the same\n"};
}

inline std::vector<std::string> map_seeds() {
  RectificationMap map = identity_map(48, 6, OffsetRange{});
  std::vector<std::string> seeds{text_of(to_file_bytes(encode(map)))};
  int value = 0;
  for (OffsetPair& pair : map.offsets) {
    value = (value * 31 + 7) % 101;
    pair.left.dx = static_cast<std::int16_t>(value - 50);
    pair.right.dy = static_cast<std::int16_t>(50 - value);
  }
  seeds.push_back(text_of(to_file_bytes(encode(map))));
  return seeds;
}

inline cv::Mat picture(int type) {
  cv::Mat image(8, 16, type);
  cv::RNG random(3);
  random.fill(image, cv::RNG::UNIFORM, 0, 200);
  return image;
}

inline std::vector<std::string> image_seeds() {
  return {text_of(encode_image(".png", picture(CV_8UC1))), text_of(encode_image(".png", picture(CV_16UC1))),
          text_of(encode_image(".png", picture(CV_8UC3))), text_of(encode_image(".pgm", picture(CV_8UC1))),
          text_of(encode_image(".bmp", picture(CV_8UC3)))};
}

// 16x8 floats as a portable float map and as an array of NumPy, both little-endian, also in an archive.
inline std::vector<std::string> truth_seeds() {
  const cv::Mat image = picture(CV_32FC1);
  const std::string values(reinterpret_cast<const char*>(image.data), image.total() * image.elemSize());
  const std::string layout = "{'descr': '<f4', 'fortran_order': False, 'shape': (8, 16), }\n";
  const std::string array =
      std::string("\x93NUMPY\x01") + '\0' + static_cast<char>(layout.size()) + '\0' + layout + values;
  return {text_of(encode_image(".png", picture(CV_16UC1))),
          text_of(encode_image(".png", picture(CV_8UC1))),
          text_of(encode_image(".tif", image)),
          "Pf\n16 8\n-1.0\n" + values,
          array,
          zip_of({{"disp.npy", array}, {"mask.npy", array}})};
}

inline std::vector<std::string> trace_seeds() {
  return {"time_ns,rw,addr,bytes\n0,R,0x0,64\n1.5,W,4096,64\r\n2e3,r,0x7fffffff,1048576\n\n",
          "# Ramulator\n0x1234 R\n0x40 W\n", "LD 0x1234\nST 4096\n", "0x1234 READ 10\n0x40 WRITE 12\n",
          "# DRAMSys\n10: read 0x1234\n12: (64) write 0x40 0011\n"};
}

inline std::vector<std::string> manifest_seeds() {
  const Program program;
  program("vectors -q --stage matching --out out --size 64x48 -d 32");
  return {program.read("out/manifest.json")};
}

inline std::vector<std::string> fifo_seeds() {
  return {
      "rst,write_valid,write_ready,read_valid,read_ready\n1,0,0,0,0\n0,1,1,0,1\n0,1,0,1,0\n0,1,0,1,1\n0,1,1,"
      "0,1\n0,0,0,1,1\n",
      "$scope module b $end\n$var wire 1 ! write_clk $end\n$var wire 1 % read_clk $end\n$var wire 1 # wr_en "
      "$end\n"
      "$var wire 1 $ full $end\n$var wire 1 & rd_en $end\n$var wire 1 ' empty $end\n$upscope $end\n"
      "$enddefinitions $end\n#0 0! 0% 1# 0$ 1& 1'\n#3 1%\n#5 1! 0%\n#6 0# 1$ 1% 0'\n#10 0! 0%\n#12 1% "
      "1'\n#15 1!\n#16 0$\n"};
}

inline std::vector<std::string> dump_seeds() {
  return {"// 0x0\n0001 7_fff\n@2 xz0 /* end */\n", "cycle,code,cause\n1,12,-4\n2,0xfff,x\n",
          "data\n0x7fff\n1\n",
          "$timescale 1ns $end $scope module b $end\n$var wire 1 ! clk $end\n$var wire 15 # out_left_data "
          "[14:0] $end\n"
          "$var wire 1 $ out_left_valid $end\n$var real 64 r r $end\n$upscope $end $enddefinitions $end\n#0\n"
          "$dumpvars 0! b101 # 1$ $end\n#5 1!\n#10 0! bx1 #\nr1.5 r\n#15 1!\n"};
}

inline std::vector<std::string> result_seeds() {
  const Program program;
  program("run -q --timing-only --no-verdict --out out --size 64x48 -d 32");
  return {program.read("out/timing.json")};
}

}  // namespace parallax::test

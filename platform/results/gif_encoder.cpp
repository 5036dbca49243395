// SPDX-License-Identifier: Apache-2.0
#include "platform/results/gif_encoder.hpp"

#include <gif_lib.h>

#include <array>
#include <new>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <utility>

namespace parallax {
namespace {

/// The loop count of the extension that browsers follow: 0, for ever.
constexpr std::array<GifByteType, 3> kLoopForEver{1, 0, 0};

[[noreturn]] void fail(int error) {
  const char* const text = GifErrorString(error);
  throw std::runtime_error(std::string("GIF encoder failed: ") + (text ? text : "unknown error"));
}

/// C calls it: no exception may leave it.
int append(GifFileType* gif, const GifByteType* bytes, int count) {
  try {
    static_cast<std::string*>(gif->UserData)->append(reinterpret_cast<const char*>(bytes), count);
    return count;
  } catch (const std::bad_alloc&) {
    return 0;
  }
}

}  // namespace

GifEncoder::GifEncoder(const cv::Size& canvas, const std::vector<cv::Vec3b>& palette) {
  const int count = static_cast<int>(palette.size());
  // The format knows powers of two only; the rest stays black.
  const std::unique_ptr<ColorMapObject, decltype(&GifFreeMapObject)> map(
      GifMakeMapObject(1 << GifBitSize(count), nullptr), &GifFreeMapObject);
  if (!map) throw std::bad_alloc();
  for (int i = 0; i < count; ++i) {
    const cv::Vec3b& bgr = palette[i];
    map->Colors[i] = {bgr[2], bgr[1], bgr[0]};
  }
  int error = E_GIF_SUCCEEDED;
  gif_.reset(EGifOpen(&bytes_, append, &error));
  if (!gif_) fail(error);
  EGifSetGifVersion(gif_.get(), true);  // GIF89a: the older one has no animations
  check(EGifPutScreenDesc(gif_.get(), canvas.width, canvas.height, 8, 0, map.get()));
  check(EGifPutExtensionLeader(gif_.get(), APPLICATION_EXT_FUNC_CODE));
  check(EGifPutExtensionBlock(gif_.get(), 11, "NETSCAPE2.0"));
  check(EGifPutExtensionBlock(gif_.get(), static_cast<int>(kLoopForEver.size()), kLoopForEver.data()));
  check(EGifPutExtensionTrailer(gif_.get()));
}

void GifEncoder::Close::operator()(GifFileType* gif) const { EGifCloseFile(gif, nullptr); }

void GifEncoder::check(int result) const {
  if (result == GIF_ERROR) fail(gif_->Error);
}

std::string GifEncoder::frame(const cv::Mat& indices, int centiseconds) {
  const GraphicsControlBlock control{DISPOSE_DO_NOT, false, centiseconds, NO_TRANSPARENT_COLOR};
  std::array<GifByteType, 4> extension{};
  EGifGCBToExtension(&control, extension.data());
  check(EGifPutExtension(gif_.get(), GRAPHICS_EXT_FUNC_CODE, static_cast<int>(extension.size()),
                         extension.data()));
  check(EGifPutImageDesc(gif_.get(), 0, 0, indices.cols, indices.rows, false, nullptr));
  std::vector<GifPixelType> line;  // giflib wants one that it may change
  for (int y = 0; y < indices.rows; ++y) {
    line.assign(indices.ptr(y), indices.ptr(y) + indices.cols);
    check(EGifPutLine(gif_.get(), line.data(), indices.cols));
  }
  return std::exchange(bytes_, {});
}

std::string GifEncoder::end() {
  int error = E_GIF_SUCCEEDED;
  if (EGifCloseFile(gif_.release(), &error) == GIF_ERROR) fail(error);
  return std::exchange(bytes_, {});
}

}  // namespace parallax

#include "ar/track/grey.h"

#include <cstdlib>

namespace ar {

cv::Mat grey8(const Frame& frame, cv::Mat& room) {
  const int width = frame.format.width;
  const int height = frame.format.height;
  const int type = frame.format.bit_depth > 8 ? CV_16UC1 : CV_8UC1;
  const auto plane = [&](std::size_t i) {
    const std::ptrdiff_t stride = frame.stride_bytes[i];
    const bool upward = stride < 0;  // rows lie from the last to the first; OpenCV and the library want them in order
    // OpenCV has no view of constant memory; nothing below writes through it.
    auto* first = const_cast<std::uint8_t*>(frame.plane[i] + (upward ? stride * (height - 1) : 0));
    const cv::Mat view(height, width, type, first, static_cast<std::size_t>(std::abs(stride)));
    if (!upward) return view;
    cv::Mat in_order;
    cv::flip(view, in_order, 0);
    return in_order;
  };
  const double to_8_bit = 1.0 / (1 << (frame.format.bit_depth - 8));
  if (frame.format.color.matrix != ColorMatrix::Rgb) {
    if (type == CV_8UC1) return plane(0);
    plane(0).convertTo(room, CV_8U, to_8_bit);
    return room;
  }
  cv::Mat sum;  // luma of BT.601 from planes G, B, R: contrast is what counts here, not colour
  cv::addWeighted(plane(0), 0.587 * to_8_bit, plane(1), 0.114 * to_8_bit, 0.0, sum, CV_32F);
  cv::addWeighted(sum, 1.0, plane(2), 0.299 * to_8_bit, 0.0, room, CV_8U);
  return room;
}

}  // namespace ar

#include "ar/capture/ffmpeg.h"

#include <spdlog/spdlog.h>

#include <array>
#include <cstdarg>
#include <mutex>
#include <new>

namespace ar::ffmpeg {
namespace {

std::string& complaint() {
  thread_local std::string text;
  return text;
}

void log_callback(void* context, int level, const char* format, va_list arguments) {
  if (level > AV_LOG_WARNING) return;
  std::array<char, 512> line{};
  int print_prefix = 1;
  va_list copy;
  va_copy(copy, arguments);
  const int length = vsnprintf(line.data(), line.size(), format, copy);
  va_end(copy);
  if (length <= 0) return;
  std::string message(line.data());
  while (!message.empty() && (message.back() == '\n' || message.back() == '\r')) message.pop_back();
  if (level <= AV_LOG_ERROR && !message.empty()) complaint() = message;
  av_log_format_line2(context, level, format, arguments, line.data(), static_cast<int>(line.size()), &print_prefix);
  std::string prefixed(line.data());
  while (!prefixed.empty() && (prefixed.back() == '\n' || prefixed.back() == '\r')) prefixed.pop_back();
  spdlog::debug("FFmpeg: {}", prefixed);
}

}  // namespace

FramePtr make_frame() {
  FramePtr frame(av_frame_alloc());
  if (!frame) throw std::bad_alloc();
  return frame;
}

PacketPtr make_packet() {
  PacketPtr packet(av_packet_alloc());
  if (!packet) throw std::bad_alloc();
  return packet;
}

FramePtr share_frame(const AVFrame& frame) {
  FramePtr shared(av_frame_clone(&frame));
  if (!shared) throw std::bad_alloc();
  return shared;
}

std::string value_of(const AVDictionary* dict, const std::string& key) {
  const AVDictionaryEntry* entry = av_dict_get(dict, key.c_str(), nullptr, 0);
  return entry != nullptr ? entry->value : "";
}

std::string error_text(int code) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  return text.data();
}

void route_log() {
  static std::once_flag once;
  std::call_once(once, [] { av_log_set_callback(log_callback); });
}

std::string last_complaint() {
  return std::exchange(complaint(), {});
}

}  // namespace ar::ffmpeg

#pragma once

// FFmpeg's handles as move-only owners, and its return codes as text: shared by ar/capture and ar/output, included by
// no public header.

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavfilter/avfilter.h>
#include <libavformat/avformat.h>
#include <libavutil/buffer.h>
#include <libavutil/dict.h>
#include <libavutil/frame.h>
}

#include <memory>
#include <string>
#include <utility>

namespace ar::ffmpeg {

struct FrameDeleter {
  void operator()(const AVFrame* frame) const {
    auto* mine = const_cast<AVFrame*>(frame);
    av_frame_free(&mine);
  }
};
struct PacketDeleter {
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};
struct CodecDeleter {
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
};
struct DemuxerDeleter {
  void operator()(AVFormatContext* context) const { avformat_close_input(&context); }
};
// Closes the muxer's file too, ignoring errors: whoever wants to know them closes the file first.
struct MuxerDeleter {
  void operator()(AVFormatContext* context) const {
    if (context->pb != nullptr) avio_closep(&context->pb);
    avformat_free_context(context);
  }
};
struct FilterGraphDeleter {
  void operator()(AVFilterGraph* graph) const { avfilter_graph_free(&graph); }
};
struct BufferDeleter {
  void operator()(AVBufferRef* buffer) const { av_buffer_unref(&buffer); }
};
struct BufferPoolDeleter {
  void operator()(AVBufferPool* pool) const { av_buffer_pool_uninit(&pool); }
};

using FramePtr = std::unique_ptr<AVFrame, FrameDeleter>;
using PacketPtr = std::unique_ptr<AVPacket, PacketDeleter>;
using CodecPtr = std::unique_ptr<AVCodecContext, CodecDeleter>;
using DemuxerPtr = std::unique_ptr<AVFormatContext, DemuxerDeleter>;
using MuxerPtr = std::unique_ptr<AVFormatContext, MuxerDeleter>;
using FilterGraphPtr = std::unique_ptr<AVFilterGraph, FilterGraphDeleter>;
using BufferPtr = std::unique_ptr<AVBufferRef, BufferDeleter>;
using BufferPoolPtr = std::unique_ptr<AVBufferPool, BufferPoolDeleter>;

// Throw std::bad_alloc when memory is out.
FramePtr make_frame();
PacketPtr make_packet();
// A second owner of the same pixels; properties (timestamp, tags, side data) are copied.
FramePtr share_frame(const AVFrame& frame);

// A set of options for FFmpeg's calls, which eat the entries they know.
class Dictionary {
 public:
  Dictionary() = default;
  Dictionary(Dictionary&& other) noexcept : dict_(std::exchange(other.dict_, nullptr)) {}
  Dictionary& operator=(Dictionary&&) = delete;
  ~Dictionary() { av_dict_free(&dict_); }

  void set(const std::string& key, const std::string& value) { av_dict_set(&dict_, key.c_str(), value.c_str(), 0); }
  AVDictionary** out() { return &dict_; }

 private:
  AVDictionary* dict_ = nullptr;
};

// The value of `key` in any case of letters, or an empty string.
std::string value_of(const AVDictionary* dict, const std::string& key);

// What a negative return code means: "No space left on device".
std::string error_text(int code);

// Sends FFmpeg's own messages through spdlog (its errors at level debug, since every failed call is reported by us)
// and keeps the last error of this thread for last_complaint(). Idempotent and thread-safe.
void route_log();
// What FFmpeg said last on this thread about the failure at hand ("moov atom not found"), or empty; forgets it.
std::string last_complaint();

}  // namespace ar::ffmpeg

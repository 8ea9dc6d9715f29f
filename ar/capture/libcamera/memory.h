#pragma once

#include <libcamera/libcamera.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ar/capture/live/mapped_memory.h"

namespace ar::lc {

// One buffer of the camera's in our memory: where each of its planes begins.
struct MappedBuffer {
  std::unique_ptr<MappedMemory> memory;  // all planes, which share one file
  std::vector<std::size_t> offsets;
  int descriptor = -1;
};

// `name` is the camera's, for errors. Throws InputError.
MappedBuffer map(const libcamera::FrameBuffer& buffer, const std::string& name);

// The time in which the processor reads a buffer that the camera wrote; matters where caches do not know of each other.
class Reading {
 public:
  explicit Reading(int descriptor);
  ~Reading();
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

 private:
  void mark(std::uint64_t end) const;

  int descriptor_;
};

}  // namespace ar::lc

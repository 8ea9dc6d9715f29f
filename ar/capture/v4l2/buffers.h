#pragma once

#include <linux/videodev2.h>

#include <memory>
#include <span>
#include <vector>

#include "ar/capture/ffmpeg.h"
#include "ar/capture/v4l2/device.h"

namespace ar::v4l2 {

// What the driver filled.
struct Filled {
  v4l2_buffer about{};                          // sequence, timestamp, flags
  std::vector<std::span<std::uint8_t>> planes;  // the bytes, in one piece of memory or in one for each plane
  ffmpeg::BufferPtr memory;  // keeps all of them; letting go of the last reference gives the buffer back to the driver
};

// The memory-mapped buffers of one capture stream, between the driver and whoever holds their pictures. Buffers on loan
// stay readable after the stream ended: the device is free for others then, the memory goes with the last holder.
class CaptureBuffers {
 public:
  // Asks the driver for `count` buffers, hands them all over and starts the stream. Throws InputError.
  CaptureBuffers(std::shared_ptr<const Device> device, unsigned count);
  ~CaptureBuffers();
  CaptureBuffers(const CaptureBuffers&) = delete;
  CaptureBuffers& operator=(const CaptureBuffers&) = delete;

  // Takes the oldest filled buffer. Returns 0, EAGAIN where there is none, or another errno: the stream is over.
  int take(Filled& filled);
  // Hands over again what the driver refused when it was given back. To be called now and then.
  void retry();
  // Buffers that neither the driver nor this has.
  unsigned on_loan() const;
  unsigned count() const;

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

}  // namespace ar::v4l2

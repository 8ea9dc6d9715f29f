#include "ar/capture/libcamera/memory.h"

#include <fmt/format.h>
#include <linux/dma-buf.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <system_error>

#include "ar/error.h"

namespace ar::lc {

MappedBuffer map(const libcamera::FrameBuffer& buffer, const std::string& name) {
  MappedBuffer mapped;
  std::size_t length = 0;
  const auto& planes = buffer.planes();
  mapped.descriptor = planes.front().fd.get();
  for (const auto& plane : planes) {
    if (plane.fd.get() != mapped.descriptor) {
      throw InputError(
          fmt::format("cannot use {}: the planes of its pictures lie in separate memory\nAsk for a packed "
                      "format (YUYV, RGB3).",
                      name));
    }
    const std::size_t offset = plane.offset == libcamera::FrameBuffer::Plane::kInvalidOffset ? 0 : plane.offset;
    mapped.offsets.push_back(offset);
    length = std::max(length, offset + plane.length);
  }
  try {
    mapped.memory = std::make_unique<MappedMemory>(mapped.descriptor, length, 0);
  } catch (const std::system_error& error) {
    throw InputError(fmt::format("cannot use {}: {}\nPlug it in again.", name, error.what()));
  }
  return mapped;
}

Reading::Reading(int descriptor) : descriptor_(descriptor) {
  mark(DMA_BUF_SYNC_START);
}

Reading::~Reading() {
  mark(DMA_BUF_SYNC_END);
}

void Reading::mark(std::uint64_t end) const {
  dma_buf_sync sync{end | DMA_BUF_SYNC_READ};
  ioctl(descriptor_, DMA_BUF_IOCTL_SYNC, &sync);  // memory of another kind needs no such thing and says so
}

}  // namespace ar::lc

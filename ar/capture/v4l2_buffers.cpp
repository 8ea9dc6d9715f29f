#include "ar/capture/v4l2_buffers.h"

#include <mutex>
#include <new>
#include <system_error>
#include <vector>

#include "ar/capture/mapped_memory.h"
#include "ar/error.h"

namespace ar::v4l2 {
namespace {

v4l2_buffer numbered(std::uint32_t index) {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

std::shared_ptr<const MappedMemory> map(const Device& device, const v4l2_buffer& buffer) {
  try {
    return std::make_shared<const MappedMemory>(device.descriptor(), buffer.length, buffer.m.offset);
  } catch (const std::system_error& error) {
    throw InputError(explain(device.node(), "mmap", error.code().value()));
  }
}

}  // namespace

struct CaptureBuffers::Shared {
  mutable std::mutex mutex;
  std::shared_ptr<const Device> device;  // empty once the stream ended
  std::vector<std::shared_ptr<const MappedMemory>> mappings;
  std::vector<std::uint32_t> refused;  // given back, but not taken by the driver
  unsigned on_loan = 0;

  int hand_over(std::uint32_t index) const {
    v4l2_buffer buffer = numbered(index);
    return device->call(VIDIOC_QBUF, &buffer);
  }

  void give_back(std::uint32_t index) {
    const std::lock_guard lock(mutex);
    --on_loan;
    if (device && hand_over(index) != 0) refused.push_back(index);
  }
};

namespace {

// A picture's hold on its buffer; the mapping goes last, after the stream too.
template <typename Shared>
struct Loan {
  std::shared_ptr<const MappedMemory> mapping;
  std::shared_ptr<Shared> shared;
  std::uint32_t index;

  static void end(void* opaque, std::uint8_t* /*data*/) {
    const std::unique_ptr<Loan> loan(static_cast<Loan*>(opaque));
    loan->shared->give_back(loan->index);
  }
};

}  // namespace

CaptureBuffers::CaptureBuffers(std::shared_ptr<const Device> device, unsigned count)
    : shared_(std::make_shared<Shared>()) {
  shared_->device = std::move(device);
  const Device& camera = *shared_->device;
  v4l2_requestbuffers request{};
  request.count = count;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  camera.require(VIDIOC_REQBUFS, &request, "VIDIOC_REQBUFS");
  for (std::uint32_t i = 0; i < request.count; ++i) {
    v4l2_buffer buffer = numbered(i);
    camera.require(VIDIOC_QUERYBUF, &buffer, "VIDIOC_QUERYBUF");
    shared_->mappings.push_back(map(camera, buffer));
    buffer = numbered(i);
    camera.require(VIDIOC_QBUF, &buffer, "VIDIOC_QBUF");
  }
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  camera.require(VIDIOC_STREAMON, &type, "VIDIOC_STREAMON");
}

CaptureBuffers::~CaptureBuffers() {
  const std::lock_guard lock(shared_->mutex);
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  shared_->device->call(VIDIOC_STREAMOFF, &type);
  shared_->mappings.clear();
  // Loans keep the node's file open, and with it the driver's idea of who owns the queue: give that up by name.
  v4l2_requestbuffers none{};
  none.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  none.memory = V4L2_MEMORY_MMAP;
  shared_->device->call(VIDIOC_REQBUFS, &none);
  shared_->device.reset();
}

int CaptureBuffers::take(Filled& filled) {
  const std::lock_guard lock(shared_->mutex);
  v4l2_buffer buffer = numbered(0);
  if (const int error = shared_->device->call(VIDIOC_DQBUF, &buffer); error != 0) return error;
  filled.about = buffer;
  const std::shared_ptr<const MappedMemory>& mapping = shared_->mappings.at(buffer.index);
  auto loan = std::make_unique<Loan<Shared>>(Loan<Shared>{mapping, shared_, buffer.index});
  filled.memory.reset(
      av_buffer_create(mapping->data(), mapping->length(), Loan<Shared>::end, loan.get(), AV_BUFFER_FLAG_READONLY));
  if (!filled.memory) throw std::bad_alloc();
  static_cast<void>(loan.release());
  ++shared_->on_loan;
  return 0;
}

void CaptureBuffers::retry() {
  const std::lock_guard lock(shared_->mutex);
  std::erase_if(shared_->refused, [&](std::uint32_t index) { return shared_->hand_over(index) == 0; });
}

unsigned CaptureBuffers::on_loan() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->on_loan;
}

unsigned CaptureBuffers::count() const {
  return static_cast<unsigned>(shared_->mappings.size());
}

}  // namespace ar::v4l2

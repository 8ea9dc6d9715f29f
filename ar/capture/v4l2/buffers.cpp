#include "ar/capture/v4l2/buffers.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <new>
#include <system_error>
#include <vector>

#include "ar/capture/live/mapped_memory.h"
#include "ar/error.h"

namespace ar::v4l2 {
namespace {

using Mappings = std::vector<std::shared_ptr<const MappedMemory>>;  // of one buffer, one for each plane of memory

// A buffer as the driver is told and asked of it, with its planes where it has several.
struct Numbered {
  Numbered(std::uint32_t type, std::uint32_t index) {
    buffer.type = type;
    buffer.memory = V4L2_MEMORY_MMAP;
    buffer.index = index;
    if (!V4L2_TYPE_IS_MULTIPLANAR(type)) return;
    buffer.m.planes = planes.data();
    buffer.length = static_cast<std::uint32_t>(planes.size());
  }
  Numbered(const Numbered&) = delete;
  Numbered& operator=(const Numbered&) = delete;

  v4l2_buffer buffer{};
  std::array<v4l2_plane, VIDEO_MAX_PLANES> planes{};
};

std::shared_ptr<const MappedMemory> map(const Device& device, std::size_t length, off_t offset) {
  try {
    return std::make_shared<const MappedMemory>(device.descriptor(), length, offset);
  } catch (const std::system_error& error) {
    throw InputError(explain(device.node(), "mmap", error.code().value()));
  }
}

Mappings map(const Device& device, const Numbered& of) {
  const v4l2_buffer& buffer = of.buffer;
  if (!V4L2_TYPE_IS_MULTIPLANAR(buffer.type)) return {map(device, buffer.length, buffer.m.offset)};
  Mappings mappings;
  for (std::uint32_t i = 0; i < buffer.length; ++i) {
    mappings.push_back(map(device, of.planes.at(i).length, of.planes.at(i).m.mem_offset));
  }
  return mappings;
}

// What was filled of each plane.
std::vector<std::span<std::uint8_t>> filled_planes(const Numbered& of, const Mappings& mappings) {
  if (!V4L2_TYPE_IS_MULTIPLANAR(of.buffer.type)) {
    const MappedMemory& memory = *mappings.front();
    return {{memory.data(), std::min<std::size_t>(of.buffer.bytesused, memory.length())}};
  }
  std::vector<std::span<std::uint8_t>> planes;
  for (std::size_t i = 0; i < mappings.size(); ++i) {
    // bytesused counts what lies before the data, too.
    const std::size_t end = std::min<std::size_t>(of.planes.at(i).bytesused, mappings[i]->length());
    const std::size_t begin = std::min<std::size_t>(of.planes.at(i).data_offset, end);
    planes.emplace_back(mappings[i]->data() + begin, end - begin);
  }
  return planes;
}

}  // namespace

struct CaptureBuffers::Shared {
  mutable std::mutex mutex;
  std::shared_ptr<const Device> device;  // empty once the stream ended
  std::uint32_t type = 0;                // of its buffers
  std::vector<Mappings> mappings;
  std::vector<std::uint32_t> refused;  // given back, but not taken by the driver
  unsigned on_loan = 0;

  int hand_over(std::uint32_t index) const {
    Numbered of(type, index);
    return device->call(VIDIOC_QBUF, &of.buffer);
  }

  void give_back(std::uint32_t index) {
    const std::lock_guard lock(mutex);
    --on_loan;
    if (device && hand_over(index) != 0) refused.push_back(index);
  }
};

namespace {

// A picture's hold on its buffer; the memory goes last, after the stream too.
template <typename Shared>
struct Loan {
  Mappings mappings;
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
  shared_->type = camera.capture_type();
  v4l2_requestbuffers request{};
  request.count = count;
  request.type = shared_->type;
  request.memory = V4L2_MEMORY_MMAP;
  camera.require(VIDIOC_REQBUFS, &request, "VIDIOC_REQBUFS");
  for (std::uint32_t i = 0; i < request.count; ++i) {
    Numbered asked(shared_->type, i);
    camera.require(VIDIOC_QUERYBUF, &asked.buffer, "VIDIOC_QUERYBUF");
    shared_->mappings.push_back(map(camera, asked));
    Numbered given(shared_->type, i);
    camera.require(VIDIOC_QBUF, &given.buffer, "VIDIOC_QBUF");
  }
  camera.require(VIDIOC_STREAMON, &shared_->type, "VIDIOC_STREAMON");
}

CaptureBuffers::~CaptureBuffers() {
  const std::lock_guard lock(shared_->mutex);
  shared_->device->call(VIDIOC_STREAMOFF, &shared_->type);
  shared_->mappings.clear();
  // Loans keep the node's file open, and with it the driver's idea of who owns the queue: give that up by name.
  v4l2_requestbuffers none{};
  none.type = shared_->type;
  none.memory = V4L2_MEMORY_MMAP;
  shared_->device->call(VIDIOC_REQBUFS, &none);
  shared_->device.reset();
}

int CaptureBuffers::take(Filled& filled) {
  const std::lock_guard lock(shared_->mutex);
  Numbered of(shared_->type, 0);
  if (const int error = shared_->device->call(VIDIOC_DQBUF, &of.buffer); error != 0) return error;
  const Mappings& mappings = shared_->mappings.at(of.buffer.index);
  filled.planes = filled_planes(of, mappings);
  filled.about = of.buffer;
  filled.about.m = {};  // its planes are gone with `of`
  auto loan = std::make_unique<Loan<Shared>>(Loan<Shared>{mappings, shared_, of.buffer.index});
  const MappedMemory& first = *mappings.front();
  filled.memory.reset(
      av_buffer_create(first.data(), first.length(), Loan<Shared>::end, loan.get(), AV_BUFFER_FLAG_READONLY));
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

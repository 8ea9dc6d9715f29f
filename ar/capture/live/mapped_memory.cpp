#include "ar/capture/live/mapped_memory.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace ar {
namespace {

std::size_t with_a_page_more(std::size_t length) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return (length + page - 1) / page * page + page;
}

}  // namespace

MappedMemory::MappedMemory(int descriptor, std::size_t length, off_t offset, Access access)
    : length_(length),
      reserved_(with_a_page_more(length)),
      start_(mmap(nullptr, reserved_, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)) {
  if (start_ == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "mmap");
  const int protection = access == Access::Read ? PROT_READ : PROT_READ | PROT_WRITE;
  if (mmap(start_, length_, protection, MAP_SHARED | MAP_FIXED, descriptor, offset) == MAP_FAILED) {
    const int error = errno;
    munmap(start_, reserved_);
    throw std::system_error(error, std::generic_category(), "mmap");
  }
}

MappedMemory::~MappedMemory() {
  munmap(start_, reserved_);
}

}  // namespace ar

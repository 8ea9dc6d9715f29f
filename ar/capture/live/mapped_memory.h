#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>

namespace ar {

// A device's memory in ours, with a page of zeros behind it: encoders and scalers read whole vectors, past
// a picture's end too.
class MappedMemory {
 public:
  enum class Access { Read, ReadAndWrite };
  // Throws std::system_error.
  MappedMemory(int descriptor, std::size_t length, off_t offset, Access access = Access::Read);
  ~MappedMemory();
  MappedMemory(const MappedMemory&) = delete;
  MappedMemory& operator=(const MappedMemory&) = delete;

  std::uint8_t* data() const { return static_cast<std::uint8_t*>(start_); }
  std::size_t length() const { return length_; }

 private:
  std::size_t length_;
  std::size_t reserved_;
  void* start_;
};

}  // namespace ar

#include "render/base/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <system_error>

namespace render {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }
  // Closes now, because a full disk may be reported as late as here.
  int close() {
    const int fd = fd_;
    fd_ = -1;
    return ::close(fd);
  }

 private:
  int fd_;
};

[[noreturn]] void fail(const char* what, const std::filesystem::path& path, int error) {
  throw std::runtime_error(std::string("cannot ") + what + " '" + path.string() +
                           "': " + std::generic_category().message(error));
}

// Where the file system cannot rename without replacing, the name is claimed first: an empty file that is made here
// only if there was none, and that the finished one then replaces.
int rename_claiming(const std::filesystem::path& from, const std::filesystem::path& to) {
  const Descriptor claim(::open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (claim.get() < 0) return -1;
  if (::rename(from.c_str(), to.c_str()) == 0) return 0;
  const int error = errno;
  ::unlink(to.c_str());
  errno = error;
  return -1;
}

int rename_keeping(const std::filesystem::path& from, const std::filesystem::path& to) {
  const int done = ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE);
  if (done == 0 || (errno != EINVAL && errno != ENOSYS)) return done;
  return rename_claiming(from, to);
}

void write_all(const std::filesystem::path& temporary, std::span<const std::uint8_t> bytes) {
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.get() < 0) fail("write", temporary, errno);
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("write", temporary, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  if (::fsync(file.get()) != 0 && errno != EINVAL) fail("write", temporary, errno);
  if (file.close() != 0) fail("write", temporary, errno);
}

}  // namespace

Bytes read_file(const std::filesystem::path& path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) fail("read", path, errno);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail("read", path, errno);
  if (S_ISDIR(status.st_mode)) fail("read", path, EISDIR);
  Bytes bytes;
  std::uint8_t block[1 << 16];
  for (;;) {
    const ssize_t got = ::read(file.get(), block, sizeof block);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("read", path, errno);
    if (got == 0) return bytes;
    bytes.insert(bytes.end(), block, block + got);
  }
}

void rename_whole(const std::filesystem::path& from, const std::filesystem::path& to, Existing existing) {
  const int done = existing == Existing::Keep ? rename_keeping(from, to) : ::rename(from.c_str(), to.c_str());
  if (done != 0) throw std::system_error(errno, std::generic_category(), "cannot write '" + to.string() + "'");
}

void write_file_whole(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, Existing existing) {
  std::filesystem::path temporary = path;
  temporary += ".";
  temporary += std::to_string(::getpid());
  temporary += ".part";
  try {
    write_all(temporary, bytes);
    rename_whole(temporary, path, existing);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

}  // namespace render

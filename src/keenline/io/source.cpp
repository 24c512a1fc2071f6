#include "keenline/io/source.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "keenline/errors.h"

namespace keenline {
namespace {

/// Closes a descriptor when it goes out of scope; one opened for reading has nothing to report on closing.
struct Descriptor {
  int number;
  explicit Descriptor(int n) : number(n) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

std::string_view kind_of_file(mode_t mode) {
  if (S_ISDIR(mode)) return "is a folder";
  if (S_ISFIFO(mode)) return "is a pipe";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "is a device";
  if (S_ISSOCK(mode)) return "is a socket";
  return "is not a regular file";
}

int open_retrying(const char* path) {
  int fd = -1;
  // O_NONBLOCK: opening a pipe must not wait for a writer.
  do fd = ::open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  while (fd < 0 && errno == EINTR);
  return fd;
}

}  // namespace

MappedFile::MappedFile(const std::string& path) : path_(path) {
  if (path.find('\0') != std::string::npos)
    throw InputError(path, "cannot be opened: the name holds a zero byte");
  const Descriptor file(open_retrying(path.c_str()));
  if (file.number < 0) throw InputError(path, "cannot be opened: " + system_message(errno));
  struct stat status {};
  if (::fstat(file.number, &status) != 0)
    throw InputError(path, "cannot be examined: " + system_message(errno));
  if (!S_ISREG(status.st_mode))
    throw InputError(path, std::string(kind_of_file(status.st_mode)) + ", expected a file");
  size_ = static_cast<std::size_t>(status.st_size);
  if (size_ == 0) return;
  void* memory = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.number, 0);
  if (memory == MAP_FAILED) {
    if (errno == ENOMEM) throw OutOfMemory(escaped(path, 4096) + ": no address space left to map the file");
    throw InputError(path, "cannot be read: " + system_message(errno));
  }
  // Advice only: where the kernel declines it, reading is merely slower.
  (void)::madvise(memory, size_, MADV_SEQUENTIAL);
  data_ = static_cast<const char*>(memory);
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) ::munmap(const_cast<char*>(data_), size_);
}

}  // namespace keenline

#include "keenline/io/output_file.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "keenline/errors.h"

namespace keenline {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 20U;

/// Paths that a signal handler may have to remove: fixed memory, because a handler may not allocate.
struct UnfinishedPath {
  enum State : int { Free, Filling, Armed };
  std::atomic<int> state{Free};
  std::array<char, PATH_MAX> path{};
};
std::array<UnfinishedPath, 16> unfinished_paths;

void remember_unfinished(const std::string& path) {
  if (path.size() >= PATH_MAX) return;  // the kernel refuses such a path anyway
  for (UnfinishedPath& slot : unfinished_paths) {
    int expected = UnfinishedPath::Free;
    if (!slot.state.compare_exchange_strong(expected, UnfinishedPath::Filling)) continue;
    std::memcpy(slot.path.data(), path.c_str(), path.size() + 1);
    slot.state = UnfinishedPath::Armed;
    return;
  }
}

void forget_unfinished(const std::string& path) {
  for (UnfinishedPath& slot : unfinished_paths)
    if (slot.state == UnfinishedPath::Armed && path == slot.path.data()) slot.state = UnfinishedPath::Free;
}

[[noreturn]] void fail(const std::string& path, std::string_view action, int error_number) {
  throw OutputError(path, fmt::format("{}: {}", action, system_message(error_number)));
}

/// Where a write to `path` really lands, and the permissions of the file that is there now.
struct Target {
  std::string path;
  std::optional<mode_t> mode;
};

Target resolve_target(const std::string& path) {
  if (path.empty() || path.find('\0') != std::string::npos)
    throw OutputError(path, "cannot be written: not a file name");
  Target target{path, std::nullopt};
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) {
    if (errno == ENOENT) return target;
    fail(path, "cannot be written", errno);
  }
  if (S_ISLNK(status.st_mode)) {
    const std::unique_ptr<char, decltype(&std::free)> resolved(::realpath(path.c_str(), nullptr), &std::free);
    if (!resolved) fail(path, "cannot be written: symbolic link", errno);
    target.path = resolved.get();
    if (::stat(target.path.c_str(), &status) != 0) fail(path, "cannot be written", errno);
  }
  if (S_ISDIR(status.st_mode)) throw OutputError(path, "cannot be written: it is a folder");
  if (!S_ISREG(status.st_mode)) throw OutputError(path, "cannot be written: it is not a regular file");
  // A rename would replace a write-protected file; whoever protected it meant it.
  if (::access(target.path.c_str(), W_OK) != 0) fail(path, "cannot be written", errno);
  target.mode = status.st_mode & 07777U;
  return target;
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

int sync_descriptor(int descriptor) {
  int result = 0;
  do result = ::fsync(descriptor);
  while (result != 0 && errno == EINTR);
  return result;
}

/// False when one of them is not there, or the file system cannot do so.
bool swap_files(const std::string& a, const std::string& b) {
#ifdef RENAME_EXCHANGE
  return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
#else
  return a.empty() && b.empty();
#endif
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path) {
  const Target target = resolve_target(path);
  target_ = target.path;
  folder_ = folder_of(target_);
  buffer_.reserve(buffer_size);
  // A name of its own length, so that a target with the longest allowed name can be written.
  for (int attempt = 0;; ++attempt) {
    temporary_ = fmt::format("{}/.keenline-{}-{}.tmp", folder_, ::getpid(), attempt);
    remember_unfinished(temporary_);
    do descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    while (descriptor_ < 0 && errno == EINTR);
    if (descriptor_ >= 0) break;
    const int error_number = errno;
    forget_unfinished(temporary_);
    if (error_number != EEXIST || attempt == 1000) fail(path_, "cannot be written", error_number);
  }
  if (target.mode && ::fchmod(descriptor_, *target.mode) != 0) {
    const int error_number = errno;
    ::close(descriptor_);
    ::unlink(temporary_.c_str());
    forget_unfinished(temporary_);
    fail(path_, "cannot keep the permissions of the file that is there", error_number);
  }
}

OutputFile::~OutputFile() {
  // An abandoned result: nothing here can still go wrong for the user.
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) {
    ::unlink(temporary_.c_str());
    forget_unfinished(temporary_);
  }
}

void OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::string_view part = bytes.substr(0, buffer_size - buffer_.size());
    buffer_ += part;
    bytes.remove_prefix(part.size());
    if (buffer_.size() == buffer_size) flush();
  }
}

void OutputFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path_, "cannot be written", errno);
    if (written == 0) fail(path_, "cannot be written", EIO);
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  buffer_.clear();
}

void OutputFile::store() {
  flush();
  if (sync_descriptor(descriptor_) != 0) fail(path_, "cannot be flushed to the disk", errno);
  const int closing = ::close(descriptor_);
  descriptor_ = -1;
  if (closing != 0 && errno != EINTR) fail(path_, "cannot be written", errno);
}

void OutputFile::commit() {
  if (descriptor_ >= 0) store();
  // Opened before the rename, so that what can fail early fails while the old target still stands.
  int folder = -1;
  do folder = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  while (folder < 0 && errno == EINTR);
  if (folder < 0) fail(path_, "its folder cannot be opened", errno);
  try {
    publish(folder);
  } catch (...) {
    ::close(folder);
    throw;
  }
  ::close(folder);
}

/// Swaps the new file with an old target, so that this can come back. \throw OutputError.
void OutputFile::publish(int folder) {
  const bool swapped = swap_files(temporary_, target_);
  if (!swapped && ::rename(temporary_.c_str(), target_.c_str()) != 0) fail(path_, "cannot be written", errno);
  // Some file systems cannot sync a folder at all (EINVAL): they give no promise that could be broken.
  if (sync_descriptor(folder) != 0 && errno != EINVAL) {
    const int error_number = errno;
    // A failed run leaves nothing that looks like a result; where no swap is possible the old one is lost.
    if (!swapped || !swap_files(temporary_, target_)) ::unlink(target_.c_str());
    fail(path_, "its folder cannot be flushed to the disk", error_number);
  }
  if (swapped) ::unlink(temporary_.c_str());
  forget_unfinished(temporary_);
  temporary_.clear();
}

void require_different_files(const std::string& input, const std::string& output) {
  struct stat in {};
  struct stat out {};
  if (::stat(input.c_str(), &in) != 0 || ::stat(output.c_str(), &out) != 0) return;
  if (in.st_dev == out.st_dev && in.st_ino == out.st_ino)
    throw InvalidArgument(fmt::format("output {} is the input; expected another file", quoted(output, 4096)));
}

void require_distinct_outputs(std::span<const std::string> paths) {
  std::set<std::string> targets;
  for (const std::string& path : paths) {
    std::error_code ignored;  // a path that cannot be followed is refused where it is opened
    const std::filesystem::path target =
        std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored);
    if (!targets.insert(target.empty() ? path : target.string()).second)
      throw InvalidArgument(
          fmt::format("output {} is named twice; expected another file", quoted(path, 4096)));
  }
}

void remove_unfinished_output() noexcept {
  for (UnfinishedPath& slot : unfinished_paths)
    if (slot.state == UnfinishedPath::Armed) ::unlink(slot.path.data());
}

}  // namespace keenline

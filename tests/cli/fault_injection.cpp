// Loaded before the C library (LD_PRELOAD): makes the n-th call of one kind fail.
//
//   FAULT_CALL    what fails: alloc, mmap, open, stat, lstat, fstat, realpath, access, write, fsync, fchmod,
//   close, rename, unlink, thread FAULT_NUMBER  which call, from 1; 0 = none, calls are only counted
//   FAULT_REPEAT  1 = every call from that one on
//   FAULT_ERROR   errno that the call sets; 0 = a write that stores a single byte
//   FAULT_FOLDER  calls on files elsewhere do not count
//   FAULT_COUNT   file that receives the number of calls when the program ends
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdarg>
#include <cstdlib>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <string_view>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
}

namespace {

struct Plan {
  std::string_view call;
  std::string_view folder;
  const char* count_file = nullptr;
  long number = 0;
  bool repeat = false;
  int error = 0;
};

long number_in(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? 0 : std::strtol(text, nullptr, 10);
}

std::string_view text_in(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? std::string_view() : text;
}

Plan plan;
std::atomic<bool> ready{false};  // what runs before is the loading of libraries
std::atomic<long> calls{0};
std::array<std::atomic<bool>, 1024> watched{};  // descriptors of files in the folder

__attribute__((constructor)) void make_plan() {
  plan = {text_in("FAULT_CALL"),          text_in("FAULT_FOLDER"),
          std::getenv("FAULT_COUNT"),     number_in("FAULT_NUMBER"),
          number_in("FAULT_REPEAT") != 0, static_cast<int>(number_in("FAULT_ERROR"))};
  ready = true;
}

__attribute__((destructor)) void report() {
  if (plan.count_file == nullptr) return;
  std::array<char, 24> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), calls.load()).ptr;
  const long file = ::syscall(SYS_openat, AT_FDCWD, plan.count_file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (::syscall(SYS_write, file, text.data(), end - text.data()) < 0) std::abort();
  ::syscall(SYS_close, file);
}

/// Counts one call; true when it is to fail.
bool fails(std::string_view call) {
  if (!ready || plan.call != call) return false;
  const long number = ++calls;
  if (plan.number == 0 || number < plan.number || (number > plan.number && !plan.repeat)) return false;
  errno = plan.error;
  return true;
}

bool in_folder(const char* path) {
  return ready && path != nullptr && !plan.folder.empty() && std::string_view(path).starts_with(plan.folder);
}

bool is_watched(int descriptor) {
  return descriptor >= 0 && static_cast<size_t>(descriptor) < watched.size() &&
         watched[static_cast<size_t>(descriptor)];
}

template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

/// The descriptor may be for reading only.
void empty_file(int descriptor) {
  std::array<char, 32> path{"/proc/self/fd/"};
  std::to_chars(path.data() + std::string_view(path.data()).size(), path.data() + path.size() - 1,
                descriptor);
  if (::truncate(path.data(), 0) != 0) std::abort();
}

int opened(int descriptor, const char* path) {
  if (descriptor >= 0 && static_cast<size_t>(descriptor) < watched.size())
    watched[static_cast<size_t>(descriptor)] = in_folder(path);
  return descriptor;
}

}  // namespace

extern "C" {

void* malloc(size_t size) { return fails("alloc") ? nullptr : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return fails("alloc") ? nullptr : __libc_calloc(count, size); }
void* realloc(void* memory, size_t size) { return fails("alloc") ? nullptr : __libc_realloc(memory, size); }
void* memalign(size_t alignment, size_t size) {
  return fails("alloc") ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  return fails("alloc") ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, size_t alignment, size_t size) {
  if (fails("alloc")) return ENOMEM;
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}

void* mmap(void* address, size_t length, int protection, int flags, int descriptor, off_t offset) noexcept {
  if (fails("mmap") || (is_watched(descriptor) && fails("map"))) return MAP_FAILED;
  if (is_watched(descriptor) && fails("shrink")) empty_file(descriptor);
  return reinterpret_cast<void*>(::syscall(SYS_mmap, address, length, protection, flags, descriptor, offset));
}
void* mmap64(void* address, size_t length, int protection, int flags, int descriptor,
             off64_t offset) noexcept {
  return mmap(address, length, protection, flags, descriptor, offset);
}

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  if (in_folder(path) && fails("open")) return -1;
  return opened(static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode)), path);
}
int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return open(path, flags, mode);
}

int stat(const char* path, struct stat* status) noexcept {
  if (in_folder(path) && fails("stat")) return -1;
  return real<decltype(stat)>("stat")(path, status);
}
int lstat(const char* path, struct stat* status) noexcept {
  if (in_folder(path) && fails("lstat")) return -1;
  return real<decltype(lstat)>("lstat")(path, status);
}
int fstat(int descriptor, struct stat* status) noexcept {
  if (is_watched(descriptor) && fails("fstat")) return -1;
  return real<decltype(fstat)>("fstat")(descriptor, status);
}
char* realpath(const char* path, char* resolved) noexcept {
  if (in_folder(path) && fails("realpath")) return nullptr;
  return real<decltype(realpath)>("realpath")(path, resolved);
}
int access(const char* path, int mode) noexcept {
  if (in_folder(path) && fails("access")) return -1;
  return real<decltype(access)>("access")(path, mode);
}

ssize_t write(int descriptor, const void* bytes, size_t count) {
  if (is_watched(descriptor) && fails("write")) {
    if (plan.error != 0) return -1;
    count = count < 1 ? count : 1;
  }
  return ::syscall(SYS_write, descriptor, bytes, count);
}
int fsync(int descriptor) {
  if (is_watched(descriptor) && fails("fsync")) return -1;
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}
int fchmod(int descriptor, mode_t mode) noexcept {
  if (is_watched(descriptor) && fails("fchmod")) return -1;
  return static_cast<int>(::syscall(SYS_fchmod, descriptor, mode));
}
int close(int descriptor) {
  const bool counted = is_watched(descriptor);
  if (counted) watched[static_cast<size_t>(descriptor)] = false;
  const int result = static_cast<int>(::syscall(SYS_close, descriptor));
  return counted && fails("close") ? -1 : result;  // closed all the same, as on Linux
}
int rename(const char* from, const char* to) noexcept {
  if (in_folder(to) && fails("rename")) return -1;
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
  if (in_folder(to) && fails("rename")) return -1;
  return static_cast<int>(::syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}
int unlink(const char* path) noexcept {
  if (in_folder(path) && fails("unlink")) return -1;
  return static_cast<int>(::syscall(SYS_unlinkat, AT_FDCWD, path, 0));
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                   void* argument) noexcept {
  if (fails("thread")) return EAGAIN;
  return real<decltype(pthread_create)>("pthread_create")(thread, attributes, start, argument);
}

}  // extern "C"

#include "keenline/memory.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fcntl.h>
#include <limits>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

#include <fmt/format.h>

#include "keenline/errors.h"

namespace keenline {
namespace {

constexpr std::uint64_t unknown = std::numeric_limits<std::uint64_t>::max();

/// The first bytes of a small system file; empty where there is none (other systems, other mounts).
std::string system_file(const char* path) {
  const int descriptor = ::open(path, O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return {};
  std::array<char, 4096> text{};
  const ssize_t length = ::read(descriptor, text.data(), text.size());
  ::close(descriptor);
  return length > 0 ? std::string(text.data(), static_cast<std::size_t>(length)) : std::string();
}

/// The first number after `key`; unknown when there is none ("max").
std::uint64_t number_after(std::string_view text, std::string_view key) {
  const std::size_t start = text.find(key);
  if (start == std::string_view::npos) return unknown;
  text.remove_prefix(start + key.size());
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  std::uint64_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc() ? value : unknown;
}

std::uint64_t left_of(std::uint64_t limit, std::uint64_t used) {
  if (limit == unknown || used == unknown) return unknown;
  return limit > used ? limit - used : 0;
}

std::uint64_t control_group_memory() {
  const std::uint64_t limit = number_after(system_file("/sys/fs/cgroup/memory.max"), "");
  if (limit == unknown) return unknown;
  // Cached file pages are counted as used, but are given back when memory is needed.
  const std::string statistics = system_file("/sys/fs/cgroup/memory.stat");
  std::uint64_t used = number_after(system_file("/sys/fs/cgroup/memory.current"), "");
  for (const std::string_view key : {"inactive_file ", "active_file "}) {
    const std::uint64_t cached = number_after(statistics, std::string("\n") + std::string(key));
    if (cached != unknown && used != unknown) used -= std::min(used, cached);
  }
  return left_of(limit, used);
}

std::uint64_t address_space() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unknown;
  const std::uint64_t pages = number_after(system_file("/proc/self/statm"), "");
  if (pages == unknown) return limit.rlim_cur;
  return left_of(limit.rlim_cur, pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)));
}

}  // namespace

std::uint64_t available_memory() {
  const std::uint64_t kibibytes = number_after(system_file("/proc/meminfo"), "MemAvailable:");
  const std::uint64_t physical = kibibytes == unknown ? unknown : kibibytes * 1024;
  return std::min({physical, control_group_memory(), address_space()});
}

std::uint64_t peak_memory() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

void require_memory(std::uint64_t bytes, std::string_view what) {
  // Looking it up takes longer than the small amounts are worth.
  constexpr std::uint64_t small = std::uint64_t{64} << 20U;
  if (bytes < small) return;
  const std::uint64_t available = available_memory();
  if (bytes <= available) return;
  constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;
  throw OutOfMemory(fmt::format("{} needs {:.1f} GiB of memory, {:.1f} GiB are available", what,
                                static_cast<double>(bytes) / gibibyte,
                                static_cast<double>(available) / gibibyte));
}

}  // namespace keenline

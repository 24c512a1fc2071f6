#include "terminal.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <mutex>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include "keenline/errors.h"
#include "keenline/io/output_file.h"

namespace keenline::cli {
namespace {

std::atomic<int> received_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "used in a signal handler");

extern "C" void handle_interruption(int signal) {
  int none = 0;
  if (received_signal.compare_exchange_strong(none, signal)) return;
  remove_unfinished_output();
  ::_exit(128 + signal);
}

extern "C" void handle_vanished_input(int /*signal*/) {
  // The first thread tells and ends the program, the others wait for that.
  static std::atomic_flag told;
  while (told.test_and_set()) ::pause();
  remove_unfinished_output();
  constexpr std::string_view message =
      "keenline: the input shrank or could no longer be read while it was being read\n";
  if (::write(STDERR_FILENO, message.data(), message.size()) < 0)
    ::_exit(1);  // nobody to tell; same exit either way
  ::_exit(1);
}

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  ::sigemptyset(&action.sa_mask);
  if (::sigaction(signal, &action, nullptr) != 0)
    throw Error("cannot handle signals: " + system_message(errno));
}

std::int64_t now_ms() {
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(since_start).count();
}

struct Meeting {
  std::mutex mutex;
  std::condition_variable over;
  bool is_over = false;
};

extern "C" void* wait_for_end(void* argument) {
  Meeting& meeting = *static_cast<Meeting*>(argument);
  std::unique_lock lock(meeting.mutex);
  meeting.over.wait(lock, [&] { return meeting.is_over; });
  return nullptr;
}

/// Of `wanted` threads beside this one, so many the system gives at once. TBB takes it for granted that it
/// gets its threads, and cannot go on without.
int available_threads(int wanted) {
  Meeting meeting;
  std::vector<pthread_t> threads(static_cast<std::size_t>(wanted));
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) != 0) return 0;
  constexpr std::size_t stack_of_tbb = std::size_t{4} << 20U;
  ::pthread_attr_setstacksize(&attributes, stack_of_tbb);
  std::size_t count = 0;
  while (count < threads.size() &&
         ::pthread_create(&threads[count], &attributes, wait_for_end, &meeting) == 0)
    ++count;
  ::pthread_attr_destroy(&attributes);
  {
    const std::lock_guard lock(meeting.mutex);
    meeting.is_over = true;
  }
  meeting.over.notify_all();
  for (std::size_t i = 0; i < count; ++i) ::pthread_join(threads[i], nullptr);
  return static_cast<int>(count);
}

}  // namespace

void occupy_closed_descriptors() {
  // In rising order each takes the lowest free number: its own.
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    const bool closed = ::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF;
    if (closed) (void)::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

void install_signal_handlers() {
  handle(SIGINT, handle_interruption);
  handle(SIGTERM, handle_interruption);
  handle(SIGHUP, handle_interruption);
  handle(SIGBUS, handle_vanished_input);
  handle(SIGXFSZ, SIG_IGN);
  handle(SIGPIPE, SIG_IGN);
}

int interrupting_signal() { return received_signal.load(std::memory_order_relaxed); }

TerminalProgress::TerminalProgress(bool quiet) : visible_(!quiet && ::isatty(STDERR_FILENO) == 1) {}

TerminalProgress::~TerminalProgress() { clear(); }

void TerminalProgress::begin(std::string_view stage, std::uint64_t total) {
  stage_ = stage;
  total_ = total;
  done_ = 0;
  // What is over at once needs no bar.
  next_drawing_ms_ = now_ms() + 200;
  clear();
}

void TerminalProgress::advance(std::uint64_t units) {
  done_.fetch_add(units, std::memory_order_relaxed);
  if (!visible_) return;
  const std::int64_t now = now_ms();
  std::int64_t due = next_drawing_ms_.load();
  if (now >= due && next_drawing_ms_.compare_exchange_strong(due, now + 100)) draw();
}

void TerminalProgress::draw() const {
  constexpr std::size_t width = 30;
  const std::uint64_t done = done_.load();
  std::string line = fmt::format("\r{:<14}", stage_);
  if (total_ > 0) {
    const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total_));
    const auto filled = static_cast<std::size_t>(share * width);
    line += fmt::format(" [{:#<{}}{:<{}}] {:3.0f} %", "", filled, "", width - filled, 100 * share);
  }
  std::fwrite(line.data(), 1, line.size(), stderr);
}

void TerminalProgress::clear() const {
  if (visible_) std::fputs("\r\x1b[K", stderr);
}

void limit_threads(int threads) {
  if (threads < 0 || threads > 1024)
    throw InvalidArgument(
        fmt::format("--threads: found {}, expected 1 to 1024 (or 0 for all there are)", threads));
  const int wanted = threads == 0 ? tbb::info::default_concurrency() : threads;
  const int given = 1 + available_threads(wanted - 1);
  // Never given up: its destructor may wait for ever for a TBB that once ran out of memory.
  static const auto* const control =
      new tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(given));
  (void)control;
}

void print_notes(std::string_view file, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    const std::string line =
        fmt::format("keenline: note: {}: {}\n", escaped(file, 4096), escaped(note, 4096));
    std::fwrite(line.data(), 1, line.size(), stderr);  // where nobody listens, nothing is lost
  }
}

void print(std::string_view text) {
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!written) throw OutputError("standard output", "cannot be written: " + system_message(errno));
}

void print_json(nlohmann::json object) {
  // A file name need not be valid UTF-8, JSON text must.
  const std::string text = object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  object = nullptr;  // takes memory: that must not end after the text is out
  print(text);
}

}  // namespace keenline::cli

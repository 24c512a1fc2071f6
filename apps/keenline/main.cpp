#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "keenline/errors.h"
#include "keenline/io/output_file.h"
#include "keenline/kernels/target.h"

#include "commands.h"
#include "terminal.h"

namespace {

// What scripts rely on; docs/cli.md lists them.
constexpr int done = 0;
constexpr int input_refused = 1;
constexpr int wrong_usage = 2;
constexpr int output_not_written = 3;
constexpr int out_of_memory = 4;

/// One line on stderr, without allocating: this also runs when there is no memory left.
int fail(int code, std::string_view message) {
  std::fputs("keenline: ", stderr);
  std::fwrite(message.data(), 1, message.size(), stderr);
  std::fputc('\n', stderr);
  return code;
}

/// \pre an exception is being handled.
int fail_with_current_exception() noexcept {
  try {
    throw;
  } catch (const keenline::Cancelled&) {
    return fail(128 + keenline::cli::interrupting_signal(), "interrupted");
  } catch (const keenline::InvalidArgument& e) {
    return fail(wrong_usage, e.what());
  } catch (const keenline::OutputError& e) {
    return fail(output_not_written, e.what());
  } catch (const keenline::OutOfMemory& e) {
    return fail(out_of_memory, e.what());
  } catch (const keenline::Error& e) {
    return fail(input_refused, e.what());
  } catch (const std::bad_alloc&) {
    return fail(out_of_memory, "out of memory");
  } catch (const std::exception& e) {  // from below: no thread, no lock, a length beyond all memory
    return fail(out_of_memory, e.what());
  }
}

/// Memory may run out where nothing can be thrown: before main, in a noexcept function of a library, or when
/// there is no room for the exception itself.
[[noreturn]] void end_without_unwinding() noexcept {
  static std::atomic_flag ending;
  while (ending.test_and_set()) ::pause();  // another thread is at it
  keenline::remove_unfinished_output();
  std::_Exit(std::current_exception() ? fail_with_current_exception() : fail(out_of_memory, "out of memory"));
}

// Before the variables of CLI11 are initialised.
__attribute__((constructor(101))) void prepare_end() { std::set_terminate(end_without_unwinding); }

int run(int argc, char** argv) {
  keenline::cli::occupy_closed_descriptors();
  keenline::cli::install_signal_handlers();
  CLI::App app("keenline finds what is sharp in a point cloud: edges, corners, peaks.", "keenline");
  // Asked for before anything else, so that a wrong KEENLINE_TARGET is not found out in the midst of things.
  app.set_version_flag("--version",
                       "keenline " KEENLINE_VERSION " (" + std::string(keenline::kernels::target()) + ")");
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  keenline::cli::Action action;
  keenline::cli::add_detect(app, action);
  keenline::cli::add_lines(app, action);
  keenline::cli::add_relabel(app, action);
  keenline::cli::add_synth(app, action);
  keenline::cli::add_evaluate(app, action);
  keenline::cli::add_info(app, action);
  keenline::cli::add_picture(app, action);
  keenline::cli::add_gaussmap(app, action);
  keenline::cli::add_methods(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {  // --help, --version
    return app.exit(e);
  } catch (const CLI::RequiredError& e) {
    if (app.get_subcommands().empty() && argc > 1)
      return fail(wrong_usage,
                  "found " + keenline::quoted(argv[1]) + ", expected a command (see keenline --help)");
    return fail(wrong_usage, keenline::escaped(e.what(), 4096) + " (see keenline --help)");
  } catch (const CLI::ParseError& e) {
    return fail(wrong_usage, keenline::escaped(e.what(), 4096) + " (see keenline --help)");
  }
  action();
  return done;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (...) {
    // Without the destructors of TBB: they may wait for ever once memory has run out.
    std::_Exit(fail_with_current_exception());
  }
}

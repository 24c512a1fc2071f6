#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace keenline::cli {

/// What a subcommand does once the command line is understood. Failures are exceptions (see main.cpp).
using Action = std::function<void()>;

/// Each adds its subcommand to `app` and stores what it does in `action` when the user chose it.
void add_detect(CLI::App& app, Action& action);
void add_lines(CLI::App& app, Action& action);
void add_relabel(CLI::App& app, Action& action);
void add_synth(CLI::App& app, Action& action);
void add_evaluate(CLI::App& app, Action& action);
void add_methods(CLI::App& app, Action& action);
void add_info(CLI::App& app, Action& action);
void add_picture(CLI::App& app, Action& action);
void add_gaussmap(CLI::App& app, Action& action);

}  // namespace keenline::cli

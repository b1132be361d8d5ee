// SPDX-License-Identifier: MIT
// The program: subcommands, and what becomes of their failures.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <memory>

#include "commands.h"
#include "grove/io/input_error.h"
#include "help_formatter.h"
#include "version.h"

namespace grove {
namespace {

constexpr const char* kDescription =
    "Grove solves CTS-MAPF: many agents on a grid, each with cells to visit in any order and a\n"
    "destination, without collisions, at the least sum of finish times - with a proof of how far\n"
    "from the least the answer can be.\n";

constexpr const char* kFooter =
    "Exit codes:\n"
    "  0  ended cleanly; a plan file says how\n"
    "  1  internal failure\n"
    "  2  bad usage or input: one line on stderr with file, place and what was expected\n"
    "\n"
    "'grove COMMAND --help' explains a command, with examples.";

void complain(const std::string& message) {
  fmt::print(stderr, "grove: error: {}\n", one_line(message));
}

// The subcommand that was reached last: "grove generate map" of "grove generate map --wrong".
const CLI::App& reached_command(const CLI::App& app) {
  const auto subcommands = app.get_subcommands();
  return subcommands.empty() ? app : reached_command(*subcommands.back());
}

std::string full_name(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent ? full_name(*parent) + " " + command.get_name() : command.get_name();
}

int fail_usage(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = reached_command(app);
  std::string message = error.what();
  // CLI11 would only say that a command is required.
  const bool unknown_command = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr &&
                               command.get_require_subcommand_min() > 0 &&
                               command.remaining_size() > 0;
  if (unknown_command) message = fmt::format("unknown command '{}'", command.remaining().front());
  complain(fmt::format("{} (see '{} --help')", message, full_name(command)));
  return kExitBadInput;
}

// A full disk or a closed pipe must not pass for success.
int flush_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return kExitSuccess;
  complain("standard output: cannot be written");
  return kExitInternalFailure;
}

int run(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return flush_output();
  } catch (const CLI::Success& help_or_version) {
    app.exit(help_or_version);
    return flush_output();
  } catch (const CLI::ParseError& error) {
    return fail_usage(app, error);
  } catch (const InputError& error) {
    complain(error.what());
    return kExitBadInput;
  } catch (const CommandFailed& failure) {
    return failure.exit_code();
  }
}

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is then an error of write()
  CLI::App app(kDescription, "grove");
  app.footer(kFooter);
  app.formatter(std::make_shared<HelpFormatter>());  // before the subcommands: they take it over
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  add_solve_command(app);
  add_check_command(app);
  add_generate_command(app);
  try {
    return run(app, argc, argv);
  } catch (const std::exception& error) {
    complain(fmt::format("internal failure: {}", error.what()));
    return kExitInternalFailure;
  }
}

}  // namespace
}  // namespace grove

int main(int argc, char** argv) {
  return grove::main(argc, argv);
}

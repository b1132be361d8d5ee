// SPDX-License-Identifier: MIT
#include "tools/common/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "tools/common/commands.h"
#include "tools/common/help_formatter.h"
#include "tools/common/manual.h"
#include "tools/common/parse_error.h"
#include "tools/common/standard_error.h"
#include "tools/common/version.h"

namespace grove::detail {
namespace {

using Words = std::vector<std::string>;

// Returns the innermost subcommand that the parser has reached: "grove generate map" for the
// command line "grove generate map --wrong".
const CLI::App& reached_command(const CLI::App& app) {
  const auto subcommands = app.get_subcommands();
  return subcommands.empty() ? app : reached_command(*subcommands.back());
}

std::string full_name(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent ? full_name(*parent) + " " + command.get_name() : command.get_name();
}

std::string usage_text(const CLI::App& app, const CLI::ParseError& error, const Words& words) {
  if (const std::string text = misplaced_command_text(app, words); !text.empty())
    return fmt::format("{} (see '{} --help')", text, app.get_name());
  const CLI::App& command = reached_command(app);
  return fmt::format("{} (see '{} --help')", parse_error_text(command, error), full_name(command));
}

// Translates "grove help solve" to "grove solve --help". Throws CLI::ValidationError for an unknown
// command.
Words words_of(const CLI::App& app, int argc, char** argv) {
  Words words(argv + 1, argv + argc);
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  const CLI::App* command = &app;
  for (const std::string& word : words) {
    const auto known =
        command->get_subcommands([&](const CLI::App* c) { return c->check_name(word); });
    if (known.empty()) throw CLI::ValidationError(unknown_command_text(*command, word));
    command = known.front();
  }
  words.push_back("--help");
  return words;
}

// Handles "grove help --completion SHELL" and "grove help --manual FOLDER". Returns whether the
// command line is one of them. Throws CLI::ValidationError for other options of "grove help".
bool handle_program_help(const CLI::App& app, const Words& words, bool prints_messages) {
  if (words.size() < 2 || words[0] != "help" || !words[1].starts_with("--")) return false;
  const std::string value = words.size() == 3 ? words[2] : "";
  if (words[1] == "--completion" && std::ranges::count(kShells, value) == 1) {
    if (prints_messages) fmt::print("{}", completion_script(command_text(app), value));
    return true;
  }
  if (words[1] == "--manual" && !value.empty()) {
    if (!prints_messages) return true;
    for (const ManualPage& page : manual_pages(command_text(app), version_text()))
      write_file_atomically(std::filesystem::path(value) / page.name, page.text);
    return true;
  }
  throw CLI::ValidationError(
      "help", "expected a command, '--completion bash', zsh or fish, or '--manual FOLDER'");
}

// Flushes standard output. Returns the exit code: a failure if it cannot be written, for instance
// because of a full disk or a closed pipe.
int flush_output(const CLI::App& app) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return kExitSuccess;
  print_error(app, "standard output: cannot be written");
  return kExitInternalFailure;
}

}  // namespace

void print_error(const CLI::App& app, const std::string& message) {
  print_to_stderr(fmt::format("{}: error: {}", app.get_name(), one_line(message)));
}

void let_last_option_win(CLI::App& app) {
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

void prepare_program(CLI::App& app) {
  std::signal(SIGXFSZ, SIG_IGN);  // at the file size limit write() then fails with EFBIG
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  let_last_option_win(app);
}

int run_program(CLI::App& app, int argc, char** argv, bool prints_messages,
                const std::function<void(const std::string& why)>& refused) {
  const auto say = [&](const std::string& message) {
    refused(message);
    if (prints_messages) print_error(app, message);
    return kExitBadInput;
  };
  try {
    if (handle_program_help(app, Words(argv + 1, argv + argc), prints_messages)) {
      refused("found only 'help' with --completion or --manual");
      return flush_output(app);
    }
    Words words = words_of(app, argc, argv);
    std::ranges::reverse(words);  // CLI11 parses from the back
    app.parse(std::move(words));
    return flush_output(app);
  } catch (const CLI::Success& help_or_version) {
    refused("found only a request for help or the version");
    if (prints_messages) app.exit(help_or_version);
    return flush_output(app);
  } catch (const CLI::ParseError& error) {
    return say(usage_text(app, error, Words(argv + 1, argv + argc)));
  } catch (const InputError& error) {
    return say(error.what());
  } catch (const CommandFailed& failure) {
    return failure.exit_code();
  }
}

int run_only_process(CLI::App& app, int argc, char** argv) {
  try {
    return run_program(app, argc, argv);
  } catch (const std::exception& error) {
    print_error(app, fmt::format("internal failure: {}", error.what()));
    return kExitInternalFailure;
  }
}

}  // namespace grove::detail

// SPDX-License-Identifier: MIT
// grove: main program with all subcommands.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "tools/common/commands.h"
#include "tools/common/helper_program.h"
#include "tools/common/program.h"
#include "tools/common/signals.h"
#include "tools/view/view_command.h"

namespace grove::detail {
namespace {

constexpr const char* kDescription =
    "Grove plans collision-free paths for many agents on a grid or a roadmap, each with places to\n"
    "visit in any order and a destination (CTS-MAPF). It minimises the sum of finish times and\n"
    "proves how far from optimal the plan is at most. Agents may need time to turn, and tasks may\n"
    "take time.\n";

constexpr const char* kProgramFooter = R"(Exit codes:
  0  ended cleanly; the plan file has the status
  1  internal failure
  2  bad usage or input: one line on stderr with file, place and what was expected
  3  no plan was found, with --require-plan

'grove help COMMAND' and 'grove COMMAND --help' explain a command, with examples.)";

int main(int argc, char** argv) {
  accept_checkpoint_signal();
  CLI::App app(kDescription, "grove");
  app.footer(kProgramFooter);
  prepare_program(app);
  add_solve_command(app);
  add_check_command(app);
  add_execute_command(app);
  add_replan_command(app);
  const std::vector<std::string> words(argv + 1, argv + argc);
  add_view_command(
      app, {.exec_picture_program = [&] { exec_program("grove-picture", words, "grove-pictures"); },
            .draw = {}});
  add_proof_command(app);
  add_generate_command(app);
  add_convert_command(app);
  add_bench_command(app);
  add_helper_commands(app);
  return run_only_process(app, argc, argv);
}

}  // namespace
}  // namespace grove::detail

int main(int argc, char** argv) {
  return grove::detail::main(argc, argv);
}

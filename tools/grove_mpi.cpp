// SPDX-License-Identifier: MIT
// grove-mpi: main program of the distributed solver.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <span>
#include <string_view>

#include "mpi/mpi_session.h"
#include "tools/common/commands.h"
#include "tools/common/program.h"
#include "tools/common/signals.h"
#include "tools/mpi/collective.h"
#include "tools/mpi/mpi_commands.h"

namespace grove::detail {
namespace {

constexpr const char* kDescription =
    "Grove with several processes, on one machine or many: each rank searches with its own "
    "threads,\n"
    "and all share one search. Start it with mpirun or srun.\n";

constexpr const char* kProgramFooter = R"(Exit codes:
  0  ended cleanly; the plan file has the status
  1  internal failure
  2  bad usage or input: one line on stderr with file, place and what was expected

'grove-mpi help COMMAND' and 'grove-mpi COMMAND --help' explain a command, with examples.)";

// Returns whether the user asks only for help or the version, or gives no arguments. The program
// then does not start MPI, which may fail on this machine.
bool asks_for_help(std::span<char* const> arguments) {
  if (arguments.empty() || std::string_view(arguments.front()) == "help") return true;
  for (const std::string_view word : arguments) {
    if (word == "--") return false;
    if (word == "--help" || word == "-h" || word == "--version") return true;
  }
  return false;
}

// Returns whether this process is rank 0 according to the environment that mpirun or srun sets, or
// was started without them.
bool is_first_process() {
  for (const char* variable : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "SLURM_PROCID"})
    if (const char* rank = std::getenv(variable)) return std::string_view(rank) == "0";
  return true;
}

int run(MpiSession& session, bool prints_messages, int argc, char** argv) {
  CLI::App app(kDescription, "grove-mpi");
  app.footer(kProgramFooter);
  prepare_program(app);
  CommandLines lines(session);
  add_mpi_solve_command(app, session, lines);
  add_mpi_batch_command(app, session, lines);
  try {
    return run_program(app, argc, argv, prints_messages,
                       [&](const std::string& why) { lines.refuse(why); });
  } catch (const std::exception& error) {
    print_error(app, fmt::format("internal failure of rank {}: {}", session.rank(), error.what()));
    session.abort(kExitInternalFailure);
  }
}

int main(int argc, char** argv) {
  if (asks_for_help(std::span(argv, static_cast<std::size_t>(argc)).subspan(1))) {
    MpiSession session;
    return run(session, is_first_process(), argc, argv);
  }
  stop_on_signals();  // before MPI starts, because a signal during its start would end the job
  MpiSession session(argc, argv);
  return run(session, session.rank() == 0, argc, argv);
}

}  // namespace
}  // namespace grove::detail

int main(int argc, char** argv) {
  return grove::detail::main(argc, argv);
}

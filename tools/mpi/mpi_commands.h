// SPDX-License-Identifier: MIT
// The subcommands of grove-mpi; see tools/common/commands.h. All ranks run the same command.
// `session` and `lines` must outlive the parsing of the command line.
#pragma once

#include <CLI/App.hpp>

#include "mpi/mpi_session.h"
#include "tools/mpi/collective.h"

namespace grove::detail {

void add_mpi_solve_command(CLI::App& app, MpiSession& session, CommandLines& lines);
void add_mpi_batch_command(CLI::App& app, MpiSession& session, CommandLines& lines);

}  // namespace grove::detail

// SPDX-License-Identifier: MIT
// grove report: hands over to the Python program grove-report, which lies beside this one. Options
// and help are that one's, so that there is one text of them.
#include "tools/common/commands.h"
#include "tools/common/companion.h"

namespace grove {

void add_report_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("report", "Tables and figures from results, as a page");
  command->set_help_flag();
  command->prefix_command();
  command->callback([command] { become("grove-report", command->remaining()); });
}

}  // namespace grove

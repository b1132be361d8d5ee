// SPDX-License-Identifier: MIT
// Subcommands that are separate Python programs. Each parses its own options and prints its own
// help.
#include "tools/common/commands.h"
#include "tools/common/helper_program.h"

namespace grove::detail {
namespace {

// Adds the subcommand `name`, which replaces this process by the program grove-NAME.
void add(CLI::App& app, const std::string& name, const std::string& description) {
  CLI::App* command = app.add_subcommand(name, description);
  command->set_help_flag();
  command->prefix_command();
  command->callback([command, name] { exec_program("grove-" + name, command->remaining()); });
}

}  // namespace

void add_helper_commands(CLI::App& app) {
  add(app, "report", "Make a page with tables and figures from benchmark results");
  add(app, "vda5050", "Drive vehicles along a passing order by VDA 5050, over MQTT");
  add(app, "toio", "Drive toio cubes, real or simulated, along a passing order");
}

}  // namespace grove::detail

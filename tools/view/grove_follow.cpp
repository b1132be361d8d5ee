// SPDX-License-Identifier: MIT
// grove-follow LOG: the server that `grove view --follow` executes. It reads the HTML page from
// standard input.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <string>

#include "tools/common/options.h"
#include "tools/common/program.h"
#include "tools/common/signals.h"
#include "tools/view/browser.h"
#include "tools/view/follow_server.h"

namespace grove::detail {
namespace {

constexpr IntegerRange kPorts{0, 65'535};

struct FollowArguments {
  std::filesystem::path log;
  std::int64_t port = 0;
  bool open = false;
};

void follow(const FollowArguments& arguments) {
  stop_on_signals();
  const auto begun = [&](const std::string& address) {
    fmt::print("following {} at {} (Ctrl-C ends)\n", arguments.log.string(), address);
    std::fflush(stdout);
    if (arguments.open) open_in_browser(address);
  };
  const std::string page{std::istreambuf_iterator<char>(std::cin),
                         std::istreambuf_iterator<char>()};
  serve({arguments.log, page}, static_cast<int>(arguments.port), begun,
        [] { return interrupted.load(); });
}

}  // namespace
}  // namespace grove::detail

int main(int argc, char** argv) {
  CLI::App app("Show a log while it grows: the server of grove view --follow", "grove-follow");
  grove::detail::FollowArguments arguments;
  grove::detail::prepare_program(app);
  app.require_subcommand(0);
  app.add_option("LOG", arguments.log, "log; need not exist yet")->required()->type_name("");
  grove::detail::add_integer(app, "--port", arguments.port, grove::detail::kPorts,
                             "port; 0: any free port");
  app.add_flag("--open", arguments.open, "open the page in the browser");
  app.callback([&] { grove::detail::follow(arguments); });
  return grove::detail::run_only_process(app, argc, argv);
}

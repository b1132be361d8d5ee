// SPDX-License-Identifier: MIT
#include "tools/view/browser.h"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <array>

#include "io/input_error.h"

namespace grove::detail {

void open_in_browser(std::string target) {
  const std::string opener = "xdg-open";
  std::array<char*, 3> arguments{const_cast<char*>(opener.c_str()), target.data(), nullptr};
  posix_spawn_file_actions_t silence;
  ::posix_spawn_file_actions_init(&silence);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    ::posix_spawn_file_actions_addopen(&silence, stream, "/dev/null", O_RDWR, 0);
  pid_t child = 0;
  const int failed =
      ::posix_spawnp(&child, opener.c_str(), &silence, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&silence);
  if (failed != 0)
    throw InputError(
        opener, "",
        "cannot be run; expected the Debian package xdg-utils, or open the page yourself");
}

}  // namespace grove::detail

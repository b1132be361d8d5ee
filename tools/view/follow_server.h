// SPDX-License-Identifier: MIT
// Server for a growing log and the page that shows it; accessible only from this machine.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace grove::detail {

// What the server serves.
struct Followed {
  std::filesystem::path log;  // need not exist yet; may be replaced by a new file
  std::string page;           // HTML, see page.h
};

// Serves on the loopback address until `over`, which is polled some times a second, returns true.
// `port`: 0 for any free port. `begun` is called with the address ("http://127.0.0.1:43210/TOKEN/",
// with a new random token) before the first answer; without the token the answer is 404. Refuses
// requests with another host name (DNS rebinding). Throws InputError if the port is in use.
void serve(const Followed& followed, int port, const std::function<void(const std::string&)>& begun,
           const std::function<bool()>& over);

}  // namespace grove::detail

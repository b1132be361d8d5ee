// SPDX-License-Identifier: MIT
// HTTP server for a growing log and for the page that shows it; only this machine can reach it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace grove::detail {

// The log and the page that are served.
struct ServedLog {
  std::filesystem::path log;  // need not exist yet; may be replaced by a new file
  std::string page;           // HTML, see page.h
};

// Serves on the loopback address until `over`, which is polled every 100 ms, returns true. `port`:
// 0 for any free port. Calls `begun` with the address ("http://127.0.0.1:43210/TOKEN/", with a new
// random token) before the first answer. Requests without the token get 404. Requests with another
// host name are refused, which prevents DNS rebinding. Throws InputError if the port is in use.
void serve(const ServedLog& followed, int port,
           const std::function<void(const std::string&)>& begun, const std::function<bool()>& over);

}  // namespace grove::detail

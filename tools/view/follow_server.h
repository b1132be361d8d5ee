// SPDX-License-Identifier: MIT
// Serves a log that grows, with the page that shows it, to this machine alone.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace grove::detail {

// What a server is to show.
struct Followed {
  std::filesystem::path log;  // need not exist yet; may begin anew
  std::string page;           // of page.h
};

// Serves on the loopback address until `over` says so, asked some times a second. `port` 0: any
// that is free. `begun` is told the address ("http://127.0.0.1:43210/TOKEN/", with a random token
// that is a new one each time) before the first answer; without the token the answer is 404.
// Answers nobody who has come by another name (DNS rebinding). Throws InputError where the port is
// taken.
void serve(const Followed& followed, int port, const std::function<void(const std::string&)>& begun,
           const std::function<bool()>& over);

}  // namespace grove::detail

// SPDX-License-Identifier: MIT
// GET /TOKEN/ returns the page. GET /TOKEN/log?from=N&file=NAME returns whole lines of the log from
// byte N on, or from byte 0 if the current file is not NAME. Headers of the answer: X-Log is the
// name of the current file, which changes when the log is replaced; X-End is the offset after the
// returned lines; X-Size is the size of the log (both in bytes). Other paths get 404: other users
// of this machine can reach the port, but do not know the token.
#include "tools/view/follow_server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <mutex>
#include <random>
#include <thread>

#include "io/input_error.h"

namespace grove::detail {
namespace {

constexpr const char* kLoopback = "127.0.0.1";
constexpr std::streamoff kMaxAnswerBytes = 4 << 20;  // maximum size of an answer, in bytes
constexpr std::streamsize kBeginning = 4096;  // if these first bytes change, the log was replaced
constexpr auto kPause = std::chrono::milliseconds(100);
constexpr auto kMoment = std::chrono::milliseconds(1);

// A file that another process writes. Thread-safe.
class GrowingFile {
 public:
  explicit GrowingFile(std::filesystem::path path) : path_(std::move(path)) {}

  struct Part {
    std::string name;         // changes if the file was replaced
    std::string text;         // whole lines
    std::streamoff end = 0;   // offset after `text`, in bytes
    std::streamoff size = 0;  // of the file, in bytes
  };
  // Returns at most kMaxAnswerBytes, from byte `from` on if the file is still `name`, otherwise
  // from its beginning.
  Part read(std::streamoff from, const std::string& name) {
    const std::lock_guard lock(mutex_);
    std::ifstream file(path_, std::ios::binary);
    file.seekg(0, std::ios::end);
    const std::streamoff size = file ? std::streamoff(file.tellg()) : 0;
    check_for_restart(file, size);
    Part part{std::to_string(number_), "", 0, size};
    if (name == part.name) part.end = std::min(from, size);
    part.text.resize(static_cast<std::size_t>(std::min(size - part.end, kMaxAnswerBytes)));
    file.seekg(part.end);
    file.read(part.text.data(), static_cast<std::streamsize>(part.text.size()));
    part.text.resize(part.text.rfind('\n') + 1);  // "" if there is no newline: npos + 1 is 0
    part.end += static_cast<std::streamoff>(part.text.size());
    return part;
  }

 private:
  void check_for_restart(std::ifstream& file, std::streamoff size) {
    std::string beginning(static_cast<std::size_t>(std::min<std::streamoff>(size, kBeginning)),
                          ' ');
    file.seekg(0);
    file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
    if (size < size_ || !beginning.starts_with(beginning_)) ++number_;
    beginning_ = std::move(beginning);
    size_ = size;
  }

  const std::filesystem::path path_;
  std::mutex mutex_;
  std::string beginning_;
  std::streamoff size_ = 0;
  std::int64_t number_ = 1;
};

std::streamoff offset_of(const httplib::Request& request) {
  try {
    return std::max<std::streamoff>(0, std::stoll(request.get_param_value("from")));
  } catch (const std::exception&) {
    return 0;
  }
}

// Refuses requests with a foreign host name (403) or a method other than GET (405). Returns whether
// it has refused.
bool refuse(int port, const httplib::Request& request, httplib::Response& response) {
  const std::string host = request.get_header_value("Host");
  const bool is_known =
      host == fmt::format("{}:{}", kLoopback, port) || host == fmt::format("localhost:{}", port);
  if (is_known && request.method == "GET") return false;
  response.status = is_known ? 405 : 403;
  return true;
}

// Returns 128 random bits, in hexadecimal.
std::string random_token() {
  std::random_device device;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", static_cast<std::uint32_t>(device()));
  return token;
}

// Permits reuse of the port as soon as the previous server has ended. The default options of
// httplib would also permit sharing it with a running server.
void keep_the_port(socket_t socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

// Sends `text` uncompressed: httplib takes seconds to compress megabytes, and on one machine
// compression gains nothing.
void send(httplib::Response& response, std::string text, const char* type) {
  const std::size_t size = text.size();
  if (size == 0) return response.set_content("", type);
  response.set_content_provider(
      size, type,
      [text = std::move(text)](std::size_t from, std::size_t length, httplib::DataSink& sink) {
        return sink.write(text.data() + from, length);
      });
}

}  // namespace

void serve(const ServedLog& followed, int port,
           const std::function<void(const std::string&)>& begun,
           const std::function<bool()>& over) {
  httplib::Server server;
  GrowingFile log(followed.log);
  server.new_task_queue = [] { return new httplib::ThreadPool(2); };
  server.set_default_headers({{"Cache-Control", "no-store"},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Referrer-Policy", "no-referrer"}});
  server.set_keep_alive_max_count(1);  // so that stop() does not wait for idle connections
  server.set_socket_options(&keep_the_port);
  if (port == 0)
    port = server.bind_to_any_port(kLoopback);
  else if (!server.bind_to_port(kLoopback, port))
    port = -1;
  if (port < 0) throw InputError("--port", "", "is in use; expected a free port, or no --port");
  server.set_pre_routing_handler(
      [port](const httplib::Request& request, httplib::Response& response) {
        return refuse(port, request, response) ? httplib::Server::HandlerResponse::Handled
                                               : httplib::Server::HandlerResponse::Unhandled;
      });
  const std::string root = fmt::format("/{}/", random_token());
  server.Get(root, [&](const httplib::Request&, httplib::Response& response) {
    send(response, followed.page, "text/html; charset=utf-8");
  });
  server.Get(root + "log", [&](const httplib::Request& request, httplib::Response& response) {
    GrowingFile::Part part = log.read(offset_of(request), request.get_param_value("file"));
    response.set_header("X-Log", part.name);
    response.set_header("X-End", std::to_string(part.end));
    response.set_header("X-Size", std::to_string(part.size));
    send(response, std::move(part.text), "text/plain; charset=utf-8");
  });
  begun(fmt::format("http://{}:{}{}", kLoopback, port, root));
  std::jthread listening([&] { server.listen_after_bind(); });
  while (!server.is_running()) std::this_thread::sleep_for(kMoment);  // stop() has no effect before
  while (!over()) std::this_thread::sleep_for(kPause);
  server.stop();
}

}  // namespace grove::detail

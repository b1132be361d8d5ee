// SPDX-License-Identifier: MIT
#include "subprocess.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <thread>

namespace grove::detail {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kCannotStart = 127;

// A file in memory that the child reads or writes. Unlike a pipe, it never blocks the writer.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& text = "") : fd_(::memfd_create("file", MFD_CLOEXEC)) {
    const auto size = static_cast<ssize_t>(text.size());
    if (fd_ < 0 || ::pwrite(fd_, text.data(), text.size(), 0) != size)
      throw std::runtime_error("memfd_create failed");
  }
  ~MemoryFile() { ::close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int fd() const { return fd_; }
  std::string text() const {
    std::string text(static_cast<std::size_t>(::lseek(fd_, 0, SEEK_END)), '\0');
    const ssize_t size = ::pread(fd_, text.data(), text.size(), 0);
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return text;
  }

 private:
  int fd_;
};

// Executes the program in the forked child. Makes only async-signal-safe calls.
[[noreturn]] void exec_program(char* const* arguments, const ProcessOptions& options, int in,
                               int out, int err) {
  const rlimit limit{options.largest_file, options.largest_file};
  const bool ready =
      ::dup2(in, STDIN_FILENO) >= 0 && ::dup2(out, STDOUT_FILENO) >= 0 &&
      ::dup2(err, STDERR_FILENO) >= 0 &&
      (options.directory.empty() || ::chdir(options.directory.c_str()) == 0) &&
      (options.largest_file == RLIM_INFINITY || ::setrlimit(RLIMIT_FSIZE, &limit) == 0);
  if (ready) ::execv(arguments[0], arguments);
  ::_exit(kCannotStart);
}

pid_t start(const std::vector<std::string>& command, const ProcessOptions& options,
            const MemoryFile& in, const MemoryFile& out, const MemoryFile& err) {
  std::vector<char*> arguments;
  for (const std::string& argument : command)
    arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) exec_program(arguments.data(), options, in.fd(), out.fd(), err.fd());
  return child;
}

// Waits for the child, sends it the signal that `options` specifies, and kills it at the timeout.
// Returns the wait status.
int wait_for(pid_t child, const ProcessOptions& options, bool& timed_out) {
  const Clock::time_point begin = Clock::now();
  bool signalled = options.signal == 0;
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (!signalled && options.signal_when()) {
      ::kill(child, options.signal);
      signalled = true;
    }
    if (!timed_out && Clock::now() - begin >= options.timeout) {
      ::kill(child, SIGKILL);
      timed_out = true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return status;
}

}  // namespace

ProcessResult run_program(const std::vector<std::string>& command, const ProcessOptions& options) {
  const MemoryFile in(options.input);
  const MemoryFile out;
  const MemoryFile err;
  ProcessResult result;
  const int status = wait_for(start(command, options, in, out, err), options, result.timed_out);
  result.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  if (result.exit_code == kCannotStart) throw std::runtime_error("cannot start " + command.front());
  result.out = out.text();
  result.err = err.text();
  return result;
}

}  // namespace grove::detail

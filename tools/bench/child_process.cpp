// SPDX-License-Identifier: MIT
#include "tools/bench/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>

#include "io/file_descriptor.h"

namespace grove::detail::bench {
namespace {

constexpr int kPollInterval_ms = 100;

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

// Sets up the child and executes the program. Runs between fork() and exec(), therefore calls only
// async-signal-safe functions.
[[noreturn]] void exec_child(char* const* arguments, pid_t parent, int input, int output,
                             const rlimit* memory) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::setpgid(0, 0);
  const bool orphaned = ::getppid() != parent;  // the parent ended before prctl()
  if (memory != nullptr) ::setrlimit(RLIMIT_DATA, memory);
  if (!orphaned && ::dup2(input, STDIN_FILENO) >= 0 && ::dup2(output, STDOUT_FILENO) >= 0 &&
      ::dup2(output, STDERR_FILENO) >= 0)
    ::execv(arguments[0], arguments);
  ::_exit(kCannotBeStarted);
}

ChildEnd ended(pid_t pid) {
  int status = 0;
  rusage used{};
  while (::wait4(pid, &status, 0, &used) < 0)
    if (errno != EINTR) fail("wait4");
  ChildEnd end{.peak_memory_mb = static_cast<double>(used.ru_maxrss) * 1024 / 1e6};
  end.kind = WIFSIGNALED(status) ? ChildEnd::Kind::kSignalled : ChildEnd::Kind::kExited;
  end.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  return end;
}

// Kills a child and its process group, which the child may not have created yet. Call it before the
// child is reaped.
void kill_all(pid_t pid) {
  ::kill(-pid, SIGKILL);
  ::kill(pid, SIGKILL);
}

double system_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

ChildEnd run_child(const std::vector<std::string>& command,
                   const std::filesystem::path& output_file, const ChildLimits& limits) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const FileDescriptor input("/dev/null", O_RDONLY);
  if (!input.is_open()) fail("/dev/null");
  const FileDescriptor output(output_file, O_WRONLY | O_CREAT | O_TRUNC);
  if (!output.is_open()) fail(output_file.c_str());

  rlimit memory{};
  memory.rlim_cur = memory.rlim_max = static_cast<rlim_t>(limits.memory_gb.value_or(0) * 1e9);
  const pid_t parent = ::getpid();
  const std::function<double()> seconds = limits.clock ? limits.clock : system_seconds;
  const double start = seconds();
  const pid_t pid = ::fork();
  if (pid < 0) fail("fork");
  if (pid == 0)
    exec_child(arguments.data(), parent, input.get(), output.get(),
               limits.memory_gb ? &memory : nullptr);

  // glibc 2.36 declares pidfd_open() only for C.
  const FileDescriptor process(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
  if (!process.is_open()) {
    const int error = errno;
    ::kill(pid, SIGKILL);
    ended(pid);
    errno = error;
    fail("pidfd_open");
  }
  auto killed = ChildEnd::Kind::kExited;  // why the child was killed; kExited: it was not
  for (;;) {
    pollfd wait{process.get(), POLLIN, 0};
    if (::poll(&wait, 1, kPollInterval_ms) > 0) break;
    if (killed != ChildEnd::Kind::kExited) continue;
    if (limits.cancelled()) killed = ChildEnd::Kind::kCancelled;
    if (seconds() - start > limits.seconds) killed = ChildEnd::Kind::kTooLong;
    if (killed != ChildEnd::Kind::kExited) kill_all(pid);
  }
  kill_all(pid);  // remaining processes of its group
  const double wall_s = seconds() - start;
  ChildEnd end = ended(pid);
  end.wall_s = wall_s;
  const bool was_killed = end.kind == ChildEnd::Kind::kSignalled && end.code == SIGKILL;
  if (killed != ChildEnd::Kind::kExited && was_killed) end.kind = killed;
  return end;
}

}  // namespace grove::detail::bench

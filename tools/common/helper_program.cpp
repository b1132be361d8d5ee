// SPDX-License-Identifier: MIT
#include "tools/common/helper_program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "io/input_error.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

// Returns the folder of this program's executable, however it was started (PATH, symbolic link).
fs::path own_folder() {
  return fs::read_symlink("/proc/self/exe").parent_path();
}

// Returns the path of the installed program if it exists; otherwise its path in the folder of this
// program (build folder), where it may not exist.
fs::path place_of(const std::string& program) {
  const fs::path installed = own_folder().parent_path() / "libexec/grove" / program;
  return fs::exists(installed) ? installed : own_folder() / program;
}

// Returns only on failure.
void replace_process(const std::string& program, std::vector<std::string> arguments) {
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::execv(program.c_str(), argv.data());
}

}  // namespace

void replace_standard_input(std::string_view text) {
  // tmpfile() has no name, so the file is freed when the process ends.
  std::FILE* file = std::tmpfile();
  const bool is_written = file != nullptr &&
                          std::fwrite(text.data(), 1, text.size(), file) == text.size() &&
                          std::fflush(file) == 0;
  if (!is_written)
    throw InputError("a temporary file", "",
                     fmt::format("cannot be written: {}", std::strerror(errno)));
  std::rewind(file);
  ::dup2(::fileno(file), STDIN_FILENO);
}

std::string program_beside(const std::string& name) {
  const fs::path program = own_folder() / name;
  if (!fs::exists(program))
    throw InputError(program.string(), "", "there is no such program; expected it beside grove");
  return program.string();
}

void exec_program(const std::string& name, const std::vector<std::string>& arguments,
                  const std::string& package) {
  const std::string program = place_of(name).string();
  if (!fs::exists(program))
    throw InputError(program, "",
                     fmt::format("there is no such program; expected it beside grove (build target "
                                 "grove), or in ../libexec/grove (Debian package {})",
                                 package));
  replace_process(program, arguments);
  const int error = errno;
  // The program exists, so ENOENT refers to the interpreter in its first line.
  if (error == ENOENT)
    throw InputError(program, "",
                     "there is no /usr/bin/python3; expected the Debian package python3");
  throw InputError(program, "", fmt::format("cannot be run: {}", std::strerror(error)));
}

}  // namespace grove::detail

// SPDX-License-Identifier: MIT
// Output of a log to screen and file.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace grove::detail {

// Writes lines to the screen, to a file, to both or to neither. On a terminal it also shows a
// progress line, which the next output overwrites. If a line cannot be written to the screen or the
// file, warns on standard error and writes no more there.
class LogSink {
 public:
  // `screen`: stdout, stderr, or nullptr for no screen. `file`: "" for no file.
  // `may_show_progress`: false under mpirun, because a process that it starts sees a terminal even
  // if there is none. Throws InputError if the file cannot be opened.
  LogSink(std::FILE* screen, const std::filesystem::path& file, bool may_show_progress = true);

  void line(std::string_view text = "");
  // Prints a warning on standard error unless the log is on the screen.
  void warn_if_log_hidden(std::string_view text) const;
  bool shows_progress() const { return shows_progress_; }
  void progress(std::string_view text);

 private:
  static bool write(std::FILE* file, std::string_view text, const char* name);
  void erase_progress();

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::FILE* screen_;
  bool shows_progress_;
  bool progress_shown_ = false;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace grove::detail

// SPDX-License-Identifier: MIT
// Where the lines of a log go.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace grove::detail {

// Writes lines to the screen, to a file, to both or to neither; and on a terminal a progress line
// that the next line overwrites.
class LogSink {
 public:
  // `screen`: stdout or stderr; null: none. `file` empty: none; throws InputError when it cannot be
  // opened. `may_show_progress`: mpirun gives its programs a terminal even where there is none.
  LogSink(std::FILE* screen, const std::filesystem::path& file, bool may_show_progress = true);

  void line(std::string_view text = "");
  // Says it on stderr unless the log can be seen on the screen.
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

// SPDX-License-Identifier: MIT
#include "tools/solve/log_sink.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "io/input_error.h"
#include "tools/common/standard_error.h"

namespace grove::detail {

LogSink::LogSink(std::FILE* screen, const std::filesystem::path& file, bool may_show_progress)
    : screen_(screen),
      shows_progress_(screen && may_show_progress && ::isatty(::fileno(screen)) == 1) {
  if (file.empty()) return;
  file_.reset(std::fopen(file.c_str(), "w"));
  if (!file_)
    throw InputError(file.string(), "",
                     fmt::format("the log cannot be written: {}", std::strerror(errno)));
}

void LogSink::line(std::string_view text) {
  if (screen_) {
    erase_progress();
    const char* name = screen_ == stdout ? "standard output" : "standard error";
    if (!write(screen_, text, name)) screen_ = nullptr;
  }
  if (file_ && !write(file_.get(), text, "the log file")) file_.reset();
}

void LogSink::warn_if_log_hidden(std::string_view text) const {
  if (!screen_) print_to_stderr(fmt::format("grove: warning: {}", text));
}

// Writes a line. Returns false, after a warning on standard error, if that fails; the caller then
// closes this output and the run continues.
bool LogSink::write(std::FILE* file, std::string_view text, const char* name) {
  std::fprintf(file, "%.*s\n", static_cast<int>(text.size()), text.data());
  if (std::fflush(file) == 0 && std::ferror(file) == 0) return true;
  print_to_stderr(fmt::format("grove: warning: {} cannot be written ({}); the log ends here", name,
                              std::strerror(errno)));
  std::clearerr(file);
  return false;
}

void LogSink::progress(std::string_view text) {
  if (!screen_ || !shows_progress_) return;
  erase_progress();
  std::fwrite(text.data(), 1, text.size(), screen_);
  std::fflush(screen_);
  progress_shown_ = true;
}

void LogSink::erase_progress() {
  if (progress_shown_) std::fputs("\r\033[K", screen_);
  progress_shown_ = false;
}

}  // namespace grove::detail

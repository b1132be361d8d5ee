// SPDX-License-Identifier: MIT
// Splits a text that arrives in pieces into lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace grove::detail {

// Source of a text: writes up to `size` bytes to `buffer` and returns their number; 0 at the end.
using ByteSource = std::function<std::size_t(char* buffer, std::size_t size)>;

// Buffers the current line and some text after it. One thread at a time.
class LineStream {
 public:
  static constexpr std::size_t kMaxLineLength = std::size_t{1} << 22;  // bytes of a line
  // kLine: line() is the next line. kNone: the text has ended. kUnterminated: the text ends within
  // a line. kTooLong: the line is longer than kMaxLineLength, which is tested once per 64 kB.
  enum class Next : std::uint8_t { kLine, kNone, kUnterminated, kTooLong };

  explicit LineStream(ByteSource source);

  Next next();
  // The current line without its LF. Valid until the next call of next().
  std::string_view line() const;

 private:
  bool take_more();

  ByteSource source_;
  std::string text_;
  std::size_t size_ = 0;  // number of bytes in text_
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

}  // namespace grove::detail

// SPDX-License-Identifier: MIT
// Lines of a text that comes piece by piece.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace grove::detail {

// The bytes of a text: up to as many as the buffer has. None: no more.
using ByteSource = std::function<std::size_t(char* buffer, std::size_t size)>;

// Holds a line, and some that follow.
class LineStream {
 public:
  static constexpr std::size_t kLongest = std::size_t{1} << 22;
  enum class Next : std::uint8_t { kLine, kNone, kEndless, kTooLong };

  explicit LineStream(ByteSource source);

  Next next();
  // Without its end; until the next one.
  std::string_view line() const;

 private:
  bool take_more();

  ByteSource source_;
  std::string text_;
  std::size_t size_ = 0;  // of what is there
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

}  // namespace grove::detail

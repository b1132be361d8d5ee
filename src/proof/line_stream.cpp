// SPDX-License-Identifier: MIT
#include "proof/line_stream.h"

#include <cstring>
#include <utility>

namespace grove::detail {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 16;

}  // namespace

LineStream::LineStream(ByteSource source) : source_(std::move(source)), text_(kPiece, '\0') {}

LineStream::Next LineStream::next() {
  begin_ = end_;
  for (std::size_t seen = begin_;;) {
    const void* const lf = std::memchr(text_.data() + seen, '\n', size_ - seen);
    if (lf != nullptr) {
      end_ = static_cast<std::size_t>(static_cast<const char*>(lf) - text_.data()) + 1;
      return Next::kLine;
    }
    seen = size_ - begin_;
    if (seen > kMaxLineLength) return Next::kTooLong;
    if (!take_more()) return seen == 0 ? Next::kNone : Next::kUnterminated;
  }
}

std::string_view LineStream::line() const {
  return std::string_view(text_).substr(begin_, end_ - begin_ - 1);
}

// Moves the incomplete line to the front of the buffer and reads more text after it. Returns false
// at the end.
bool LineStream::take_more() {
  std::memmove(text_.data(), text_.data() + begin_, size_ - begin_);
  size_ -= std::exchange(begin_, 0);
  end_ = 0;
  if (text_.size() < size_ + kPiece) text_.resize(size_ + kPiece);
  const std::size_t count = source_(text_.data() + size_, kPiece);
  size_ += count;
  return count > 0;
}

}  // namespace grove::detail

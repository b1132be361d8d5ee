// SPDX-License-Identifier: MIT
// Bytes, compressed and back (Zstandard, RFC 8878), piece by piece.
#pragma once

#include <zstd.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace grove::detail {

class ZstdCompressor {
 public:
  // Is given what comes out.
  using Sink = std::function<void(std::string_view)>;
  explicit ZstdCompressor(Sink sink);

  void add(std::string_view bytes);
  // Whoever has all that came out so far can have all that went in.
  void flush() { put({}, ZSTD_e_flush); }
  // The stream ends with it; what is added behind it begins another one.
  void end() { put({}, ZSTD_e_end); }

 private:
  void put(std::string_view bytes, ZSTD_EndDirective how);

  Sink sink_;
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context_;
  std::string out_;
};

class ZstdDecompressor {
 public:
  // Is given what goes in: up to as many bytes as the buffer has. None: no more.
  using Source = std::function<std::size_t(char* buffer, std::size_t size)>;
  explicit ZstdDecompressor(Source source);

  // Up to so many bytes; fewer only at the end, or where the stream breaks off.
  std::size_t read(char* bytes, std::size_t size);
  // What came is no such stream.
  bool broken() const { return broken_; }

 private:
  Source source_;
  std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context_;
  std::string in_;
  ZSTD_inBuffer left_{};
  bool broken_ = false;
};

}  // namespace grove::detail

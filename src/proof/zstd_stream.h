// SPDX-License-Identifier: MIT
// Streaming compression and decompression (Zstandard, RFC 8878).
#pragma once

#include <zstd.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace grove::detail {

class ZstdCompressor {
 public:
  // Function that receives the compressed bytes.
  using Sink = std::function<void(std::string_view)>;
  explicit ZstdCompressor(Sink sink);

  void add(std::string_view bytes);
  // Passes enough output to the sink to decompress all input so far.
  void flush() { put({}, ZSTD_e_flush); }
  // Ends the frame. Bytes added later begin a new frame.
  void end() { put({}, ZSTD_e_end); }

 private:
  void put(std::string_view bytes, ZSTD_EndDirective how);

  Sink sink_;
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context_;
  std::string out_;
};

class ZstdDecompressor {
 public:
  // Source of compressed bytes: writes up to `size` bytes to `buffer` and returns their number; 0
  // at the end.
  using Source = std::function<std::size_t(char* buffer, std::size_t size)>;
  explicit ZstdDecompressor(Source source);

  // Reads `size` decompressed bytes, or fewer at the end of the input (also if a frame is
  // incomplete) or if the stream is broken. Returns their number.
  std::size_t read(char* bytes, std::size_t size);
  // True if the input is not a valid zstd stream.
  bool broken() const { return broken_; }

 private:
  Source source_;
  std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context_;
  std::string in_;
  ZSTD_inBuffer left_{};
  bool broken_ = false;
};

}  // namespace grove::detail

// SPDX-License-Identifier: MIT
#include "proof/zstd_stream.h"

#include <new>
#include <stdexcept>
#include <utility>

namespace grove::detail {

ZstdCompressor::ZstdCompressor(Sink sink)
    : sink_(std::move(sink)),
      context_(ZSTD_createCCtx(), &ZSTD_freeCCtx),
      out_(ZSTD_CStreamOutSize(), '\0') {
  if (!context_) throw std::bad_alloc();
}

void ZstdCompressor::add(std::string_view bytes) {
  put(bytes, ZSTD_e_continue);
}

void ZstdCompressor::put(std::string_view bytes, ZSTD_EndDirective how) {
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  for (std::size_t left = 1; left > 0;) {
    ZSTD_outBuffer out{out_.data(), out_.size(), 0};
    left = ZSTD_compressStream2(context_.get(), &out, &in, how);
    if (ZSTD_isError(left)) throw std::runtime_error(ZSTD_getErrorName(left));
    if (out.pos > 0) sink_({out_.data(), out.pos});
    if (how == ZSTD_e_continue && in.pos == in.size) break;
  }
}

ZstdDecompressor::ZstdDecompressor(Source source)
    : source_(std::move(source)),
      context_(ZSTD_createDCtx(), &ZSTD_freeDCtx),
      in_(ZSTD_DStreamInSize(), '\0') {
  if (!context_) throw std::bad_alloc();
}

std::size_t ZstdDecompressor::read(char* bytes, std::size_t size) {
  ZSTD_outBuffer out{bytes, size, 0};
  while (out.pos < out.size && !broken_) {
    if (left_.pos == left_.size) {
      left_ = {in_.data(), source_(in_.data(), in_.size()), 0};
      if (left_.size == 0) break;
    }
    broken_ = ZSTD_isError(ZSTD_decompressStream(context_.get(), &out, &left_)) != 0;
  }
  return out.pos;
}

}  // namespace grove::detail

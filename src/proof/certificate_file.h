// SPDX-License-Identifier: MIT
// Certificate files, compressed or not: reads their bytes and writes their lines.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/atomic_file.h"
#include "io/file_descriptor.h"
#include "proof/zstd_stream.h"

namespace grove::detail {

// Reads a certificate file and decompresses it if it is compressed. One thread at a time.
class CertificateBytes {
 public:
  // The constructor and read() throw InputError.
  explicit CertificateBytes(const std::filesystem::path& path);

  // Reads up to `size` decompressed bytes and returns their number; 0 at the end of the file.
  std::size_t read(char* buffer, std::size_t size);
  bool compressed() const { return stream_.has_value(); }

 private:
  std::size_t read_file(char* buffer, std::size_t size);

  const std::filesystem::path path_;
  const FileDescriptor file_;
  std::string first_;  // first bytes of the file, not yet returned by read()
  std::optional<ZstdDecompressor> stream_;
};

// Writes a certificate file by AtomicFile: it appears completely at commit(), or not at all, except
// that special files are written directly. All functions throw InputError. One thread at a time.
class CertificateOutput {
 public:
  CertificateOutput(const std::filesystem::path& file, bool compressed);

  void line(std::string_view text);
  // Completes the file and returns its size in bytes. Must be the last call.
  std::int64_t commit();

 private:
  void write(std::string_view bytes);

  AtomicFile file_;
  std::int64_t bytes_ = 0;
  std::optional<ZstdCompressor> compressor_;
  std::string plain_;  // buffer for writes without compression
};

}  // namespace grove::detail

// SPDX-License-Identifier: MIT
// Files of certificates, compressed or not: reading their bytes and writing their lines.
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

// Reads the file of a certificate and decompresses it if it is compressed.
class CertificateBytes {
 public:
  // Throws InputError, as read() does.
  explicit CertificateBytes(const std::filesystem::path& path);

  // Reads up to `size` bytes and returns their number, 0 at the end.
  std::size_t read(char* buffer, std::size_t size);
  bool compressed() const { return stream_.has_value(); }

 private:
  std::size_t read_file(char* buffer, std::size_t size);

  const std::filesystem::path path_;
  const FileDescriptor file_;
  std::string first_;  // first bytes of the file, not yet returned by read()
  std::optional<ZstdDecompressor> stream_;
};

// Writes a certificate to its file, which appears completely or not at all.
class CertificateOutput {
 public:
  CertificateOutput(const std::filesystem::path& file, bool compressed);

  void line(std::string_view text);
  // Completes the file and returns its size in bytes. Call once, last.
  std::int64_t commit();

 private:
  void write(std::string_view bytes);

  AtomicFile file_;
  std::int64_t bytes_ = 0;
  std::optional<ZstdCompressor> compressor_;
  std::string plain_;  // buffer that makes uncompressed writes large
};

}  // namespace grove::detail

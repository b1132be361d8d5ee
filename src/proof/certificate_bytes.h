// SPDX-License-Identifier: MIT
// Reads the file of a certificate and decompresses it if it is compressed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/file_descriptor.h"
#include "proof/zstd_stream.h"

namespace grove::detail {

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

}  // namespace grove::detail

// SPDX-License-Identifier: MIT
// Writes a certificate to its file, which appears completely or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "io/atomic_file.h"
#include "proof/zstd_stream.h"

namespace grove::detail {

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

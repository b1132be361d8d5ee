// SPDX-License-Identifier: MIT
// A certificate under way into its file, which appears whole or not at all.
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
  // To be called once, last. How many bytes the file has.
  std::int64_t commit();

 private:
  void write(std::string_view bytes);

  AtomicFile file_;
  std::int64_t bytes_ = 0;
  std::optional<ZstdCompressor> compressor_;
  std::string plain_;  // what is not compressed goes out in large pieces
};

}  // namespace grove::detail

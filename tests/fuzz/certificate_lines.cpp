// SPDX-License-Identifier: MIT
#include "tests/fuzz/certificate_lines.h"

#include <zstd.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace grove::detail::fuzz {

std::vector<std::string> certificate_lines(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string packed{std::istreambuf_iterator<char>(in), {}};
  std::string text;
  ZSTD_DCtx* const context = ZSTD_createDCtx();
  ZSTD_inBuffer from{packed.data(), packed.size(), 0};
  std::vector<char> buffer(ZSTD_DStreamOutSize());
  while (from.pos < from.size) {
    ZSTD_outBuffer to{buffer.data(), buffer.size(), 0};
    if (ZSTD_isError(ZSTD_decompressStream(context, &to, &from)))
      throw std::runtime_error("the certificate is not valid zstd data");
    text.append(buffer.data(), to.pos);
  }
  ZSTD_freeDCtx(context);
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace grove::detail::fuzz

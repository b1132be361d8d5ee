// SPDX-License-Identifier: MIT
#include "proof/certificate_output.h"

namespace grove::detail {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 16;

}  // namespace

CertificateOutput::CertificateOutput(const std::filesystem::path& file, bool compressed)
    : file_(file) {
  if (compressed) compressor_.emplace([this](std::string_view bytes) { write(bytes); });
}

void CertificateOutput::line(std::string_view text) {
  if (compressor_) {
    compressor_->add(text);
    return compressor_->add("\n");
  }
  plain_.append(text).push_back('\n');
  if (plain_.size() < kPiece) return;
  write(plain_);
  plain_.clear();
}

std::int64_t CertificateOutput::commit() {
  if (compressor_)
    compressor_->end();
  else
    write(plain_);
  file_.commit();
  return bytes_;
}

void CertificateOutput::write(std::string_view bytes) {
  bytes_ += std::ssize(bytes);
  file_.write(bytes);
}

}  // namespace grove::detail

// SPDX-License-Identifier: MIT
#include "proof/certificate_file.h"

#include <fcntl.h>
#include <unistd.h>

#include "io/input_error.h"

namespace grove::detail {
namespace {

constexpr std::string_view kZstd = "\x28\xB5\x2F\xFD";  // magic number of a zstd frame

}  // namespace

CertificateBytes::CertificateBytes(const std::filesystem::path& path)
    : path_(path), file_(path, O_RDONLY) {
  if (!file_.is_open()) fail_to_read(path_);
  while (first_.size() < kZstd.size()) {
    char byte = 0;
    if (read_file(&byte, 1) == 0) break;
    first_.push_back(byte);
  }
  if (first_ != kZstd) return;
  stream_.emplace([this](char* buffer, std::size_t size) {
    const std::size_t count = first_.copy(buffer, size);
    first_.erase(0, count);
    return count > 0 ? count : read_file(buffer, size);
  });
}

std::size_t CertificateBytes::read(char* buffer, std::size_t size) {
  if (stream_) {
    const std::size_t count = stream_->read(buffer, size);
    if (stream_->broken())
      throw InputError(path_.string(), "",
                       "is damaged; expected a file that grove solve --proof compressed by zstd");
    return count;
  }
  const std::size_t count = first_.copy(buffer, size);
  first_.erase(0, count);
  return count > 0 ? count : read_file(buffer, size);
}

std::size_t CertificateBytes::read_file(char* buffer, std::size_t size) {
  const ssize_t count = ::read(file_.get(), buffer, size);
  if (count < 0) fail_to_read(path_);
  return static_cast<std::size_t>(count);
}

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

// SPDX-License-Identifier: MIT
// Proof log files: each process writes one while it searches, and a certificate is made from all.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "search/proof_log.h"

namespace grove::detail {

// Logs all calls to a compressed file, in order. Thread-safe. Buffers about 4 MB, nearly all of it
// for the compression. If the disk is full, it removes the file and logs nothing more: the search
// continues, and its plan needs the space. A certificate without this file proves less, never too
// much.
class ProofRecorder : public ProofLog {
 public:
  // Throws InputError if the file cannot be created.
  explicit ProofRecorder(std::filesystem::path path);
  ~ProofRecorder() override;

  void tree(const ProofTree& tree) override;
  void split(const ProofSplit& split) override;
  void bound(ProofKey node, Cost cost, Cost bound, std::span<const ProofExcess> excesses) override;
  void lemma(const ProofLemma& lemma, ProofKey root, std::span<const ProofSplit> splits) override;
  void prices(Cost bound, std::span<const RowMultiplier> rows) override;
  void joint(Cost bound) override;

  // Writes everything logged so far to the file. Returns the error message if that failed, else an
  // empty string.
  std::string flush();

 private:
  class Stream;
  const std::unique_ptr<Stream> stream_;
};

// Replays a file to `log`, in the order in which it was written. A file that ends within an entry,
// because its process was killed, is read up to that entry. Throws InputError if the file cannot be
// read or was not written by a ProofRecorder.
void read_proof_part(const std::filesystem::path& path, ProofLog& log);

}  // namespace grove::detail

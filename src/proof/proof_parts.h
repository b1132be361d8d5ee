// SPDX-License-Identifier: MIT
// Proof log files. Each process writes one file during its search; write_certificate() reads all of
// them.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "search/proof_log.h"

namespace grove::detail {

// Logs all calls to a compressed file, in order. Thread-safe. Buffers about 4 MB, nearly all of it
// in the compressor. If a write fails, for instance because the disk is full, it removes the file
// and logs nothing more: the search continues and needs the space for its plan. A certificate made
// without this file can only prove a smaller bound, never a wrong one.
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
  void formula(FormulaKind kind, std::span<const std::int64_t> numbers) override;
  void formula_bound(Cost bound) override;

  // Writes all entries so far to the file. Returns the error message of the first failed write; ""
  // if none failed.
  std::string flush();

 private:
  class Stream;
  const std::unique_ptr<Stream> stream_;
};

// Replays the entries of a file to `log`, in the order of the file. If the file ends within an
// entry, because its process was killed, it is read up to this entry. Throws InputError if the file
// cannot be read or was not written by a ProofRecorder.
void read_proof_part(const std::filesystem::path& path, ProofLog& log);

}  // namespace grove::detail

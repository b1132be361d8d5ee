// SPDX-License-Identifier: MIT
// What processes write down while they search, until a certificate is made of it.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "search/proof_log.h"

namespace grove::detail {

// Writes all that it is told to a file, compressed, as it comes; holds no more than some hundred
// kilobytes. When the disk is full, it removes the file and records nothing more: the search goes
// on, and its plan needs the space. A certificate without this file proves less, never too much.
class ProofRecorder : public ProofLog {
 public:
  // Throws InputError when the file cannot be created.
  explicit ProofRecorder(std::filesystem::path path);
  ~ProofRecorder() override;

  void tree(const ProofTree& tree) override;
  void split(const ProofSplit& split) override;
  void bound(ProofKey node, Cost cost, Cost bound, std::span<const ProofExcess> excesses) override;
  void lemma(const ProofLemma& lemma, ProofKey root, std::span<const ProofSplit> splits) override;
  void prices(Cost bound, std::span<const RowMultiplier> rows) override;
  void joint(Cost bound) override;

  // All that was said so far is in the file then. Returns why it is not: empty if it is.
  std::string flush();

 private:
  class Stream;
  const std::unique_ptr<Stream> stream_;
};

// Tells `log` again what a file has, in the order in which it was written. A file that ends within
// something - its process was killed - is read up to there. Throws InputError for one that cannot
// be read, or was not written by a recorder.
void read_proof_part(const std::filesystem::path& path, ProofLog& log);

}  // namespace grove::detail

// SPDX-License-Identifier: MIT
// Checkpoint file from which a search can resume: DIR/checkpoint.grove, written atomically.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/solve.h"
#include "io/atomic_file.h"
#include "model/plan.h"
#include "search/node_record.h"
#include "search/tree_record.h"

namespace grove::detail {

// Everything in a checkpoint except the nodes.
//
// To resume under kFixed, the caller must check that the first trees of the forest are the trees
// recorded here. Skipping trees_instantiated trees is not enough: the sequencing back ends break
// ties differently, so the forest could skip trees that were never instantiated, and then the lower
// bound would be wrong.
struct CheckpointHeader {
  std::uint64_t fingerprint = 0;        // of the instance; see model/fingerprint.h
  Policy policy = Policy::kFree;        // not kAuto
  std::optional<Plan> incumbent;        // by AgentIndex and TaskIndex of that instance
  Cost lower_bound = 0;                 // proven: no plan costs less
  Cost evicted_bound = kInfiniteCost;   // least bound of evicted nodes; kInfiniteCost: none
  std::int64_t trees_instantiated = 0;  // trees instantiated so far; >= trees.size()
  std::vector<TreeRecord> trees;        // by number; includes the tree of each node
  std::map<std::string, std::int64_t> counters;  // of all runs so far, by name: nodes_expanded, ...
  double seconds = 0;                            // duration of all runs so far
};

// Returns the path of the checkpoint file in `directory`.
std::filesystem::path checkpoint_file(const std::filesystem::path& directory);

// Writes a checkpoint node by node, with a buffer of about 256 KiB. finish() replaces the previous
// checkpoint; if it fails or is not called, the previous checkpoint remains. Throws InputError with
// file and reason if the file cannot be written (no such directory, no permission, full disk). For
// SIGXFSZ see io/atomic_file.h. One thread at a time.
class CheckpointWriter {
 public:
  // `directory` must exist. Throws std::invalid_argument for the policy kAuto.
  CheckpointWriter(const std::filesystem::path& directory, const CheckpointHeader& header);

  // Writes a node. Throws std::invalid_argument if its tree is not in the header.
  void add(NodeRecord node);
  // Completes the file and replaces the previous checkpoint. Must be called once, last.
  void finish();

 private:
  void write_trees(const std::vector<TreeRecord>& trees);
  void write_nodes();
  void write(std::uint32_t kind, std::string_view content);

  AtomicFile file_;
  std::uint32_t checksum_;  // CRC of all heads and contents so far
  std::size_t trees_;
  std::uint64_t nodes_ = 0;
  std::vector<NodeRecord> waiting_;  // nodes of the next block
  std::size_t waiting_bytes_ = 0;
};

// Reads a checkpoint node by node. Throws InputError with the file, what was found and what was
// expected, if the file cannot be read, is damaged, or has a different format version, instance or
// policy. Damage is detected only when the reader reaches it, so the data are known to be intact
// only once next() has returned nullopt. The reader does not check that paths and cells belong to
// the instance; Trees::add() and node_of() do. One thread at a time.
class CheckpointReader {
 public:
  // `fingerprint` and `policy`: the values expected in the file. Throws std::invalid_argument for
  // the policy kAuto.
  CheckpointReader(const std::filesystem::path& directory, std::uint64_t fingerprint,
                   Policy policy);
  ~CheckpointReader();

  const CheckpointHeader& header() const { return header_; }
  // Returns the next node, or nullopt after the last.
  std::optional<NodeRecord> next();

 private:
  class Blocks;

  void read_header(std::uint64_t fingerprint, Policy policy);
  void read_trees(std::uint64_t count);
  void read_end(std::string_view content);

  std::unique_ptr<Blocks> blocks_;
  CheckpointHeader header_;
  std::vector<NodeRecord> nodes_;  // nodes of the block read last
  std::size_t next_ = 0;           // position in nodes_
  std::uint64_t nodes_read_ = 0;   // number of nodes in all blocks read
  bool ended_ = false;
};

}  // namespace grove::detail

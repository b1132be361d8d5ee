// SPDX-License-Identifier: MIT
// Checkpoint file of a search, to resume from: DIR/checkpoint.grove. It is written atomically.
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

// Everything in a checkpoint except the nodes. A value.
//
// To resume under kFixed, the caller must check that the forest first makes the same trees, not
// only as many. The sequencing back ends break ties differently, so skipping a number of trees may
// skip other trees than those instantiated, and then the lower bound would be wrong.
struct CheckpointHeader {
  std::uint64_t fingerprint = 0;        // of the instance; see model/fingerprint.h
  Policy policy = Policy::kFree;        // not kAuto
  std::optional<Plan> incumbent;        // by AgentIndex and TaskIndex of that instance
  Cost lower_bound = 0;                 // proven: no plan costs less
  Cost evicted_bound = kInfiniteCost;   // least bound of evicted nodes; kInfiniteCost: none
  std::int64_t trees_instantiated = 0;  // by the forest so far; >= trees.size()
  std::vector<TreeRecord> trees;        // by number; includes the tree of each node
  std::map<std::string, std::int64_t> counters;  // of the run so far, by name: nodes_expanded, ...
  double seconds = 0;                            // of the run so far
};

// DIR/checkpoint.grove.
std::filesystem::path checkpoint_file(const std::filesystem::path& directory);

// Writes a checkpoint node by node; buffers some hundred nodes. The previous checkpoint remains
// until finish() has succeeded, and for good if this is destroyed before. One thread at a time.
// Throws InputError with file and reason if the file cannot be written (no such directory, no
// permission, full disk). For SIGXFSZ see io/atomic_file.h.
class CheckpointWriter {
 public:
  // `directory` must exist. Throws std::invalid_argument for the policy kAuto.
  CheckpointWriter(const std::filesystem::path& directory, const CheckpointHeader& header);

  // Throws std::invalid_argument for a node of a tree that is not in the header.
  void add(NodeRecord node);
  // Call once, last.
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

// Reads a checkpoint node by node. One thread at a time. Throws InputError with the file, what was
// found and what was expected, if the file cannot be read, is damaged, or is of another format
// version, instance or policy. Damage is detected only when it is reached: the data read are valid
// only once next() has returned nullopt. Trees::add() and node_of() check that paths and cells are
// of the instance.
class CheckpointReader {
 public:
  // `fingerprint` and `policy`: the expected ones.
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
  std::uint64_t nodes_read_ = 0;   // from all blocks
  bool ended_ = false;
};

}  // namespace grove::detail

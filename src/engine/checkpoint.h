// SPDX-License-Identifier: MIT
// The state of a search in a file, to go on from later: DIR/checkpoint.grove, whole or not at all.
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

// What is known beside the nodes. A value.
//
// Who goes on from here under kFixed must see to it that the forest has the same trees first, not
// only as many: the back ends of sequencing break ties each in its own way, so that skipping a
// number of trees may skip others than those instantiated, and with them a bound.
struct CheckpointHeader {
  std::uint64_t fingerprint = 0;        // of the instance; see model/fingerprint.h
  Policy policy = Policy::kFree;        // not kAuto
  std::optional<Plan> incumbent;        // by AgentIndex and TaskIndex, of that instance
  Cost lower_bound = 0;                 // proven: no plan costs less
  Cost evicted_bound = kInfiniteCost;   // the least bound of nodes given up; none was if infinite
  std::int64_t trees_instantiated = 0;  // by the forest so far; at least as many as trees.size()
  std::vector<TreeRecord> trees;        // by number; those that nodes belong to are among them
  std::map<std::string, std::int64_t> counters;  // of the run so far, by name: nodes_expanded, ...
  double seconds = 0;                            // spent so far
};

// DIR/checkpoint.grove.
std::filesystem::path checkpoint_file(const std::filesystem::path& directory);

// Writes a checkpoint, node by node; memory for some hundred nodes. The one before it stands until
// finish() has succeeded, and for good if this is destroyed before. For one thread. Throws
// InputError, with the file and the reason, when it cannot be written (no such folder, no
// permission, a full disk); see grove/io/atomic_file.h on SIGXFSZ.
class CheckpointWriter {
 public:
  // `directory` must exist. Throws std::invalid_argument for the policy kAuto.
  CheckpointWriter(const std::filesystem::path& directory, const CheckpointHeader& header);

  // Throws std::invalid_argument for a node of a tree that is not in the header.
  void add(NodeRecord node);
  // To be called once, last.
  void finish();

 private:
  void write_trees(const std::vector<TreeRecord>& trees);
  void write_nodes();
  void write(std::uint32_t kind, std::string_view content);

  AtomicFile file_;
  std::uint32_t checksum_;  // of all so far
  std::size_t trees_;
  std::uint64_t nodes_ = 0;
  std::vector<NodeRecord> waiting_;  // to be written as one block
  std::size_t waiting_bytes_ = 0;
};

// Reads a checkpoint, node by node. For one thread. Throws InputError, with the file, what was
// found and what was expected, for a file that cannot be read, is damaged, or is of another format
// version, instance or policy. Damage further on shows when it is come upon: what was read is good
// only once next() has returned none. That paths and cells are of the instance is for Trees::add()
// and node_of() to check.
class CheckpointReader {
 public:
  // `fingerprint` and `policy`: the expected ones.
  CheckpointReader(const std::filesystem::path& directory, std::uint64_t fingerprint,
                   Policy policy);
  ~CheckpointReader();

  const CheckpointHeader& header() const { return header_; }
  // The next node; none after the last.
  std::optional<NodeRecord> next();

 private:
  class Blocks;

  void read_header(std::uint64_t fingerprint, Policy policy);
  void read_trees(std::uint64_t count);
  void read_end(std::string_view content);

  std::unique_ptr<Blocks> blocks_;
  CheckpointHeader header_;
  std::vector<NodeRecord> nodes_;  // of the block read last
  std::size_t next_ = 0;           // of them
  std::uint64_t nodes_read_ = 0;   // from all blocks
  bool ended_ = false;
};

}  // namespace grove::detail

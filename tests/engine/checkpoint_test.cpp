// SPDX-License-Identifier: MIT
#include "engine/checkpoint.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <string>

#include "engine/serialize.h"
#include "model/fingerprint.h"
#include "search/expander.h"
#include "search/sequence_forest.h"
#include "tests/primal/crowd.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace checkpoint_test {

using Names = std::vector<std::string>;

// A checkpoint in memory: its header and all its nodes.
struct Whole {
  CheckpointHeader header;
  std::vector<NodeRecord> nodes;
};

// Search nodes generated breadth-first from the roots of the first five trees of a forest with
// fixed sequences. The roots are not included.
class Search {
 public:
  Search() {
    std::vector<NodePtr> open;
    for (int tree = 0; tree < 5; ++tree) open.push_back(forest_.next_root());
    for (const NodePtr& root : open) trees_.push_back(&root->tree());
    for (std::size_t i = 0; i < open.size() && open.size() < 10'005; ++i) {
      const Expansion expansion = expander_.expand(open[i], kInfiniteCost, limits_);
      open.insert(open.end(), expansion.children.begin(), expansion.children.end());
    }
    nodes_.assign(open.begin() + 5, open.end());
  }

  Whole whole(std::size_t max_nodes) const {
    Whole whole;
    for (const Tree* tree : trees_) whole.header.trees.push_back(record_of(*tree));
    for (std::size_t i = 0; i < nodes_.size() && i < max_nodes; ++i) {
      whole.nodes.push_back(record_of(*nodes_[i]));
    }
    whole.header.fingerprint = fingerprint(instance_);
    whole.header.policy = Policy::kFixed;
    whole.header.incumbent = Plan{90, {{50, {1, 0}, {3, 4, 4}}, {40, {}, {7}}}};
    whole.header.lower_bound = 77;
    whole.header.evicted_bound = 80;
    whole.header.trees_instantiated = 9;
    whole.header.counters = {{"nodes_expanded", 123'456'789'012}, {"roots_generated", 9}};
    whole.header.seconds = 12.5;
    return whole;
  }

  const Instance& instance() const { return instance_; }
  const Problem& problem() const { return problem_; }

 private:
  Limits limits_;
  Instance instance_ =
      testing::random_crowd({.size = 10, .obstacles = 25, .agents = 12, .tasks = 12}, 5);
  Problem problem_{instance_, limits_};
  AgentStopsCache stops_{instance_, problem_.distances};
  NodePool pool_;
  SequenceForest forest_{problem_, pool_, RtspBackend::kAuto, limits_};
  Expander expander_{problem_, stops_, {Techniques(), 0}};
  std::vector<const Tree*> trees_;
  std::vector<NodePtr> nodes_;
};

const Search& search() {
  static const Search search;
  return search;
}

void write(const std::filesystem::path& directory, const Whole& whole) {
  CheckpointWriter writer(directory, whole.header);
  for (const NodeRecord& node : whole.nodes) writer.add(node);
  writer.finish();
}

Whole read(const std::filesystem::path& directory, std::uint64_t fingerprint, Policy policy) {
  CheckpointReader reader(directory, fingerprint, policy);
  Whole whole{reader.header(), {}};
  while (auto node = reader.next()) whole.nodes.push_back(std::move(*node));
  EXPECT_FALSE(reader.next());  // stays nullopt after the end
  return whole;
}

Whole read(const std::filesystem::path& directory) {
  return read(directory, fingerprint(search().instance()), Policy::kFixed);
}

void expect_same(const Whole& found, const Whole& expected) {
  EXPECT_EQ(found.header.fingerprint, expected.header.fingerprint);
  EXPECT_EQ(found.header.policy, expected.header.policy);
  EXPECT_EQ(to_bytes(found.header.incumbent), to_bytes(expected.header.incumbent));
  EXPECT_EQ(found.header.lower_bound, expected.header.lower_bound);
  EXPECT_EQ(found.header.evicted_bound, expected.header.evicted_bound);
  EXPECT_EQ(found.header.trees_instantiated, expected.header.trees_instantiated);
  EXPECT_EQ(found.header.trees, expected.header.trees);
  EXPECT_EQ(found.header.counters, expected.header.counters);
  EXPECT_EQ(found.header.seconds, expected.header.seconds);
  EXPECT_EQ(found.nodes, expected.nodes);
}

TEST(Checkpoint, RoundTripsWithTenThousandNodes) {
  const TemporaryDirectory directory;
  const Whole whole = search().whole(10'000);
  ASSERT_EQ(whole.nodes.size(), 10'000u);
  write(directory.path(), whole);
  EXPECT_EQ(directory.files(), Names{"checkpoint.grove"});
  expect_same(read(directory.path()), whole);
}

// Reads a checkpoint in the same way as a resumed run.
TEST(Checkpoint, RestoresTreesAndNodes) {
  const TemporaryDirectory directory;
  const Whole whole = search().whole(300);
  write(directory.path(), whole);
  const Whole found = read(directory.path());
  NodePool pool;
  AgentStopsCache stops(search().instance(), search().problem().distances);
  Trees trees(search().problem(), stops, pool);
  std::vector<NodePtr> roots;
  for (const TreeRecord& tree : found.header.trees)
    roots.push_back(trees.add(tree, static_cast<std::uint32_t>(roots.size())));
  for (std::size_t i = 0; i < found.nodes.size(); ++i) {
    const NodeRecord& node = found.nodes[i];
    const NodePtr restored = node_of(node, roots[node.tree], search().instance());
    EXPECT_EQ(record_of(*restored), whole.nodes[i]);
  }
}

TEST(Checkpoint, MayBeEmpty) {
  const TemporaryDirectory directory;
  CheckpointHeader header;
  header.policy = Policy::kFree;
  CheckpointWriter(directory.path(), header).finish();
  expect_same(read(directory.path(), 0, Policy::kFree), {header, {}});
}

TEST(Checkpoint, RoundTripsWithManyTrees) {
  const TemporaryDirectory directory;
  Whole whole = search().whole(0);
  while (whole.header.trees.size() < 4000) whole.header.trees.push_back(whole.header.trees.back());
  write(directory.path(), whole);
  EXPECT_GT(file_content(checkpoint_file(directory.path())).size(), 600'000u);
  expect_same(read(directory.path()), whole);
}

TEST(Checkpoint, ReplacesTheLastCheckpointWhenFinished) {
  const TemporaryDirectory directory;
  const Whole before = search().whole(10);
  const Whole after = search().whole(2000);
  write(directory.path(), before);
  CheckpointWriter writer(directory.path(), after.header);
  for (const NodeRecord& node : after.nodes) writer.add(node);
  expect_same(read(directory.path()), before);
  writer.finish();
  expect_same(read(directory.path()), after);
}

TEST(Checkpoint, AbandonedWriterKeepsTheLastCheckpoint) {
  const TemporaryDirectory directory;
  const Whole before = search().whole(10);
  write(directory.path(), before);
  {
    CheckpointWriter writer(directory.path(), before.header);
    for (const NodeRecord& node : search().whole(2000).nodes) writer.add(node);
  }
  expect_same(read(directory.path()), before);
  EXPECT_EQ(directory.files(), Names{"checkpoint.grove"});
}

TEST(Checkpoint, ProcessKilledWhileWritingKeepsTheLastCheckpoint) {
  const TemporaryDirectory directory;
  const Whole before = search().whole(10);
  const Whole after = search().whole(5000);
  write(directory.path(), before);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    CheckpointWriter writer(directory.path(), after.header);
    for (const NodeRecord& node : after.nodes) writer.add(node);
    ::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  expect_same(read(directory.path()), before);
  write(directory.path(), after);
  expect_same(read(directory.path()), after);
}

TEST(Checkpoint, FullDiskIsAnErrorAndKeepsTheLastCheckpoint) {
  const TemporaryDirectory directory;
  const Whole before = search().whole(10);
  const Whole after = search().whole(5000);
  write(directory.path(), before);
  std::string message;
  {
    const FileSizeLimit limit(500'000);
    message = refusal([&] { write(directory.path(), after); });
  }
  EXPECT_EQ(message, "checkpoint.grove: cannot be written: File too large");
  expect_same(read(directory.path()), before);
  EXPECT_EQ(directory.files(), Names{"checkpoint.grove"});

  const TemporaryDirectory full;
  std::filesystem::create_symlink("/dev/full", checkpoint_file(full.path()));
  EXPECT_EQ(refusal([&] { write(full.path(), before); }),
            "checkpoint.grove: cannot be written: No space left on device");
}

TEST(Checkpoint, InvalidDirectoryIsAnError) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("file", "");
  const auto message = [](const std::filesystem::path& path, auto act) {
    return refusal([&] { act(path); });
  };
  const auto writes = [](const auto& path) { write(path, search().whole(1)); };
  const auto reads = [](const auto& path) { read(path); };
  EXPECT_EQ(message(directory / "missing", writes),
            "checkpoint.grove: cannot be written: No such file or directory");
  EXPECT_EQ(message(file, writes), "checkpoint.grove: cannot be written: Not a directory");
  EXPECT_EQ(message(directory.path(), reads),
            "checkpoint.grove: cannot be read: No such file or directory");
  EXPECT_EQ(message(file, reads), "checkpoint.grove: cannot be read: Not a directory");
  std::filesystem::create_directory(checkpoint_file(directory.path()));
  EXPECT_EQ(message(directory.path(), reads), "checkpoint.grove: cannot be read: Is a directory");
}

TEST(Checkpoint, WriterRefusesInvalidContents) {
  const TemporaryDirectory directory;
  CheckpointHeader header = search().whole(0).header;
  NodeRecord stray;
  stray.tree = 5;
  EXPECT_THROW(CheckpointWriter(directory.path(), header).add(stray), std::invalid_argument);
  header.policy = Policy::kAuto;
  EXPECT_THROW(CheckpointWriter(directory.path(), header), std::invalid_argument);
  EXPECT_TRUE(directory.files().empty());
}

// A small checkpoint in bytes. Tests modify the bytes and check how they are read.
class DamagedCheckpoint : public ::testing::Test {
 protected:
  DamagedCheckpoint() {
    write(directory_.path(), search().whole(6));
    bytes_ = file_content(checkpoint_file(directory_.path()));
  }

  std::string read_result(std::string_view bytes) {
    directory_.write("checkpoint.grove", bytes);
    return refusal([&] { read(directory_.path()); });
  }
  void expect_damage_found(const std::string& bytes, const char* place, std::size_t offset) {
    const std::string message = read_result(bytes);
    EXPECT_TRUE(message.find("is damaged") != std::string::npos ||
                message.find("is not a checkpoint") != std::string::npos ||
                message.find("of format version") != std::string::npos)
        << place << ' ' << offset << ": " << message;
  }

  TemporaryDirectory directory_;
  std::string bytes_;
};

TEST_F(DamagedCheckpoint, IsAcceptedUnchanged) {
  EXPECT_EQ(read_result(bytes_), "accepted");
}

TEST_F(DamagedCheckpoint, IsRefusedIfTruncated) {
  for (std::size_t size = 0; size < bytes_.size(); ++size)
    expect_damage_found(bytes_.substr(0, size), "cut at", size);
}

TEST_F(DamagedCheckpoint, IsRefusedIfABitIsFlipped) {
  for (std::size_t byte = 0; byte < bytes_.size(); ++byte) {
    std::string damaged = bytes_;
    damaged[byte] = static_cast<char>(damaged[byte] ^ 1 << byte % 8);
    expect_damage_found(damaged, "flipped in byte", byte);
  }
}

TEST_F(DamagedCheckpoint, IsRefusedIfBytesAreOverwritten) {
  std::mt19937 random(11);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = bytes_;
    const std::size_t begin = random() % bytes_.size();
    const std::size_t end = std::min(bytes_.size(), begin + 1 + random() % 600);
    const bool torn = random() % 2 == 0;
    for (std::size_t byte = begin; byte < end; ++byte)
      damaged[byte] = static_cast<char>(torn ? 0 : random());
    if (damaged != bytes_) expect_damage_found(damaged, "noise from", begin);
  }
}

TEST_F(DamagedCheckpoint, IsRefusedIfBytesFollowItsEnd) {
  expect_damage_found(bytes_ + '\0', "behind", bytes_.size());
  expect_damage_found(bytes_ + bytes_, "behind", bytes_.size());
}

// Returns the offset of each block, followed by that of the end of the file.
std::vector<std::size_t> block_begins(const std::string& bytes) {
  std::vector<std::size_t> begins{12};
  while (begins.back() < bytes.size()) {
    std::size_t length = 0;
    for (int i = 0; i < 8; ++i)
      length |= std::size_t{static_cast<unsigned char>(bytes[begins.back() + 4 + i])} << 8 * i;
    begins.push_back(begins.back() + 12 + length + 4);
  }
  return begins;
}

// Each block is intact, with a correct checksum, but the blocks are lost, doubled or swapped.
TEST_F(DamagedCheckpoint, IsRefusedIfBlocksAreLostDoubledOrSwapped) {
  write(directory_.path(), search().whole(5000));
  bytes_ = file_content(checkpoint_file(directory_.path()));
  const std::vector<std::size_t> begins = block_begins(bytes_);
  ASSERT_GE(begins.size(), 6u);
  const auto block = [&](std::size_t k) {
    return bytes_.substr(begins[k], begins[k + 1] - begins[k]);
  };
  for (std::size_t k = 0; k + 1 < begins.size(); ++k) {
    std::string lost = bytes_;
    lost.erase(begins[k], block(k).size());
    expect_damage_found(lost, "lost block", k);
    std::string doubled = bytes_;
    doubled.insert(begins[k], block(k));
    expect_damage_found(doubled, "doubled block", k);
    if (k == 0) continue;
    std::string swapped = bytes_;
    swapped.replace(begins[k - 1], begins[k + 1] - begins[k - 1], block(k) + block(k - 1));
    expect_damage_found(swapped, "swapped block", k);
  }
}

// A length above the file size is refused before memory for it is allocated.
TEST_F(DamagedCheckpoint, IsRefusedIfALengthExceedsTheFile) {
  bytes_.replace(16, 8, std::string(6, '\xff') + '\x0f' + '\0');
  EXPECT_EQ(read_result(bytes_),
            "checkpoint.grove: byte 12: is damaged: has a block of 4503599627370495 bytes; "
            "expected at most " +
                std::to_string(bytes_.size() - 24) + ", the bytes left");
}

TEST_F(DamagedCheckpoint, IsRefusedIfOfAnotherVersionOrKind) {
  std::string later = bytes_;
  later[8] = 7;
  EXPECT_EQ(read_result(later),
            "checkpoint.grove: is a checkpoint of format version 7; expected version 3");
  EXPECT_EQ(read_result("{\"status\": \"optimal\"}"),
            "checkpoint.grove: is not a checkpoint: begins with '{\"status'; expected 'GROVE-CP'");
  EXPECT_EQ(read_result(""),
            "checkpoint.grove: is not a checkpoint: begins with ''; expected 'GROVE-CP'");
}

TEST_F(DamagedCheckpoint, IsRefusedIfOfAnotherInstanceOrPolicy) {
  Whole other = search().whole(1);
  other.header.fingerprint = 0xABC;
  write(directory_.path(), other);
  EXPECT_EQ(refusal([&] { read(directory_.path(), 0x123, Policy::kFixed); }),
            "checkpoint.grove: is a checkpoint of another instance: found fingerprint "
            "0000000000000abc; expected 0000000000000123");
  EXPECT_EQ(refusal([&] { read(directory_.path(), 0xABC, Policy::kFree); }),
            "checkpoint.grove: is a checkpoint of policy fixed; expected policy free");
  EXPECT_EQ(refusal([&] { read(directory_.path(), 0xABC, Policy::kFixed); }), "accepted");
}

}  // namespace checkpoint_test
}  // namespace grove::detail

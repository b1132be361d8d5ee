// SPDX-License-Identifier: MIT
// Layout of a checkpoint file; numbers are little-endian:
// - magic (8 bytes), version (4 bytes), then blocks.
// - Block: kind (4 bytes), length of the content (8 bytes), content (see serialize.h), CRC-32 (4
//   bytes).
// - Blocks in order: one HEAD, the TREE blocks, the NODE blocks, and one ENDS with the number of
//   nodes. Nothing follows ENDS, so a truncated file has no ENDS.
//
// The CRC of a block covers the whole file up to that CRC, except the earlier CRCs. Therefore
// changed, lost, duplicated and reordered blocks are detected. The earlier CRCs are excluded
// because the CRC of data followed by its own CRC is a constant.
#include "engine/checkpoint.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "engine/serialize.h"
#include "io/input_error.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "GROVE-CP";
constexpr std::uint32_t kVersion = 3;
constexpr std::size_t kBlockBytes = std::size_t{1} << 18;  // approximate size of a block's content
constexpr std::size_t kBlockHeadBytes = 12;
constexpr std::size_t kChecksumBytes = 4;

constexpr std::uint32_t kind_of(std::string_view name) {
  std::uint32_t kind = 0;
  for (std::size_t i = 0; i < 4; ++i) kind |= static_cast<std::uint32_t>(name[i]) << 8 * i;
  return kind;
}
constexpr std::uint32_t kHead = kind_of("HEAD");
constexpr std::uint32_t kTrees = kind_of("TREE");
constexpr std::uint32_t kNodes = kind_of("NODE");
constexpr std::uint32_t kEnd = kind_of("ENDS");

// The header without its trees.
struct Head {
  std::uint64_t fingerprint = 0;
  std::uint8_t policy = 0;
  std::optional<Plan> incumbent;
  Cost lower_bound = 0;
  Cost evicted_bound = 0;
  std::int64_t trees_instantiated = 0;
  std::uint64_t trees = 0;
  std::map<std::string, std::int64_t> counters;
  double seconds = 0;
};

template <class Archive>
void serialize(Archive& archive, Head& head) {
  archive(head.fingerprint, head.policy, head.incumbent, head.lower_bound, head.evicted_bound,
          head.trees_instantiated, head.trees, head.counters, head.seconds);
}

// Values of Policy in the file. They are separate from the enumerators, whose values can change.
constexpr std::uint8_t kFixed = 1;
constexpr std::uint8_t kFree = 2;

std::uint8_t stored(Policy policy) {
  if (policy == Policy::kAuto)
    throw std::invalid_argument("a checkpoint needs a policy other than auto");
  return policy == Policy::kFixed ? kFixed : kFree;
}

std::string policy_name(std::uint8_t policy) {
  return policy == kFixed ? "fixed" : policy == kFree ? "free" : fmt::format("{}", policy);
}

std::uint32_t checksum(std::uint32_t before, std::string_view bytes) {
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void append(std::string& bytes, std::uint64_t number, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(number >> 8 * i & 0xFF);
}

std::uint64_t number_in(std::string_view bytes) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    number |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << 8 * i;
  return number;
}

std::string opening() {
  std::string bytes(kMagic);
  append(bytes, kVersion, 4);
  return bytes;
}

std::size_t bytes_of(const NodeRecord& node) {
  std::size_t bytes = 64 + 24 * node.constraints.size();
  for (const NodeRecord::Walk& walk : node.paths) bytes += 16 + 8 * walk.words.size();
  return bytes;
}

std::size_t bytes_of(const TreeRecord& tree) {
  std::size_t bytes = 8;
  for (const TreeRecord::Order& order : tree.orders)
    bytes += 32 + order.sequences.prefix.size() + 8 * order.words.size();
  return bytes;
}

}  // namespace

fs::path checkpoint_file(const fs::path& directory) {
  return directory / "checkpoint.grove";
}

CheckpointWriter::CheckpointWriter(const fs::path& directory, const CheckpointHeader& header)
    : file_(checkpoint_file(directory)),
      checksum_(checksum(0, opening())),
      trees_(header.trees.size()) {
  const Head head{header.fingerprint,  stored(header.policy), header.incumbent,
                  header.lower_bound,  header.evicted_bound,  header.trees_instantiated,
                  header.trees.size(), header.counters,       header.seconds};
  file_.write(opening());
  write(kHead, to_bytes(head));
  write_trees(header.trees);
}

void CheckpointWriter::write_trees(const std::vector<TreeRecord>& trees) {
  std::vector<TreeRecord> block;
  std::size_t bytes = 0;
  for (const TreeRecord& tree : trees) {
    block.push_back(tree);
    bytes += bytes_of(tree);
    if (bytes < kBlockBytes && &tree != &trees.back()) continue;
    write(kTrees, to_bytes(block));
    block.clear();
    bytes = 0;
  }
}

void CheckpointWriter::add(NodeRecord node) {
  if (node.tree >= trees_)
    throw std::invalid_argument("a node must belong to a tree of its checkpoint");
  waiting_bytes_ += bytes_of(node);
  waiting_.push_back(std::move(node));
  ++nodes_;
  if (waiting_bytes_ >= kBlockBytes) write_nodes();
}

void CheckpointWriter::write_nodes() {
  write(kNodes, to_bytes(waiting_));
  waiting_.clear();
  waiting_bytes_ = 0;
}

void CheckpointWriter::finish() {
  if (!waiting_.empty()) write_nodes();
  write(kEnd, to_bytes(nodes_));
  file_.commit();
}

void CheckpointWriter::write(std::uint32_t kind, std::string_view content) {
  std::string head;
  append(head, kind, 4);
  append(head, content.size(), 8);
  checksum_ = checksum(checksum(checksum_, head), content);
  std::string tail;
  append(tail, checksum_, kChecksumBytes);
  file_.write(head);
  file_.write(content);
  file_.write(tail);
}

// Reads the blocks of a file in order.
class CheckpointReader::Blocks {
 public:
  explicit Blocks(fs::path path) : path_(std::move(path)), file_(nullptr, &std::fclose) {
    std::error_code error;
    size_ = fs::file_size(path_, error);
    if (error) fail_to_read(path_, error.value());
    file_.reset(std::fopen(path_.c_str(), "rb"));
    if (!file_) fail_to_read(path_);
    read_opening();
  }

  struct Block {
    std::uint32_t kind = 0;
    std::string content;
  };

  Block next() {
    block_begin_ = offset_;
    const std::string head = read(kBlockHeadBytes);
    Block block{static_cast<std::uint32_t>(number_in(std::string_view(head).substr(0, 4))), {}};
    const std::uint64_t length = number_in(std::string_view(head).substr(4));
    // Check the length first, because it is not yet verified by a checksum.
    if (length > left() || left() - length < kChecksumBytes)
      refuse(fmt::format("has a block of {} bytes; expected at most {}, the bytes left", length,
                         left()));
    block.content = read(length);
    checksum_ = checksum(checksum(checksum_, head), block.content);
    if (const std::uint64_t found = number_in(read(kChecksumBytes)); found != checksum_)
      refuse(fmt::format("found the checksum {:08x}; expected {:08x}", found, checksum_));
    return block;
  }

  // Decodes the whole content of a block as one value.
  template <class T>
  T value(std::string_view content) const try {
    return from_bytes<T>(content);
  } catch (const std::invalid_argument& error) {
    refuse(error.what());
  }

  std::uint64_t left() const { return size_ - offset_; }

  // Throws an InputError that reports damage at the start of the block being read.
  [[noreturn]] void refuse(std::string_view what) const {
    throw InputError(path_.string(), fmt::format("byte {}", block_begin_),
                     fmt::format("is damaged: {}", what));
  }
  // Throws an InputError about a file that is intact, but not the expected one.
  [[noreturn]] void refuse_file(std::string_view what) const {
    throw InputError(path_.string(), "", what);
  }

 private:
  void read_opening() {
    const std::string magic = read(std::min<std::uint64_t>(kMagic.size(), left()));
    if (magic != kMagic)
      refuse_file(
          fmt::format("is not a checkpoint: begins with '{}'; expected '{}'", magic, kMagic));
    const std::uint64_t version = number_in(read(4));
    if (version != kVersion)
      refuse_file(fmt::format("is a checkpoint of format version {}; expected version {}", version,
                              kVersion));
  }

  std::string read(std::uint64_t size) {
    if (size > left())
      refuse(fmt::format("ends after {} bytes; expected {} more", size_, size - left()));
    std::string bytes(size, '\0');
    const std::size_t read = std::fread(bytes.data(), 1, bytes.size(), file_.get());
    if (std::ferror(file_.get()) != 0) fail_to_read(path_);
    if (read != size) refuse("became shorter during reading");
    offset_ += size;
    return bytes;
  }

  fs::path path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::uint64_t size_ = 0;
  std::uint64_t offset_ = 0;
  std::uint64_t block_begin_ = 0;
  std::uint32_t checksum_ = checksum(0, opening());  // of all blocks read so far
};

CheckpointReader::CheckpointReader(const fs::path& directory, std::uint64_t fingerprint,
                                   Policy policy)
    : blocks_(std::make_unique<Blocks>(checkpoint_file(directory))) {
  read_header(fingerprint, policy);
}

CheckpointReader::~CheckpointReader() = default;

void CheckpointReader::read_header(std::uint64_t fingerprint, Policy policy) {
  const Blocks::Block block = blocks_->next();
  if (block.kind != kHead) blocks_->refuse("has no head");
  auto head = blocks_->value<Head>(block.content);
  if (head.fingerprint != fingerprint)
    blocks_->refuse_file(
        fmt::format("is a checkpoint of another instance: found fingerprint {:016x}; expected "
                    "{:016x}",
                    head.fingerprint, fingerprint));
  if (head.policy != stored(policy))
    blocks_->refuse_file(fmt::format("is a checkpoint of policy {}; expected policy {}",
                                     policy_name(head.policy), policy_name(stored(policy))));
  header_ = {head.fingerprint,
             policy,
             std::move(head.incumbent),
             head.lower_bound,
             head.evicted_bound,
             head.trees_instantiated,
             {},
             std::move(head.counters),
             head.seconds};
  read_trees(head.trees);
}

void CheckpointReader::read_trees(std::uint64_t count) {
  while (header_.trees.size() < count) {
    const Blocks::Block block = blocks_->next();
    if (block.kind != kTrees) blocks_->refuse("has too few trees");
    for (TreeRecord& tree : blocks_->value<std::vector<TreeRecord>>(block.content))
      header_.trees.push_back(std::move(tree));
  }
  if (header_.trees.size() != count) blocks_->refuse("has more trees than its head states");
}

std::optional<NodeRecord> CheckpointReader::next() {
  while (next_ == nodes_.size() && !ended_) {
    const Blocks::Block block = blocks_->next();
    if (block.kind == kEnd) {
      read_end(block.content);
    } else {
      if (block.kind != kNodes) blocks_->refuse("has a block of unknown kind");
      nodes_ = blocks_->value<std::vector<NodeRecord>>(block.content);
      nodes_read_ += nodes_.size();
      next_ = 0;
    }
  }
  if (next_ == nodes_.size()) return std::nullopt;
  NodeRecord& node = nodes_[next_++];
  if (node.tree >= header_.trees.size()) blocks_->refuse("has a node without a tree");
  return std::move(node);
}

void CheckpointReader::read_end(std::string_view content) {
  const auto count = blocks_->value<std::uint64_t>(content);
  if (count != nodes_read_)
    blocks_->refuse(fmt::format("holds {} nodes; expected {}", nodes_read_, count));
  if (blocks_->left() != 0)
    blocks_->refuse(fmt::format("has {} bytes after its end; expected none", blocks_->left()));
  ended_ = true;
}

}  // namespace grove::detail

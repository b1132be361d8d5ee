// SPDX-License-Identifier: MIT
// File format: a zstd-compressed sequence of 8-byte integers in the byte order of the machine. Each
// entry consists of its kind, the number n of integers that follow, and n integers. Most bytes are
// zero and compress to almost nothing.
#include "proof/proof_parts.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <mutex>
#include <string_view>
#include <utility>

#include "io/file_descriptor.h"
#include "io/input_error.h"
#include "model/assert.h"
#include "proof/zstd_stream.h"

namespace grove::detail {
namespace {

enum PartKind : std::int64_t {
  kSplit = 1,
  kBound = 2,
  kLemma = 3,
  kPrices = 4,
  kJoint = 5,
  kTree = 6,
  kFormula = 7,
  kFormulaBound = 8
};
constexpr std::int64_t kMaxNumbers = std::int64_t{1} << 28;  // maximum n of an entry

using Numbers = std::vector<std::int64_t>;

std::int64_t number(ProofKey key) {
  return static_cast<std::int64_t>(key);
}

void add(Numbers& numbers, const AgentConstraint& constraint) {
  const Constraint& c = constraint.constraint;
  numbers.insert(numbers.end(), {constraint.agent, c.cell, c.from, c.begin, c.end,
                                 static_cast<std::int64_t>(c.kind)});
}

void add(Numbers& numbers, const ProofSplit& split) {
  numbers.insert(numbers.end(),
                 {number(split.node), number(split.lemma), split.costs[0], split.costs[1]});
  for (const AgentConstraint& constraint : split.split) add(numbers, constraint);
}

[[noreturn]] void refuse_part(const std::filesystem::path& path) {
  throw InputError(path.string(), "", "expected the record of a search for its proof");
}

// Reads the integers of an entry in the order of their addition.
class NumberReader {
 public:
  NumberReader(const Numbers& numbers, const std::filesystem::path& path)
      : numbers_(numbers), path_(path) {}

  std::int64_t number() {
    if (at_ == numbers_.size()) refuse();
    return numbers_[at_++];
  }
  bool is_over() const { return at_ == numbers_.size(); }
  ProofKey key() { return static_cast<ProofKey>(number()); }
  std::int32_t small() { return static_cast<std::int32_t>(number()); }
  // Reads the number of items that follow.
  std::int64_t count() {
    const std::int64_t count = number();
    if (count < 0 || std::cmp_greater(count, numbers_.size() - at_)) refuse();
    return count;
  }
  std::vector<AgentIndex> agents() {
    std::vector<AgentIndex> agents;
    for (std::int64_t left = count(); left > 0; --left) agents.push_back(small());
    return agents;
  }
  AgentConstraint constraint() {
    AgentConstraint constraint;
    constraint.agent = small();
    constraint.constraint = {small(), small(), small(), small(), ConstraintKind::kVertexOrEdge};
    const auto kind = constraint_kind(static_cast<std::uint8_t>(number()));
    if (!kind) refuse();
    constraint.constraint.kind = *kind;
    return constraint;
  }
  ProofSplit split() {
    ProofSplit split;
    split.node = key();
    split.lemma = key();
    for (Cost& cost : split.costs) cost = number();
    for (AgentConstraint& of_split : split.split) of_split = constraint();
    return split;
  }

  ProofTree tree() {
    ProofTree tree;
    tree.root = key();
    tree.cost = number();
    while (!is_over()) {
      Sequence& sequence = tree.sequences.emplace_back();
      for (std::int64_t left = count(); left > 0; --left)
        sequence.push_back(static_cast<Stop>(number()));
    }
    return tree;
  }
  FormulaKind formula_kind() {
    const std::int64_t kind = number();
    if (kind < 0 || kind > static_cast<std::int64_t>(kLastFormulaKind)) refuse();
    return static_cast<FormulaKind>(kind);
  }
  std::span<const std::int64_t> rest() const { return std::span(numbers_).subspan(at_); }
  RowMultiplier row() {
    RelaxedRow row;
    const std::int64_t kind = number();
    if (kind < 0 || kind > static_cast<std::int64_t>(RelaxedRow::Kind::kFinish)) refuse();
    row.kind = static_cast<RelaxedRow::Kind>(kind);
    row.a = small();
    row.b = small();
    row.time = small();
    row.time_b = small();
    return {row, small()};
  }

 private:
  [[noreturn]] void refuse() const { refuse_part(path_); }

  const Numbers& numbers_;
  const std::filesystem::path& path_;
  std::size_t at_ = 0;
};

void replay(std::int64_t kind, NumberReader taking, ProofLog& log) {
  if (kind == kSplit) return log.split(taking.split());
  if (kind == kBound) {
    const ProofKey node = taking.key();
    const Cost cost = taking.number();
    const Cost bound = taking.number();
    std::vector<ProofExcess> excesses;
    while (!taking.is_over()) {
      const ProofKey lemma = taking.key();
      const Cost excess = taking.number();
      excesses.push_back({lemma, taking.agents(), excess});
    }
    return log.bound(node, cost, bound, excesses);
  }
  if (kind == kJoint) return log.joint(taking.number());
  if (kind == kTree) return log.tree(taking.tree());
  if (kind == kFormulaBound) return log.formula_bound(taking.number());
  if (kind == kFormula) {
    const FormulaKind of_line = taking.formula_kind();
    return log.formula(of_line, taking.rest());
  }
  if (kind == kPrices) {
    const Cost bound = taking.number();
    std::vector<RowMultiplier> rows;
    while (!taking.is_over()) rows.push_back(taking.row());
    return log.prices(bound, rows);
  }
  ProofLemma lemma;
  const ProofKey root = taking.key();
  lemma.bound = taking.number();
  lemma.agents = taking.agents();
  for (std::int64_t left = taking.count(); left > 0; --left)
    lemma.constraints.push_back(taking.constraint());
  std::vector<ProofSplit> splits;
  while (!taking.is_over()) splits.push_back(taking.split());
  log.lemma(lemma, root, splits);
}

}  // namespace

class ProofRecorder::Stream {
 public:
  explicit Stream(std::filesystem::path path)
      : path_(std::move(path)),
        file_(path_, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW),
        compressor_([this](std::string_view bytes) { write(bytes); }) {
    if (!file_.is_open()) fail_to_write(path_);
  }

  void add(PartKind kind, const Numbers& numbers) {
    const std::int64_t head[] = {kind, std::ssize(numbers)};
    unless_failed([&] {
      compressor_.add({reinterpret_cast<const char*>(head), sizeof head});
      compressor_.add(
          {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Cost)});
    });
  }

  std::string flush() {
    unless_failed([&] { compressor_.end(); });
    const std::lock_guard lock(mutex_);
    return failure_;
  }

 private:
  template <class Write>
  void unless_failed(Write write) {
    const std::lock_guard lock(mutex_);
    if (!failure_.empty()) return;
    try {
      write();
    } catch (const InputError& error) {
      failure_ = error.what();
      file_ = FileDescriptor(-1);
      std::error_code ignored;
      std::filesystem::remove(path_, ignored);
    }
  }

  void write(std::string_view bytes) {
    if (!write_all(file_.get(), bytes)) fail_to_write(path_);
  }

  const std::filesystem::path path_;
  FileDescriptor file_;
  std::mutex mutex_;  // guards file_, compressor_ and failure_
  ZstdCompressor compressor_;
  std::string failure_;  // not empty: error after which nothing more is logged
};

ProofRecorder::ProofRecorder(std::filesystem::path path)
    : stream_(std::make_unique<Stream>(std::move(path))) {}

ProofRecorder::~ProofRecorder() = default;

void ProofRecorder::tree(const ProofTree& tree) {
  Numbers numbers{number(tree.root), tree.cost};
  for (const Sequence& sequence : tree.sequences) {
    numbers.push_back(std::ssize(sequence));
    numbers.insert(numbers.end(), sequence.begin(), sequence.end());
  }
  stream_->add(kTree, numbers);
}

void ProofRecorder::split(const ProofSplit& split) {
  GROVE_CHECK(split.split[0] != split.split[1], "the two sides of a split differ");
  GROVE_CHECK(!splits_on_costs(split.split) || split.lemma != kNoProof,
              "a split on costs names its lemma");
  Numbers numbers;
  add(numbers, split);
  stream_->add(kSplit, numbers);
}

void ProofRecorder::bound(ProofKey node, Cost cost, Cost bound,
                          std::span<const ProofExcess> excesses) {
  GROVE_CHECK(bound >= cost, "a logged bound is at least the cost of its node");
  Numbers numbers{number(node), cost, bound};
  for (const ProofExcess& excess : excesses) {
    GROVE_CHECK(excess.excess > 0 && std::ranges::is_sorted(excess.agents),
                "a logged excess is positive, with its agents in ascending order");
    numbers.insert(numbers.end(), {number(excess.lemma), excess.excess, std::ssize(excess.agents)});
    numbers.insert(numbers.end(), excess.agents.begin(), excess.agents.end());
  }
  stream_->add(kBound, numbers);
}

void ProofRecorder::lemma(const ProofLemma& lemma, ProofKey root,
                          std::span<const ProofSplit> splits) {
  Numbers numbers{number(root), lemma.bound, std::ssize(lemma.agents)};
  numbers.insert(numbers.end(), lemma.agents.begin(), lemma.agents.end());
  numbers.push_back(std::ssize(lemma.constraints));
  for (const AgentConstraint& constraint : lemma.constraints) add(numbers, constraint);
  for (const ProofSplit& split : splits) add(numbers, split);
  stream_->add(kLemma, numbers);
}

void ProofRecorder::prices(Cost bound, std::span<const RowMultiplier> rows) {
  Numbers numbers{bound};
  for (const auto& [row, charge] : rows)
    numbers.insert(numbers.end(), {static_cast<std::int64_t>(row.kind), row.a, row.b, row.time,
                                   row.time_b, charge});
  stream_->add(kPrices, numbers);
}

void ProofRecorder::joint(Cost bound) {
  stream_->add(kJoint, {bound});
}

void ProofRecorder::formula(FormulaKind kind, std::span<const std::int64_t> numbers) {
  Numbers entry{static_cast<std::int64_t>(kind)};
  entry.insert(entry.end(), numbers.begin(), numbers.end());
  stream_->add(kFormula, entry);
}

void ProofRecorder::formula_bound(Cost bound) {
  stream_->add(kFormulaBound, {bound});
}

std::string ProofRecorder::flush() {
  return stream_->flush();
}

void read_proof_part(const std::filesystem::path& path, ProofLog& log) {
  const FileDescriptor file(path, O_RDONLY | O_NOFOLLOW);
  if (!file.is_open()) fail_to_read(path);
  ZstdDecompressor stream([&](char* buffer, std::size_t size) {
    const ssize_t count = ::read(file.get(), buffer, size);
    if (count < 0) fail_to_read(path);
    return static_cast<std::size_t>(count);
  });
  const auto read = [&](std::int64_t* to, std::size_t count) {
    const std::size_t bytes = count * sizeof *to;
    return stream.read(reinterpret_cast<char*>(to), bytes) == bytes;
  };
  Numbers numbers;
  for (std::int64_t head[2]; read(head, 2);) {
    if (head[0] < kSplit || head[0] > kFormulaBound || head[1] < 0 || head[1] > kMaxNumbers)
      refuse_part(path);
    numbers.resize(static_cast<std::size_t>(head[1]));
    if (!read(numbers.data(), numbers.size())) break;
    replay(head[0], NumberReader(numbers, path), log);
  }
  if (stream.broken()) refuse_part(path);
}

}  // namespace grove::detail

// SPDX-License-Identifier: MIT
// Three walks. The first reads all that was written down and finds for each node what it proves:
// its agents' least costs, or those with what lemmas add, or the lesser of what its two sides
// prove. The second goes down from the root as far as the bound asks for, and notes which lemmas
// the leaves need: of those that a leaf could name, it leaves out one after the other for as long
// as the rest are enough, the ones that no other leaf has needed yet first. The third writes.
//
// Nothing here has to be right for what is proven: a checker sees to that.
#include "grove/detail/proof/certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "grove/detail/io/atomic_file.h"
#include "grove/detail/proof/proof_parts.h"
#include "grove/detail/search/covering.h"
#include "proof_text.h"
#include "zstd_stream.h"

namespace grove::detail {
namespace {

// What is known of a node by its name.
struct Entry {
  Cost cost = 0;   // of its agents, each by itself
  Cost bound = 0;  // with what lemmas add
  std::vector<ProofExcess> excesses;
  std::optional<ProofSplit> split;
  std::optional<Cost> value;  // that it proves
};

using Entries = std::unordered_map<ProofKey, Entry>;

std::array<ProofKey, 2> sides_of(const ProofSplit& split) {
  return {proof_key(split.node, split.split[0]), proof_key(split.node, split.split[1])};
}

// All of it, but for the lemmas, of which only the names are kept.
class Collected : public ProofLog {
 public:
  Entries entries;
  std::unordered_set<ProofKey> lemmas;
  std::vector<ProofTree> trees;

  void tree(const ProofTree& tree) override {
    if (std::ranges::count(trees, tree.root, &ProofTree::root) == 0) trees.push_back(tree);
  }
  void split(const ProofSplit& split) override { entries[split.node].split = split; }
  void bound(ProofKey node, Cost cost, Cost bound, std::span<const ProofExcess> excesses) override {
    Entry& entry = entries[node];
    entry.cost = std::max(entry.cost, cost);
    if (bound <= entry.bound) return;
    entry.bound = bound;
    entry.excesses.assign(excesses.begin(), excesses.end());
  }
  void lemma(const ProofLemma& lemma, ProofKey /*root*/,
             std::span<const ProofSplit> /*splits*/) override {
    lemmas.insert(lemma.key());
  }
  void prices(Cost bound, std::span<const ProofRow> rows) override {
    if (bound <= priced) return;
    priced = bound;
    priced_rows.assign(rows.begin(), rows.end());
  }
  void joint(Cost bound) override { joined = std::max(joined, bound); }

  Cost priced = 0;  // what prices say, and joint search
  std::vector<ProofRow> priced_rows;
  Cost joined = 0;
};

Cost covered(std::span<const ProofExcess> excesses) {
  std::vector<GroupExcess> statements;
  for (const ProofExcess& excess : excesses) statements.push_back({excess.agents, excess.excess});
  return statements.empty() ? 0 : covering_bound(statements);
}

// A tree of splits, from its root down to where nothing more is asked for. Without recursion: it
// may be as deep as it has nodes.
class SplitTree {
 public:
  explicit SplitTree(Entries& entries) : entries_(entries) {}

  // What the node proves if its agents cost so much.
  Cost value(ProofKey root, Cost cost) {
    struct Step {
      ProofKey node;
      Cost cost;
      bool again;
    };
    std::vector<Step> steps{{root, cost, false}};
    while (!steps.empty()) {
      const Step step = steps.back();
      steps.pop_back();
      const auto found = entries_.find(step.node);
      if (found == entries_.end() || found->second.value) continue;
      Entry& entry = found->second;
      entry.cost = std::max(entry.cost, step.cost);
      if (entry.split && !step.again) {
        steps.push_back({step.node, step.cost, true});
        const auto sides = sides_of(*entry.split);
        for (int i = 0; i < 2; ++i) steps.push_back({sides[i], entry.split->costs[i], false});
        continue;
      }
      entry.value = std::max({entry.cost, entry.bound, entry.split ? of_sides(entry) : 0});
    }
    return value_of(root, cost);
  }

  // Calls leaf(entry or null) and split(entry) in the order of the certificate.
  template <class Leaf, class Split>
  void walk(ProofKey root, Cost cost, Cost bound, Leaf leaf, Split split) {
    std::vector<std::pair<ProofKey, Cost>> left{{root, cost}};
    while (!left.empty()) {
      const auto [node, cost_there] = left.back();
      left.pop_back();
      const auto found = entries_.find(node);
      Entry* const entry = found == entries_.end() ? nullptr : &found->second;
      if (entry == nullptr || std::max(entry->cost, cost_there) >= bound) {
        leaf(nullptr);
      } else if (entry->bound >= bound) {
        leaf(entry);
      } else if (entry->split && of_sides(*entry) >= bound) {
        split(*entry);
        const auto sides = sides_of(*entry->split);
        for (const int i : {1, 0}) left.emplace_back(sides[i], entry->split->costs[i]);
      } else {
        leaf(entry);
      }
    }
  }

 private:
  Cost of_sides(const Entry& entry) const {
    const auto sides = sides_of(*entry.split);
    return std::min(value_of(sides[0], entry.split->costs[0]),
                    value_of(sides[1], entry.split->costs[1]));
  }
  Cost value_of(ProofKey node, Cost cost) const {
    const auto found = entries_.find(node);
    if (found == entries_.end() || !found->second.value) return cost;
    return std::max(cost, *found->second.value);
  }

  Entries& entries_;
};

// The certificate under way.
class Writer {
 public:
  explicit Writer(const std::filesystem::path& file)
      : file_(file), compressor_([this](std::string_view bytes) {
          bytes_ += std::ssize(bytes);
          file_.write(bytes);
        }) {}

  void line(const std::string& text) { compressor_.add(text + '\n'); }
  std::int64_t commit() {
    compressor_.end();
    file_.commit();
    return bytes_;
  }

 private:
  AtomicFile file_;
  std::int64_t bytes_ = 0;
  ZstdCompressor compressor_;
};

// Writes those lemmas that are needed, and numbers them.
class LemmaWriter : public ProofLog {
 public:
  LemmaWriter(const Instance& instance, const std::unordered_set<ProofKey>& needed, Writer& writer)
      : instance_(instance), needed_(needed), writer_(writer) {}

  void tree(const ProofTree& /*tree*/) override {}
  void split(const ProofSplit& /*split*/) override {}
  void bound(ProofKey /*node*/, Cost /*cost*/, Cost /*bound*/,
             std::span<const ProofExcess> /*excesses*/) override {}
  void lemma(const ProofLemma& lemma, ProofKey root, std::span<const ProofSplit> splits) override {
    const ProofKey key = lemma.key();
    if (!needed_.contains(key)) return;
    if (!numbers_.emplace(key, std::ssize(numbers_)).second) return;
    writer_.line(fmt::format("lemma {} {}", proof_text(lemma.bound), fmt::join(lemma.agents, " ")));
    for (const AgentConstraint& demand : lemma.demands)
      writer_.line("demand " + proof_text(demand, instance_));
    if (splits.empty()) return writer_.line("joint");
    Entries entries;
    for (const ProofSplit& split : splits) entries[split.node].split = split;
    SplitTree tree(entries);
    tree.value(root, 0);
    tree.walk(
        root, 0, lemma.bound, [&](const Entry*) { writer_.line("leaf"); },
        [&](const Entry& entry) { writer_.line(proof_text(entry.split->split, instance_)); });
  }

  void prices(Cost /*bound*/, std::span<const ProofRow> /*rows*/) override {}
  void joint(Cost /*bound*/) override {}

  std::int64_t number(ProofKey key) const { return numbers_.at(key); }
  std::int64_t count() const { return std::ssize(numbers_); }

 private:
  const Instance& instance_;
  const std::unordered_set<ProofKey>& needed_;
  Writer& writer_;
  std::unordered_map<ProofKey, std::int64_t> numbers_;
};

// What is done with a tree of the certificate, leaf by leaf and split by split.
class Visitor {
 public:
  virtual ~Visitor() = default;
  // Null: the agents' own costs are enough.
  virtual void leaf(Entry* entry) = 0;
  virtual void split(const Entry& entry) = 0;
  virtual void split(const Split& on_sequence) = 0;
};

// Notes which lemmas are needed.
class Choosing : public Visitor {
 public:
  explicit Choosing(Cost bound) : bound_(bound) {}
  std::unordered_set<ProofKey> needed;

  void leaf(Entry* entry) override {
    if (entry == nullptr) return;
    std::vector<ProofExcess>& chosen = entry->excesses;
    std::ranges::stable_partition(
        chosen, [&](const ProofExcess& excess) { return needed.contains(excess.lemma); });
    const Cost wanted = bound_ - entry->cost;
    for (std::size_t i = chosen.size(); i-- > 0;) {
      std::vector<ProofExcess> rest = chosen;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
      if (covered(rest) >= wanted) chosen = std::move(rest);
    }
    for (const ProofExcess& excess : chosen) needed.insert(excess.lemma);
  }
  void split(const Entry& entry) override {
    if (entry.split->lemma != kNoProof) needed.insert(entry.split->lemma);
  }
  void split(const Split& /*on_sequence*/) override {}

 private:
  const Cost bound_;
};

class TreeWriter : public Visitor {
 public:
  TreeWriter(const Instance& instance, const LemmaWriter& lemmas, Writer& writer, Certificate& made)
      : instance_(instance), lemmas_(lemmas), writer_(writer), made_(made) {}

  void leaf(Entry* entry) override {
    ++made_.leaves;
    std::string line = "leaf";
    if (entry != nullptr)
      for (const ProofExcess& excess : entry->excesses)
        line += fmt::format(" {}", lemmas_.number(excess.lemma));
    writer_.line(line);
  }
  void split(const Entry& entry) override {
    const ProofSplit& s = *entry.split;
    if (s.lemma == kNoProof) return split(s.split);
    ++made_.splits;
    writer_.line(fmt::format("later {} {} {} {} {}", s.split[0].agent, s.split[0].constraint.end,
                             s.split[1].agent, s.split[1].constraint.end, lemmas_.number(s.lemma)));
  }
  void split(const Split& split) override {
    ++made_.splits;
    writer_.line(proof_text(split, instance_));
  }

 private:
  const Instance& instance_;
  const LemmaWriter& lemmas_;
  Writer& writer_;
  Certificate& made_;
};

class Making {
 public:
  Making(const Instance& instance, std::span<const std::filesystem::path> parts)
      : instance_(instance), parts_(parts), tree_(collected_.entries) {
    for (const auto& part : parts_) read_proof_part(part, collected_);
    drop_what_lacks_lemmas();
  }

  Certificate write(Cost claimed, const std::filesystem::path& file) {
    const Cost of_trees = value_of_trees(claimed);
    made_.bound = std::min(claimed, std::max({of_trees, collected_.priced, collected_.joined}));
    const bool by_trees = of_trees >= made_.bound && !is_evidently_infeasible(claimed);
    Choosing choosing(made_.bound);
    if (by_trees) visit_forest(choosing);
    Writer writer(file);
    writer.line("grove-proof 1");
    writer.line(fmt::format("instance {:016x}", certificate_checksum(instance_)));
    writer.line(instance_.may_follow() ? "following yes" : "following no");
    LemmaWriter lemmas(instance_, choosing.needed, writer);
    for (const auto& part : parts_) read_proof_part(part, lemmas);
    writer.line("theorem " + proof_text(made_.bound));
    TreeWriter writing(instance_, lemmas, writer, made_);
    if (by_trees)
      visit_forest(writing);
    else if (collected_.priced >= made_.bound)
      write_prices(writer);
    else
      writer.line("joint");
    writer.line("end");
    made_.lemmas = lemmas.count();
    made_.bytes = writer.commit();
    return made_;
  }

 private:
  using Trees = std::vector<const ProofTree*>;

  // There was no search. Why is not written down, so whoever wants to know looks at all that the
  // agents can do.
  bool is_evidently_infeasible(Cost claimed) const {
    return claimed >= kInfiniteCost && collected_.trees.empty();
  }

  // Of lemmas that a process was killed over.
  void drop_what_lacks_lemmas() {
    const auto is_lost = [&](ProofKey lemma) { return !collected_.lemmas.contains(lemma); };
    for (auto& [node, entry] : collected_.entries) {
      if (entry.split && entry.split->lemma != kNoProof && is_lost(entry.split->lemma))
        entry.split.reset();
      const auto lost = [&](const ProofExcess& excess) { return is_lost(excess.lemma); };
      if (std::erase_if(entry.excesses, lost) > 0)
        entry.bound = entry.cost + covered(entry.excesses);
    }
  }

  Cost value_of_trees(Cost claimed) {
    Cost value = claimed;
    for (const ProofTree& tree : collected_.trees)
      value = std::min(value, tree_.value(tree.root, tree.cost));
    return value;
  }

  void visit_forest(Visitor& visitor) {
    Trees all;
    for (const ProofTree& tree : collected_.trees) all.push_back(&tree);
    visit_forest(all, 0, 0, visitor);
  }

  // These trees have the first stops of the first agents in common: down to tree after tree, stop
  // after stop, by "it is the next one of the first of these trees, or it is not". Where there are
  // none of them the agents' own costs are enough, for so it is in all sequences without a tree.
  void visit_forest(const Trees& trees, std::size_t agent, std::size_t number, Visitor& visitor) {
    if (trees.empty()) return visitor.leaf(nullptr);
    const std::vector<Sequence>& sequences = trees.front()->sequences;
    while (agent < sequences.size() && number == sequences[agent].size()) {
      ++agent;
      number = 0;
    }
    if (agent == sequences.size()) return visit_tree(*trees.front(), visitor);
    const Stop stop = sequences[agent][number];
    const auto demand = [&](ConstraintKind kind) {
      const auto at = static_cast<Time>(number);
      return AgentConstraint{static_cast<AgentIndex>(agent), {kNoPlace, stop, at, at, kind}};
    };
    visitor.split({demand(ConstraintKind::kStopIs), demand(ConstraintKind::kStopIsNot)});
    Trees of_it;
    Trees others;
    for (const ProofTree* tree : trees)
      (tree->sequences[agent][number] == stop ? of_it : others).push_back(tree);
    visit_forest(of_it, agent, number + 1, visitor);
    visit_forest(others, agent, number, visitor);
  }

  void visit_tree(const ProofTree& tree, Visitor& visitor) {
    tree_.walk(
        tree.root, tree.cost, made_.bound, [&](Entry* entry) { visitor.leaf(entry); },
        [&](const Entry& entry) { visitor.split(entry); });
  }

  void write_prices(Writer& writer) const {
    writer.line("prices");
    for (const ProofRow& row : collected_.priced_rows) writer.line(proof_text(row));
    writer.line("end");
  }

  const Instance& instance_;
  const std::span<const std::filesystem::path> parts_;
  Collected collected_;
  SplitTree tree_;
  Certificate made_;
};

}  // namespace

Certificate write_certificate(const Instance& instance,
                              std::span<const std::filesystem::path> parts, Cost claimed,
                              const std::filesystem::path& file) {
  return Making(instance, parts).write(claimed, file);
}

}  // namespace grove::detail

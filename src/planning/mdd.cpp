// SPDX-License-Identifier: MIT
// Builds the MDD of one agent in two searches over labels.
//
// *Definitions.* Let C be the given cost. A *label* is a slot of safe_intervals.h and a stage of
// sequence_stages.h. The slot determines the state and all facts about the past on which the
// constraints depend. An agent in a slot can wait there until the slot ends, and its continuations
// from a label at a given time depend on nothing else. Let the *earliest* time of a label be the
// first time at which an agent can be in it, and its *latest* time the last one from which the
// agent can still end at C. At each time from the earliest to the latest, and at no other time,
// some path of cost C can be in the label: an agent that arrives at the earliest time can wait
// until any later time, and an agent that is in the label before the latest time can wait until
// then.
//
// *Method.* Neither search branches over times. The forward search computes the earliest times, in
// order of time, and all moves. The backward search computes the latest times along those moves,
// from the last moves on. Then the layers are written, only with nodes that lead to an end. (The
// MDD of an agent without tasks and constraints follows from two distances in the same way.)
//
// *Claim: the walks of the graph are exactly the paths of cost C.* *Proof.* Moves are generated at
// the earliest time in the label that they leave, so the first time of a move is its earliest
// possible arrival. Its last time follows from the end of the slot that it leaves and from the last
// arrival in the slot that it enters (SafeIntervals::last_entry()). Times in between can be barred.
// A path that counts its stops as early as possible passes the stages of the search
// (sequence_stages.cpp: a visit has one or two successor stages, and the search follows all of
// them). The costs to go, on which the stages are based, are widened until they cover all sequences
// of cost C or less, i.e. C < outside_bound(). Therefore all stages along a path of cost C are
// known, and the path is in them at times t with t + h <= C. Hence no move of such a path is
// dropped. If C > 0, a path comes to rest by a move that arrives at C in a slot where it may rest,
// because its last step is not a wait; if C = 0, the path is there from the start. Conversely, each
// walk to such an end satisfies the constraints, because slots and moves determine whether a path
// satisfies them. The only exception, if states are places, is the time by which the agent must
// have come to rest; build() compares C with it first.
//
// *Measured* against a method that builds the layers forward, time by time, and then removes dead
// ends: it generated four nodes for each node that it kept, and a benchmark instance that takes
// some seconds took 1.5 times as long.
#include "planning/mdd.h"

#include <algorithm>

#include "model/assert.h"
#include "model/hash.h"
#include "planning/bucket_queue.h"
#include "planning/label_planes.h"
#include "planning/safe_intervals.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kExpansionsPerPoll = 512;  // between polls of the limits: about 0.1 ms

}  // namespace

class MddBuilder::Workspace {
 public:
  explicit Workspace(const World& world) : world_(world), intervals_(world) {}

  Outcome build(SequenceStages& goals, std::span<const Constraint> constraints, Time cost,
                std::size_t max_nodes, const Limits& limits, Mdd& paths);
  std::int64_t nodes() const { return effort_; }

 private:
  using StageId = SequenceStages::StageId;
  using NodeId = Mdd::NodeId;
  using LabelId = std::int32_t;
  static constexpr LabelId kNoLabel = -1;
  static constexpr NodeId kNoNode = -1;
  static constexpr Time kTooLate = -1;

  // A slot and a stage, and the moves out of it.
  struct Label {
    std::int32_t slot;
    StageId stage;
    Time earliest;
    Time latest = kTooLate;
    std::int32_t first_move = 0;  // number of the first move out of the label
    std::int32_t end_move = 0;
  };
  // A move that may arrive at any time from `first` to `last` that is not barred.
  struct Move {
    LabelId from;
    LabelId to;
    Time first;
    Time last;
  };
  // The labels, and the moves between them.
  class Graph {
   public:
    void clear() {
      labels_.clear();
      moves_.clear();
    }
    LabelId label_count() const { return static_cast<LabelId>(labels_.size()); }
    Label& operator[](LabelId label) { return labels_[label]; }
    const Label& operator[](LabelId label) const { return labels_[label]; }
    LabelId add(const Label& label) {
      labels_.push_back(label);
      return label_count() - 1;
    }
    // All moves out of a label are added between begin_moves() and end_moves() of this label.
    void begin_moves(LabelId from) { labels_[from].first_move = move_count(); }
    void add_move(const Move& move) { moves_.push_back(move); }
    void end_moves(LabelId from) { labels_[from].end_move = move_count(); }
    std::span<const Move> moves_from(const Label& label) const {
      return {moves_.data() + label.first_move, moves_.data() + label.end_move};
    }
    // Makes the index that for_each_move_into() needs; call it once all moves are added.
    void index_targets();
    template <class Visit>
    void for_each_move_into(LabelId label, Visit visit) const {
      for (std::int32_t in = first_in_[label]; in < first_in_[label + 1]; ++in)
        visit(moves_[into_[in]]);
    }

   private:
    std::int32_t move_count() const { return static_cast<std::int32_t>(moves_.size()); }

    std::vector<Label> labels_;
    std::vector<Move> moves_;             // grouped by the label that they leave
    std::vector<std::int32_t> into_;      // numbers of moves, grouped by the label that they enter
    std::vector<std::int32_t> first_in_;  // index in into_, by label; one more at the end
  };
  // Data of one (slot, stage) pair.
  struct Mark {
    LabelId label;
    Time distance;  // lower bound on the steps to the end
    std::uint32_t stamp;
  };

  Outcome make_layers(std::size_t max_nodes, Mdd& paths);
  Outcome go_forward(std::size_t label_limit);
  void start();
  void expand(LabelId label);
  void reach(LabelId from, std::int32_t slot, StageId stage, Time first);
  Mark* mark(std::int32_t slot, StageId stage);
  void go_backward();
  void find_ends();
  void leave_by(const Move& move, Time arrival);
  Time last_arrival(const Move& move, Time latest) const;
  std::size_t count_nodes() const;
  void write_layers();
  void write_nodes(Time time);
  void write_successors(LabelId from, Time time);
  bool is_end(const Label& label) const;
  State state(LabelId label) const { return intervals_.state_of(graph_[label].slot); }
  Place place(LabelId label) const { return world_.place(state(label)); }

  const World& world_;
  SafeIntervals intervals_;
  LabelPlanes<Mark> planes_;
  BucketQueue queue_;  // Entry::slot is a LabelId here
  Graph graph_;
  std::vector<LabelId> ends_;    // labels in which some path comes to rest
  std::vector<LabelId> useful_;  // labels that have a latest time, by decreasing latest time
  std::vector<LabelId> here_;    // labels of the layer being written
  std::vector<NodeId> nodes_;    // by label: its node in the layer written last
  Mdd written_;                  // the MDD written so far; keeps its capacity
  std::int64_t effort_ = 0;      // labels and nodes of all calls so far

  // Data of the current call.
  SequenceStages* goals_ = nullptr;
  const Limits* limits_ = nullptr;
  Time cost_ = 0;
};

std::size_t Mdd::bytes() const {
  const auto bytes_of = [](const auto& list) { return list.capacity() * sizeof(list.front()); };
  return sizeof(Mdd) + bytes_of(first_of_layer_) + bytes_of(places_) + bytes_of(states_) +
         bytes_of(first_successor_) + bytes_of(successors_);
}

std::uint64_t Mdd::hash() const {
  std::uint64_t hash = first_of_layer_.size();
  for (const auto* numbers : {&first_of_layer_, &first_successor_, &successors_})
    for (const std::int32_t number : *numbers)
      hash = hash_combine(hash, static_cast<std::uint64_t>(number));
  for (NodeId node = 0; node < node_count(); ++node)
    hash = hash_combine(hash, static_cast<std::uint64_t>(state(node)));
  return hash;
}

bool Mdd::is_connected() const {
  std::vector<bool> reached(places_.size());
  for (Time time = 0; time < cost(); ++time) {
    const Range next = layer(time + 1);
    for (NodeId node = layer(time).first; node < layer(time).end; ++node) {
      if (successors(node).empty()) return false;
      for (const NodeId to : successors(node)) {
        if (to < next.first || to >= next.end) return false;
        reached[static_cast<std::size_t>(to)] = true;
      }
    }
  }
  for (NodeId node = 0; node < layer(0).first; ++node)
    if (!reached[static_cast<std::size_t>(node)]) return false;
  return layer(0).end == node_count();
}

void Mdd::clear() {
  first_of_layer_.clear();
  places_.clear();
  states_.clear();
  first_successor_.clear();
  successors_.clear();
}

MddBuilder::MddBuilder(const World& world) : workspace_(std::make_unique<Workspace>(world)) {}
MddBuilder::~MddBuilder() = default;

std::int64_t MddBuilder::nodes() const {
  return workspace_->nodes();
}

MddBuilder::Outcome MddBuilder::build(SequenceStages& goals,
                                      std::span<const Constraint> constraints, Time cost,
                                      std::size_t max_nodes, const Limits& limits, Mdd& paths) {
  return workspace_->build(goals, constraints, cost, max_nodes, limits, paths);
}

MddBuilder::Outcome MddBuilder::Workspace::build(SequenceStages& goals,
                                                 std::span<const Constraint> constraints, Time cost,
                                                 std::size_t max_nodes, const Limits& limits,
                                                 Mdd& paths) {
  paths = Mdd();
  intervals_.assign(constraints);
  // If states are places, the time at which an agent comes to rest is its finish.
  const Time latest = world_.states_are_places() ? intervals_.latest_rest() : kNever;
  if (cost < 0 || cost >= kNever || cost > latest || !goals.plausible()) return Outcome::kNone;
  if (limits.stop_requested()) return Outcome::kStopped;
  CostToGo& cost_to_go = goals.cost_to_go();
  if (cost_to_go.outside_bound() <= cost && !cost_to_go.extend(cost, limits))
    return limits.stop_requested() ? Outcome::kStopped : Outcome::kTooLarge;
  goals_ = &goals;
  limits_ = &limits;
  cost_ = cost;
  const Outcome outcome = make_layers(max_nodes, paths);
  effort_ += graph_.label_count() + paths.node_count();
  return outcome;
}

MddBuilder::Outcome MddBuilder::Workspace::make_layers(std::size_t max_nodes, Mdd& paths) {
  const Outcome outcome = go_forward(max_nodes);
  if (outcome != Outcome::kBuilt) return outcome;
  go_backward();
  if (ends_.empty()) return Outcome::kNone;
  if (count_nodes() > max_nodes) return Outcome::kTooLarge;
  write_layers();
  GROVE_ASSERT(static_cast<std::size_t>(written_.node_count()) == count_nodes(),
               "each label has a node at each of its times");
  GROVE_ASSERT(written_.is_connected(), "every node of an MDD is on a path");
  paths = written_;
  return Outcome::kBuilt;
}

// Generates all labels that a path of cost cost_ can pass, and the moves between them.
MddBuilder::Outcome MddBuilder::Workspace::go_forward(std::size_t label_limit) {
  graph_.clear();
  planes_.begin_search(intervals_.slot_count());
  queue_.reset(0);
  start();
  std::int64_t expanded = 0;
  BucketQueue::Entry entry;
  while (queue_.pop(entry) && entry.time < cost_) {
    if (graph_[entry.slot].earliest != entry.time) continue;
    expand(entry.slot);
    if (static_cast<std::size_t>(graph_.label_count()) > label_limit) return Outcome::kTooLarge;
    if (++expanded % kExpansionsPerPoll == 0 && limits_->stop_requested()) return Outcome::kStopped;
  }
  return planes_.exhausted() ? Outcome::kStopped : Outcome::kBuilt;
}

void MddBuilder::Workspace::start() {
  const State state = goals_->stops().start();
  const StageId stage = goals_->first_stage();
  const int slot = intervals_.start_slot(state);
  if (slot < 0 || stage == SequenceStages::kOutside) return;
  goals_->on_arrival(stage, state, [&](StageId then) { reach(kNoLabel, slot, then, 0); });
}

void MddBuilder::Workspace::expand(LabelId from) {
  const Label label = graph_[from];  // the graph will grow
  GROVE_ASSERT(label.first_move == label.end_move, "a label is expanded once");
  graph_.begin_moves(from);
  intervals_.for_each_move(label.slot, label.earliest, [&](int slot, State state, Time first) {
    goals_->on_arrival(label.stage, state, [&](StageId then) { reach(from, slot, then, first); });
  });
  graph_.end_moves(from);
}

// Reaches a label from the label `from` by a move that arrives at `first` or later.
void MddBuilder::Workspace::reach(LabelId from, std::int32_t slot, StageId stage, Time first) {
  Mark* const there = mark(slot, stage);
  if (there == nullptr) return;
  Time last = cost_ - there->distance;
  if (from != kNoLabel) last = std::min(last, intervals_.last_entry(graph_[from].slot, slot));
  if (first > last) return;
  if (there->label == kNoLabel)
    there->label = graph_.add({.slot = slot, .stage = stage, .earliest = kNever});
  if (Label& to = graph_[there->label]; first < to.earliest) {
    to.earliest = first;
    queue_.push(first, {.slot = there->label, .time = first});
  }
  if (from != kNoLabel) graph_.add_move({from, there->label, first, last});
}

// Returns the mark of the pair, nullptr if no memory is available.
MddBuilder::Workspace::Mark* MddBuilder::Workspace::mark(std::int32_t slot, StageId stage) {
  if (!planes_.open(stage, *limits_)) return nullptr;
  Mark& mark = planes_.label(slot, stage);
  if (!planes_.is_current(mark))
    mark = {.label = kNoLabel,
            .distance = goals_->distance(stage, intervals_.state_of(slot)),
            .stamp = planes_.stamp()};
  return &mark;
}

void MddBuilder::Workspace::go_backward() {
  graph_.index_targets();
  queue_.reset(0);
  find_ends();
  useful_.clear();
  BucketQueue::Entry entry;
  while (queue_.pop(entry)) {
    if (graph_[entry.slot].latest != entry.time) continue;
    GROVE_ASSERT(entry.time >= graph_[entry.slot].earliest && entry.time < cost_,
                 "a useful label can be reached by its latest time");
    useful_.push_back(entry.slot);
    graph_.for_each_move_into(entry.slot, [&](const Move& move) { leave_by(move, entry.time); });
  }
}

void MddBuilder::Workspace::Graph::index_targets() {
  first_in_.assign(labels_.size() + 1, 0);
  for (const Move& move : moves_) ++first_in_[move.to];
  for (std::size_t label = 1; label < first_in_.size(); ++label)
    first_in_[label] += first_in_[label - 1];
  into_.resize(moves_.size());
  for (std::size_t move = 0; move < moves_.size(); ++move)
    into_[--first_in_[moves_[move].to]] = static_cast<std::int32_t>(move);
  GROVE_ASSERT(std::ranges::is_sorted(first_in_) && first_in_.front() == 0,
               "each move is in the index once");
}

void MddBuilder::Workspace::find_ends() {
  ends_.clear();
  for (LabelId label = 0; label < graph_.label_count(); ++label) {
    if (!is_end(graph_[label])) continue;
    bool reached = cost_ == 0;
    graph_.for_each_move_into(label, [&](const Move& move) {
      if (last_arrival(move, cost_) != cost_) return;
      leave_by(move, cost_);
      reached = true;
    });
    if (reached) ends_.push_back(label);
  }
}

// Raises the latest time of the label that `move` leaves, for arrivals of the move at `arrival` or
// earlier.
void MddBuilder::Workspace::leave_by(const Move& move, Time arrival) {
  const Time last = last_arrival(move, arrival);
  Label& from = graph_[move.from];
  if (last < move.first || last - 1 <= from.latest) return;
  from.latest = last - 1;
  queue_.push(cost_ - from.latest, {.slot = move.from, .time = from.latest});
}

// Returns the last possible arrival of the move, `latest` or earlier; a time before move.first if
// there is none.
Time MddBuilder::Workspace::last_arrival(const Move& move, Time latest) const {
  return intervals_.last_move(graph_[move.from].slot, place(move.to), std::min(latest, move.last));
}

bool MddBuilder::Workspace::is_end(const Label& label) const {
  return goals_->is_rest(goals_->stage(label.stage), intervals_.state_of(label.slot)) &&
         intervals_.may_rest(label.slot);
}

std::size_t MddBuilder::Workspace::count_nodes() const {
  std::size_t count = ends_.size();
  for (const LabelId label : useful_)
    count += static_cast<std::size_t>(graph_[label].latest - graph_[label].earliest + 1);
  return count;
}

void MddBuilder::Workspace::write_layers() {
  written_.clear();
  nodes_.assign(static_cast<std::size_t>(graph_.label_count()), kNoNode);
  here_ = ends_;
  write_nodes(cost_);
  here_.clear();
  auto next = useful_.begin();
  for (Time time = cost_ - 1; time >= 0; --time) {
    std::erase_if(here_, [&](LabelId label) { return graph_[label].earliest > time; });
    for (; next != useful_.end() && graph_[*next].latest == time; ++next) here_.push_back(*next);
    write_nodes(time);
  }
  written_.first_of_layer_.push_back(written_.node_count());
  written_.first_successor_.push_back(static_cast<std::int32_t>(written_.successors_.size()));
}

// Writes the nodes of one layer.
void MddBuilder::Workspace::write_nodes(Time time) {
  NodeId node = written_.node_count();
  written_.first_of_layer_.push_back(node);
  for (const LabelId label : here_) {
    written_.first_successor_.push_back(static_cast<std::int32_t>(written_.successors_.size()));
    written_.places_.push_back(place(label));
    if (!world_.states_are_places()) written_.states_.push_back(state(label));
    if (time < cost_) write_successors(label, time);
  }
  for (const LabelId label : here_) nodes_[label] = node++;
}

void MddBuilder::Workspace::write_successors(LabelId from, Time time) {
  const Label& label = graph_[from];
  const Time then = time + 1;
  if (then <= label.latest) written_.successors_.push_back(nodes_[from]);
  for (const Move& move : graph_.moves_from(label)) {
    const bool leads_on =
        then < cost_ ? then <= graph_[move.to].latest : nodes_[move.to] != kNoNode;
    if (leads_on && then >= move.first && last_arrival(move, then) == then)
      written_.successors_.push_back(nodes_[move.to]);
  }
}

}  // namespace grove::detail

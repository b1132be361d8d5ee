// SPDX-License-Identifier: MIT
// Tests the task farm on simulated ranks, with delayed messages and a solver that only lets time
// pass.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>

#include "batch/result_table.h"
#include "io/input_error.h"
#include "mpi/batch/farm_client.h"
#include "mpi/batch/farm_master.h"
#include "mpi/simulated_network.h"
#include "simulated_ranks.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail::batch {
namespace farm_test {

namespace fs = std::filesystem;

using Ids = std::vector<std::string>;

std::vector<Entry> numbered_entries(int count) {
  std::vector<Entry> entries;
  for (int k = 0; k < count; ++k) {
    const std::string id = "i" + std::to_string(k);
    entries.push_back({.id = id, .path = id + ".cts.json", .digest = "d" + id});
  }
  return entries;
}

// Inputs and observed results of a run.
struct Trial {
  int ranks = 1;
  int per_group = 1;
  std::uint64_t seed = 0;
  std::vector<Entry> entries = numbered_entries(11);
  double total_time_limit_s = std::numeric_limits<double>::infinity();
  double interrupt_at = std::numeric_limits<double>::infinity();
  int interrupt_rank = -1;  // -1: all ranks
  double kill_at = std::numeric_limits<double>::infinity();
  std::function<double(int rank, const Entry&)> duration_s = {};  // nullptr: random, up to 50 ms
  std::function<void(int rank, const Entry&)> work = {};          // can throw
  std::function<void(const BatchState&)> watch = {};

  std::vector<Ids> begun = {};     // by rank
  std::vector<Ids> finished = {};  // by rank
  std::optional<BatchState> end_state = {};
  bool interrupted = false;
  int left = 0;
};

// Forwards to a different transport, and calls `look` before it sends a message.
class WatchedTransport : public Transport {
 public:
  using Look = std::function<void(int to, const std::string& bytes)>;
  WatchedTransport(Transport& other, Look look) : other_(other), look_(std::move(look)) {}
  int rank() const override { return other_.rank(); }
  int ranks() const override { return other_.ranks(); }
  std::optional<ReceivedMessage> receive() override { return other_.receive(); }

 private:
  void do_send(int to, std::string bytes) override {
    look_(to, bytes);
    other_.send(to, std::move(bytes));
  }

  Transport& other_;
  const Look look_;
};

// Runs the program once on all ranks.
class Simulation {
 public:
  Simulation(const std::string& folder, Trial& run)
      : folder_(folder),
        run_(run),
        grouping_{run.ranks, run.per_group},
        random_(run.seed),
        ranks_(run.ranks, run.seed),
        world_(run.ranks, delay()),
        interrupted_(static_cast<std::size_t>(run.ranks)) {
    for (int group = 0; group < grouping_.groups(); ++group)
      groups_.push_back(std::make_unique<SimulatedNetwork>(size_of(group), delay()));
    ranks_.on_time = [this](double now) { on_time(now); };
    run_.begun.assign(interrupted_.size(), {});
    run_.finished.assign(interrupted_.size(), {});
  }

  void run() {
    ranks_.run([this](int rank) { run_rank(rank); });
    if (ranks_.killed()) return;
    for (int rank = 0; rank < run_.ranks; ++rank) {
      EXPECT_EQ(world_.next_arrival(rank), std::numeric_limits<double>::infinity());
      EXPECT_EQ(groups_[grouping_.group_of(rank)]->next_arrival(grouping_.rank_in_group(rank)),
                std::numeric_limits<double>::infinity());
    }
  }

 private:
  int size_of(int group) const {
    return std::min(run_.per_group, run_.ranks - group * run_.per_group);
  }

  SimulatedNetwork::DelayModel delay() {
    return [this](int, int, std::size_t) {
      const bool is_late = random_() % 8 == 0;
      return std::uniform_real_distribution<double>(0, is_late ? 0.03 : 0.002)(random_);
    };
  }

  void on_time(double now) {
    world_.advance_to(now);
    for (auto& group : groups_) group->advance_to(now);
    if (now >= run_.interrupt_at)
      for (int rank = 0; rank < run_.ranks; ++rank)
        if (run_.interrupt_rank < 0 || run_.interrupt_rank == rank) interrupted_[rank] = true;
    if (now >= run_.kill_at) ranks_.kill();
  }

  // Corresponds to main() on one rank.
  void run_rank(int rank) {
    std::optional<ResultTable> table;
    std::optional<FarmMaster> master;
    const BatchClock clock{[this] { return ranks_.now(); }, [] { return std::string("now"); }};
    WatchedTransport world(world_.at(rank), [this](int to, const std::string& bytes) {
      if (std::holds_alternative<Assignment>(decode(bytes))) expect_on_disk(run_.finished[to]);
    });
    if (rank == 0) {
      table.emplace(folder_, TableOf::kPlans);
      fs::create_directory(fs::path(folder_) / "plans");
      master.emplace(world, grouping_, run_.entries, *table, interrupted_[0], clock,
                     MasterOptions{{}, run_.total_time_limit_s, run_.watch});
    }
    Transport& group = groups_[grouping_.group_of(rank)]->at(grouping_.rank_in_group(rank));
    const ClientOptions options{
        .solve = [this, rank](const Entry& entry, Row& row,
                              const auto& poll) { solve(rank, entry, row, poll); },
        .threads = 2,
        .version = "v",
        .clock = clock,
        .idle = [this, rank] { ranks_.pause(rank); }};
    FarmClient client(world, group, interrupted_[rank], options, master ? &*master : nullptr);
    client.run();
    if (!master) return;
    EXPECT_TRUE(master->done());
    run_.end_state = master->state();
    run_.interrupted = master->interrupted();
    run_.left = master->left();
  }

  bool group_is_interrupted(int rank) const {
    for (int other = 0; other < run_.ranks; ++other)
      if (grouping_.group_of(other) == grouping_.group_of(rank) && interrupted_[other]) return true;
    return false;
  }

  double duration_s(int rank, const Entry& entry) const {
    if (run_.duration_s) return run_.duration_s(rank, entry);
    std::mt19937_64 random(std::hash<std::string>()(entry.id) + static_cast<unsigned>(rank));
    return std::uniform_real_distribution<double>(0, 0.05)(random);
  }

  void solve(int rank, const Entry& entry, Row& row, const std::function<void()>& poll) {
    const bool leads = grouping_.rank_in_group(rank) == 0;
    if (rank == 0)
      expect_on_disk(run_.finished[0]);  // rank 0 assigns itself instances without messages
    run_.begun[rank].push_back(entry.id);
    const double end = ranks_.now() + duration_s(rank, entry);
    while (ranks_.now() < end) {
      poll();
      ranks_.pause(rank);
      if (group_is_interrupted(rank)) {
        row.outcome.error = "interrupt";
        return;
      }
    }
    if (run_.work) run_.work(rank, entry);
    run_.finished[rank].push_back(entry.id);
    row.plan_file = plan_file(entry.id);
    if (leads) std::ofstream(fs::path(folder_) / row.plan_file) << entry.id;
    row.outcome = {.status = "optimal", .solved = true, .cost = 3, .lower_bound = 3};
  }

  // Expects that the rows of `ids` are on disk, because the row of an instance must be there before
  // its group gets the next instance.
  void expect_on_disk(const Ids& ids) const {
    const std::string text = file_content(fs::path(folder_) / "results.jsonl");
    for (const std::string& id : ids)
      EXPECT_NE(text.find("{\"instance\":\"" + id + "\""), std::string::npos) << id;
  }

  const std::string folder_;
  Trial& run_;
  const Grouping grouping_;
  std::mt19937_64 random_;
  grove::detail::testing::SimulatedRanks ranks_;
  SimulatedNetwork world_;
  std::vector<std::unique_ptr<SimulatedNetwork>> groups_;
  std::vector<std::atomic<bool>> interrupted_;
};

class Farms : public ::testing::Test {
 protected:
  void simulate(Trial& run) {
    Simulation(folder_, run).run();
    expect_groups_together(run);
  }

  // Returns the rows on disk; each must be the only row of its instance.
  std::vector<Row> rows() const {
    const ResultTable table(folder_, TableOf::kPlans);
    std::vector<Row> rows = table.rows();
    const auto id = [](const Row& row) { return id_of(row); };
    std::ranges::sort(rows, {}, id);
    EXPECT_TRUE(std::ranges::adjacent_find(rows, {}, id) == rows.end());
    const std::string text = file_content(fs::path(folder_) / "results.jsonl");
    EXPECT_EQ(std::ranges::count(text, '\n'), static_cast<int>(rows.size()));
    return rows;
  }

  static const std::string& id_of(const Entry& entry) { return entry.id; }
  static const std::string& id_of(const Row& row) { return row.run.instance; }
  static Ids sorted_ids(const auto& items) {
    Ids ids;
    for (const auto& item : items) ids.push_back(id_of(item));
    std::ranges::sort(ids);
    return ids;
  }

  // Returns the instances that the group leaders, which report the rows, have finished.
  static Ids finished_by_leaders(const Trial& run) {
    Ids ids;
    for (int rank = 0; rank < run.ranks; rank += run.per_group)
      ids.insert(ids.end(), run.finished[rank].begin(), run.finished[rank].end());
    std::ranges::sort(ids);
    return ids;
  }

  static void expect_groups_together(const Trial& run) {
    if (run.kill_at < std::numeric_limits<double>::infinity()) return;
    for (int rank = 0; rank < run.ranks; ++rank)
      EXPECT_EQ(run.begun[rank], run.begun[rank / run.per_group * run.per_group]);
  }

  // Calls `test` with runs for several numbers of ranks, group sizes and seeds.
  static void for_all(const std::function<void(Trial run)>& test) {
    for (const int ranks : {1, 2, 3, 7})
      for (const int per_group : {1, 2, 3})
        for (const std::uint64_t seed : {1, 2}) {
          SCOPED_TRACE(::testing::Message()
                       << ranks << " ranks, groups of " << per_group << ", seed " << seed);
          test(Trial{.ranks = ranks, .per_group = per_group, .seed = seed});
        }
  }

  void use_new_folder() { folder_ = directory_ / ("out" + std::to_string(++folders_)); }
  std::string csv() const { return file_content(fs::path(folder_) / "results.csv"); }

  TemporaryDirectory directory_;
  int folders_ = 0;
  std::string folder_ = directory_ / "out";
};

TEST_F(Farms, SolveEveryInstanceOnce) {
  for_all([&](Trial run) {
    use_new_folder();
    simulate(run);
    EXPECT_EQ(finished_by_leaders(run), sorted_ids(run.entries));
    const auto table = rows();
    EXPECT_EQ(sorted_ids(table), sorted_ids(run.entries));
    for (const Row& row : table) {
      EXPECT_EQ(row.outcome.cost, 3);
      EXPECT_EQ(row.run.digest, "d" + row.run.instance);
      EXPECT_EQ(row.outcome.version, "v");
      EXPECT_EQ(row.threads, 2);
      EXPECT_EQ(row.ended_at, "now");
      EXPECT_GE(row.wall_s, 0);
      EXPECT_LE(row.ranks, std::min(run.ranks, run.per_group));
    }
    EXPECT_EQ(std::ranges::count(csv(), '\n'), 12);
    EXPECT_EQ(run.end_state->solved, 11);
    EXPECT_FALSE(run.end_state->ending);
    EXPECT_EQ(run.left, 0);
    EXPECT_FALSE(run.interrupted);
    Trial again = run;  // with nothing left to solve
    simulate(again);
    EXPECT_EQ(finished_by_leaders(again), Ids{});
    EXPECT_EQ(again.end_state->solved, 11);
    EXPECT_EQ(rows(), table);
  });
}

TEST_F(Farms, StopAfterASignalToOneRank) {
  for (const int rank : {-1, 0, 1, 2}) {
    use_new_folder();
    Trial run{.ranks = 3, .interrupt_at = 0.1, .interrupt_rank = rank};
    run.duration_s = [](int, const Entry&) { return 100; };
    simulate(run);
    EXPECT_TRUE(run.interrupted);
    EXPECT_LT(run.end_state->elapsed_s, 1);
    EXPECT_EQ(run.left, 11);
    EXPECT_TRUE(run.end_state->ending);
    for (const Ids& begun : run.begun) EXPECT_LE(begun.size(), 1u);
  }
}

// Interrupts two runs, on all ranks or on one. An instance in progress then gets no row, and the
// next run of the same command solves only the instances without a row.
TEST_F(Farms, ResumeAfterInterrupts) {
  int interrupted = 0;
  for_all([&](Trial run) {
    use_new_folder();
    Ids finished;
    for (int round = 0; round < 3; ++round) {
      Trial next = run;
      next.seed = 10 * run.seed + static_cast<std::uint64_t>(round);
      if (round < 2) {
        std::mt19937_64 random(next.seed);
        next.interrupt_at = std::uniform_real_distribution<double>(0, 0.15)(random);
        next.interrupt_rank = static_cast<int>(random() % (run.ranks + 1)) - 1;
      }
      simulate(next);
      const Ids more = finished_by_leaders(next);
      finished.insert(finished.end(), more.begin(), more.end());
      std::ranges::sort(finished);
      EXPECT_EQ(sorted_ids(rows()), finished);
      EXPECT_EQ(next.left, 11 - static_cast<int>(finished.size()));
      EXPECT_TRUE(next.left == 0 || next.interrupted);
      if (next.interrupted) ++interrupted;
    }
    EXPECT_EQ(finished, sorted_ids(run.entries));
  });
  EXPECT_GT(interrupted, 24);  // the test must not be vacuous
}

// Kills all ranks, as SIGKILL does, at several times. (The tests of result tables cover a kill
// during a write.)
TEST_F(Farms, ResumeAfterBeingKilled) {
  for_all([&](Trial run) {
    use_new_folder();
    std::size_t before = 0;
    for (int round = 0; round < 3; ++round) {
      Trial next = run;
      next.seed = 10 * run.seed + static_cast<std::uint64_t>(round);
      if (round < 2) next.kill_at = 0.02 + 0.05 * round + 0.01 * static_cast<double>(run.seed);
      simulate(next);
      const auto table = rows();
      EXPECT_GE(table.size(), before);
      before = table.size();
      for (const Row& row : table) EXPECT_TRUE(fs::exists(folder_ + "/" + row.plan_file));
    }
    EXPECT_EQ(sorted_ids(rows()), sorted_ids(run.entries));
  });
}

TEST_F(Farms, WriteRowsOfFailures) {
  for_all([&](Trial run) {
    use_new_folder();
    Trial broken = run;
    broken.work = [](int, const Entry& entry) {
      if (entry.id == "i0" || entry.id == "i5") throw std::runtime_error("cannot\ndo " + entry.id);
    };
    simulate(broken);
    for (const Row& row : rows()) {
      const bool fails = id_of(row) == "i0" || id_of(row) == "i5";
      EXPECT_EQ(row.outcome.error, fails ? "cannot\\ndo " + id_of(row) : "");
      EXPECT_EQ(row.outcome.version, "v");
    }
    EXPECT_EQ(broken.end_state->failed, 2);
    EXPECT_EQ(broken.end_state->solved, 9);
    simulate(run);
    EXPECT_EQ(finished_by_leaders(run), (Ids{"i0", "i5"}));
    EXPECT_EQ(run.end_state->solved, 11);
    EXPECT_EQ(rows().size(), 11u);
  });
}

TEST_F(Farms, ReportWhichRankFailed) {
  Trial run{.ranks = 4, .per_group = 2};
  run.work = [](int rank, const Entry& entry) {
    if (rank == 3 || (rank == 1 && entry.id == "i0")) throw std::runtime_error("no memory");
  };
  simulate(run);
  for (const Row& row : rows()) {
    if (!row.outcome.failed()) continue;
    const std::string& error = row.outcome.error;
    EXPECT_TRUE(error == "rank 3 of the world: no memory" ||
                (id_of(row) == "i0" && error == "rank 1 of the world: no memory"))
        << error;
    EXPECT_FALSE(row.outcome.cost);
  }
  EXPECT_GT(run.end_state->failed, 0);
}

TEST_F(Farms, AssignNothingAfterTheTotalTimeLimit) {
  for_all([&](Trial run) {
    use_new_folder();
    Trial first = run;
    first.total_time_limit_s = 0.04;
    simulate(first);
    EXPECT_EQ(sorted_ids(rows()), finished_by_leaders(first));
    EXPECT_FALSE(first.interrupted);
    EXPECT_EQ(first.end_state->ending, first.left > 0);
    EXPECT_TRUE(first.left > 0 || run.ranks >= 3);
    Trial none = run;
    none.total_time_limit_s = 0;
    simulate(none);
    EXPECT_EQ(finished_by_leaders(none), Ids{});
    simulate(run);
    EXPECT_EQ(sorted_ids(rows()), sorted_ids(run.entries));
  });
}

// Rank 0 solves an instance or waits for a rank of its group. This must not delay other groups.
TEST_F(Farms, AssignInstancesWhileRankZeroIsBusy) {
  struct Case {
    int ranks, per_group, slow;
  };
  for (const Case& c : {Case{2, 1, 0}, Case{5, 1, 0}, Case{4, 2, 1}}) {
    use_new_folder();
    Trial run{.ranks = c.ranks, .per_group = c.per_group};
    run.duration_s = [&](int rank, const Entry&) { return rank == c.slow ? 5 : 0.01; };
    double last_other = 0;
    run.watch = [&](const BatchState& state) {
      if (state.done() < 11) last_other = state.elapsed_s - state.under_way_s;
    };
    simulate(run);
    EXPECT_EQ(run.begun[c.slow].size(), 1u);
    EXPECT_EQ(run.end_state->solved, 11);
    EXPECT_LT(last_other, 4);
  }
}

TEST_F(Farms, AssignInstancesInOrder) {
  Trial run;
  simulate(run);
  EXPECT_EQ(run.begun[0], (Ids{"i0", "i1", "i2", "i3", "i4", "i5", "i6", "i7", "i8", "i9", "i10"}));
}

// If the table cannot be written, the run ends, but the instance in progress does not count as
// failed.
TEST_F(Farms, EndIfTheTableCannotBeWritten) {
  for (const int ranks : {1, 3}) {
    use_new_folder();
    Trial run{.ranks = ranks};
    bool broken = false;
    run.watch = [&](const BatchState& state) {
      if (state.done() < 4 || std::exchange(broken, true)) return;
      throw InputError("results.csv", "", "cannot be written");
    };
    EXPECT_THROW(simulate(run), InputError);
    for (const Row& row : rows()) EXPECT_FALSE(row.outcome.failed());
    EXPECT_LT(rows().size(), 11u);
  }
}

TEST_F(Farms, ReportTheirState) {
  Trial run{.ranks = 3};
  int last = 0;
  int max_under_way = 0;
  run.watch = [&](const BatchState& state) {
    EXPECT_EQ(state.total, 11);
    EXPECT_EQ(state.groups, 3);
    EXPECT_GE(state.done(), last);
    EXPECT_LE(state.done() + state.under_way, state.total);
    EXPECT_GE(state.under_way_s, 0);
    last = state.done();
    max_under_way = std::max(max_under_way, state.under_way);
  };
  simulate(run);
  EXPECT_EQ(last, 11);
  EXPECT_EQ(max_under_way, 3);
  EXPECT_GT(run.end_state->solving_s, 0);
}

}  // namespace farm_test
}  // namespace grove::detail::batch

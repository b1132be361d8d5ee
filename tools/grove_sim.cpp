// SPDX-License-Identifier: MIT
// grove-sim: predicts the scaling of the distributed search on one processor.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/run_observer.h"
#include "io/atomic_file.h"
#include "io/input_error.h"
#include "mpi/simulator/scaling_table.h"
#include "mpi/simulator/simulation.h"
#include "primal/primal_search.h"
#include "tools/common/commands.h"
#include "tools/common/options.h"
#include "tools/common/program.h"
#include "tools/common/signals.h"
#include "tools/common/standard_error.h"
#include "tools/solve/solve_arguments.h"
#include "tools/solve/start_plan.h"

namespace grove::detail {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kDescription =
    R"(Predicts how fast grove-mpi would solve an instance on a machine with many more processors
than this one. It solves the instance once for each number of ranks: one thread executes all
ranks in turn, with the engine's own code, on a simulated clock. An expansion, or a subproblem of
the Lagrangian bound, takes the time of its work on this processor, and a message the time that
follows from the options for the network. The simulation of a few ranks takes about as long as a
solve with one thread, of 128 ranks two to five times as long, of 1,024 up to fifteen times.
)";

constexpr const char* kFooter =
    R"(The table (CSV, one row per number of ranks; wall_s: simulated seconds):
  speed_up, efficiency        against one rank; efficiency = speed-up / ranks
  nodes_overhead, expanding_overhead
                              nodes, and time for them and for subproblems, beyond those of one rank
  messages..., bytes..., nodes_sent
                              sent by all ranks
  communication_share               share of the ranks' time for sending and receiving
  coordinator_communication_share   the same of rank 0: near 1, rank 0 limits the search
  coordinator_wait_s          mean time until rank 0 processes a message
  max_over_mean, idle_share   balance of the work; share of the workers' time without work
  first_node_s, ranks_without_node
                              when ranks received their first node; how many never did

Assumptions: each rank has one worker, and another processor for its messages; processors do not
slow each other down; the network has no other traffic. There is no primal search outside the
tree, so use a good start plan: --start, or the plan that the primal search finds in
--primal-steps. With --omega 0 and an optimal plan, the nodes that must be expanded are nearly
fixed, so the result shows scaling; otherwise it also depends on luck. The time to read the
instance and to start ranks is not included.

A run that reached a limit is unfinished: its row has only how far it came.

Without --seconds-per-work the run of one rank is timed, and its mean time per unit of work (about
one label of the low level) is the cost of work in the other runs. If the value is given, all
results are repeatable.

Examples:
  grove-sim benchmarks/data/rooms-32x32_n10_m30.cts.json --omega 0 --ranks 1,2,16
  grove-sim INSTANCE.cts.json --omega 0 --start PLAN --output scaling.csv)";

struct SimArguments {
  SolveArguments solve;
  std::vector<std::int64_t> ranks{1, 2, 16, 128, 1024, 4096};
  Machine machine;
  std::int64_t primal_steps = 2000;
  std::filesystem::path profile;
};

void add_options(CLI::App& app, SimArguments& a) {
  a.solve.time_limit_s = 3600;
  a.solve.instance.add_to(app);
  add_integers(app, "--ranks", a.ranks, {1, 1 << 16},
               "numbers of ranks; one rank is always simulated as well, for comparison")
      ->default_str("1,2,16,128,1024,4096");
  add_number(app, "--latency", a.machine.latency, 0, 1e3, "latency of a message, seconds")
      ->type_name("S");
  add_number(app, "--bandwidth", a.machine.bandwidth, 1, 1e15,
             "bytes that a rank packs and sends, or receives and unpacks, per second")
      ->type_name("B/S");
  add_number(
      app, "--message-cost", a.machine.message_cost, 0, 1e3,
      "time that sender and receiver need for each message in addition to its bytes, seconds")
      ->type_name("S");
  add_number(
      app, "--poll", a.machine.poll, 0, 1e3,
      "maximum interval at which a rank polls the network, seconds; shorter soon after a message")
      ->type_name("S");
  add_number(app, "--cost-per-work", a.machine.seconds_per_work, 0, 1e3,
             "deprecated name of --seconds-per-work")
      ->group("");
  add_number(app, "--seconds-per-work", a.machine.seconds_per_work, 0, 1e3,
             "time per unit of work, seconds; 0: as measured here")
      ->type_name("S");
  a.solve.instance.add_rules_to(app);
  add_omega_option(app, a.solve);
  add_method_options(app, a.solve);
  app.add_option("--start", a.solve.start, "plan file of this instance: the first incumbent")
      ->type_name("PLAN");
  add_integer(app, "--primal-steps", a.primal_steps, {0, 1'000'000'000},
              "without --start: search for a plan first, for about N milliseconds");
  add_number(app, "--time-limit", a.solve.time_limit_s, 0, 1e9,
             "time limit of the simulation of each number of ranks, seconds")
      ->type_name("S");
  add_number(app, "--memory-limit", a.solve.memory_limit_gb, 0, 1e6,
             "memory limit of this process for each number of ranks, GB")
      ->type_name("GB");
  app.add_option("--output", a.solve.output, "write the table to this file as well")
      ->type_name("TABLE.csv");
  app.add_option(
         "--profile", a.profile,
         "write the number of busy workers in each hundredth of each run's time to this file")
      ->type_name("FILE.csv");
}

// Returns the best plan that the primal search finds in `steps` steps without a constraint tree.
// Returns nullopt if it finds none.
std::optional<Plan> find_plan(const Problem& problem, const SolveOptions& options,
                              const Limits& limits, std::int64_t steps) {
  AgentStopsCache stops(problem.instance, problem.distances);
  PrimalSearch primal(problem, stops, options.seed, options.techniques, options.tuning);
  std::optional<Plan> best;
  for (std::int64_t i = 0; i < steps && !primal.optimal() && !limits.stop_requested(); ++i)
    if (auto plan = primal.step(limits)) best = std::move(plan);
  return best;
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Study {
 public:
  explicit Study(SimArguments& arguments)
      : a_(arguments), options_(options_of_one_search(a_.solve)), loaded_(load(a_.solve)) {
    require_fit_of_one_search(a_.solve, loaded_.instance, options_, "grove-sim");
    for (const auto& file : {a_.solve.output, a_.profile}) {
      if (file.empty()) continue;
      require_distinct_files(file, a_.solve.instance.path(), "the instance");
      require_distinct_files(file, loaded_.map_path, "the map");
      require_distinct_files(file, a_.solve.start, "the start plan");
      require_writable(file);
    }
    require_distinct_files(a_.profile, a_.solve.output, "the table");
  }

  void run() {
    const Limits unlimited;
    const Problem problem(loaded_.instance, unlimited);
    RunObserver silent;
    if (presolve(problem, options_, unlimited, silent))
      throw InputError(a_.solve.instance.name(), "",
                       "presolve shows that there is no plan; expected an instance to search");
    find_start_plan(problem);
    print_line(scaling_header());
    const SimulatedRun alone = simulated(problem, 1);
    calibrate(alone);
    for (const std::int64_t ranks : a_.ranks) {
      if (interrupted) break;
      if (ranks == 1)
        report(alone, alone);
      else
        report(simulated(problem, static_cast<int>(ranks)), alone);
    }
    if (!a_.solve.output.empty()) write_file_atomically(a_.solve.output, table_);
    if (!a_.profile.empty()) write_file_atomically(a_.profile, profile_);
  }

 private:
  void find_start_plan(const Problem& problem) {
    Limits limits;
    limits.watch_interrupt(&interrupted);
    options_.start = a_.solve.start.empty() ? find_plan(problem, options_, limits, a_.primal_steps)
                                            : read_valid_plan(a_.solve.start, loaded_.instance);
    note(options_.start ? fmt::format("starting with a plan of cost {}", options_.start->cost)
                        : "starting without a plan");
  }

  SimulatedRun simulated(const Problem& problem, int ranks) {
    const Clock::time_point start = Clock::now();
    Limits limits;
    set_limits(limits, a_.solve, start);
    SimulatedRun run = simulate(problem, options_, limits, ranks, a_.machine);
    double processor_s = 0;
    double busy_s = 0;
    for (const SimulatedRun::Rank& rank : run.ranks) {
      processor_s += rank.worker.processor_s;
      busy_s += rank.worker.busy_s;
    }
    const SimulatedRun::Rank& first = run.ranks.front();
    note(fmt::format(
        "{} {}simulated in {:.1f} s, {:.0f} MB; expansions took {:.2f} s here, {:.2f} s by their "
        "work; rank 0 {:.1f} us here for a message that it sent or received, {:.1f} as simulated",
        ranks == 1 ? "1 rank" : fmt::format("{} ranks", ranks), run.ended ? "" : "not to the end, ",
        seconds_since(start), static_cast<double>(peak_resident_bytes()) / 1e6, processor_s, busy_s,
        1e6 * first.communication_processor_s /
            static_cast<double>(first.received + first.messages + 1),
        1e6 * first.communication_s / static_cast<double>(first.received + first.messages + 1)));
    return run;
  }

  // Unless --seconds-per-work is given, sets it for the other runs to the mean of the run with one
  // rank. If that run did no work, leaves the value at 0, so that each run measures its own.
  void calibrate(const SimulatedRun& alone) {
    const SimulatedWorker::Tally& tally = alone.ranks.front().worker;
    if (a_.machine.seconds_per_work > 0 || tally.work <= 0) return;
    a_.machine.seconds_per_work = tally.processor_s / tally.work;
    note(fmt::format("--seconds-per-work {:.4g}", a_.machine.seconds_per_work));
  }

  void report(const SimulatedRun& run, const SimulatedRun& alone) {
    print_line(csv_line(scaling_row(run, alone)));
    for (std::size_t i = 0; i < run.busy.size(); ++i)
      profile_ +=
          fmt::format("{},{:.6g},{:.6g}\n", run.ranks.size(),
                      run.wall_s * static_cast<double>(i) / SimulatedRun::kParts, run.busy[i]);
  }

  void print_line(const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
    table_ += line + '\n';
  }
  static void note(const std::string& text) { print_to_stderr("grove-sim: " + text); }

  SimArguments& a_;
  SolveOptions options_;
  LoadedInstance loaded_;
  std::string table_;
  std::string profile_ = "ranks,from_s,busy\n";
};

int main(int argc, char** argv) {
  stop_on_signals();
  CLI::App app(kDescription, "grove-sim");
  app.footer(kFooter);
  prepare_program(app);
  app.require_subcommand(0);
  SimArguments arguments;
  add_options(app, arguments);
  app.callback([&] { Study(arguments).run(); });
  return run_only_process(app, argc, argv);
}

}  // namespace
}  // namespace grove::detail

int main(int argc, char** argv) {
  return grove::detail::main(argc, argv);
}

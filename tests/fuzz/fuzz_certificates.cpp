// SPDX-License-Identifier: MIT
// grove-fuzz-certificates: certifies searches on tiny instances of all kinds. It tests that the
// checker verifies every certificate, that the verified bound is true, and that the checker never
// accepts a false claim in a mutated certificate. The checker is a separate program (--verify).
// Exit codes: 0 no failure, 1 failure, 2 bad usage.
#include <fmt/format.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "assignment/assignment_search.h"
#include "assignment/priced_instance.h"
#include "assignment/route_bound.h"
#include "engine/all_assignments.h"
#include "engine/choices.h"
#include "engine/run_observer.h"
#include "planning/agent_stops_cache.h"
#include "planning/problem.h"
#ifdef GROVE_WITH_CADICAL
#include "cores/core_search.h"
#endif
#include "io/instance_file.h"
#include "io/map_file.h"
#include "io/roadmap_file.h"
#include "proof/certificate.h"
#include "proof/proof_parts.h"
#include "tests/fuzz/certificate_lines.h"
#include "tests/fuzz/certificate_mutation.h"
#include "tests/fuzz/component_case.h"
#include "tests/fuzz/formula_model.h"
#include "tests/fuzz/fuzz_case.h"
#include "tests/fuzz/random.h"
#include "tests/oracle/joint_oracle.h"

namespace grove::detail::fuzz {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

struct Arguments {
  fs::path verify;
  fs::path folder = ".";
  int count = 200;
  int mutations = 0;
  std::uint64_t seed = 1;
  double seconds = 0.5;  // time limit of each case
  bool json = false;
  std::string part = "any";
};

constexpr std::size_t kOracleStates = 300'000;
constexpr std::int64_t kEffort = 1'000'000;  // of a call of the search over all assignments

constexpr const char* kFooter =
    R"(Searches tiny instances whose optimum is known, certifies their bounds, and has the checker verify
them and what they become when they are mutated. Exit codes: 0 all is well, 1 not, 2 bad usage.

The long campaign, some 100,000 mutated certificates, takes about ten minutes of one core, most of
them calls of the checker:
  grove-fuzz-certificates --verify build/release/bin/grove-verify --folder FOLDER --count 2600 --mutations 50
On several cores, each with a folder and seeds of its own:
  grove-fuzz-certificates --verify build/release/bin/grove-verify --folder A --count 1300 --mutations 50 &
  grove-fuzz-certificates --verify build/release/bin/grove-verify --folder B --count 1300 --mutations 50 \
      --seed 1301)";

struct Verdict {
  int code = 0;
  std::string text;
  Cost bound = 0;  // the verified bound, if code == 0
};

Verdict verdict_of(const Arguments& a, const fs::path& instance, const fs::path& proof,
                   const std::string& options = "") {
  const std::string command = fmt::format("'{}' '{}' '{}' {} 2>&1", a.verify.string(),
                                          instance.string(), proof.string(), options);
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run the checker");
  Verdict verdict;
  std::array<char, 4096> buffer{};
  while (const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), pipe))
    verdict.text.append(buffer.data(), size);
  const int status = ::pclose(pipe);
  verdict.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (verdict.code != 0) return verdict;
  constexpr std::string_view kCost = "verified: no plan costs less than ";
  const std::size_t at = verdict.text.find(kCost);
  if (at == std::string::npos) {
    verdict.bound =
        verdict.text.find("verified: there is no plan") != std::string::npos
            ? kInfiniteCost
            : throw std::runtime_error("unexpected output of the checker: " + verdict.text);
  } else {
    verdict.bound = std::stoll(verdict.text.substr(at + kCost.size()));
  }
  return verdict;
}

// Interrupts a run when it has expanded two nodes. By then the Lagrangian bound has its final
// value.
class StopsAtSecondNode : public RunObserver {
 public:
  explicit StopsAtSecondNode(Limits& limits) { limits.watch_interrupt(&interrupt_); }
  void on_event(RunEvent /*event*/, const Progress& progress) override {
    if (progress.nodes_expanded >= 2) interrupt_ = true;
  }

 private:
  std::atomic<bool> interrupt_ = false;
};

class Trial {
 public:
  explicit Trial(const Arguments& a)
      : a_(a),
        part_of_search_(std::ranges::find(kParts, a.part, &NamedPart::name)->part),
        map_(a.folder / "proofs.map"),
        roadmap_(a.folder / "proofs.roadmap.json"),
        instance_file_(a.folder / "proofs.cts.json"),
        part_(a.folder / "proofs.part"),
        proof_(a.folder / "proofs.proof"),
        mutant_(a.folder / "proofs.mutant") {}

  void test_seed(std::uint64_t seed) {
    seed_ = seed;
    case_ = component_case(part_of_search_, seed);
    case_.options.audit = false;
    if (part_of_search_ == Part::kAny && seed % 3 == 0) prefer_tree_and_lagrangian(seed);
    const Instance instance = case_.build();
    if (find_uncertified_choice(instance)) return;
    if (part_of_search_ == Part::kChoices && !instance.has_choices()) return;
    const oracle::Answer truth = oracle::solve_jointly(instance, kOracleStates);
    if (truth.verdict == oracle::Verdict::kTooLarge) return;
    optimum_ = truth.plan ? truth.plan->cost : kInfiniteCost;
    write(instance);
    if (part_of_search_ != Part::kAny && !instance.has_choices() && truth.plan && seed % 4 < 2)
      case_.options.start = higher_cost_plan(instance, *truth.plan);
    Solution solution;
    try {
      solution = solve(instance);
    } catch (const std::exception& error) {
      ++threw_;
      return complain(error.what());
    }
    const bool is_infeasible = solution.status == Status::kInfeasible;
    const Cost claimed = is_infeasible ? kInfiniteCost : solution.lower_bound;
    const Certificate made = write_certificate(instance, std::array{part_}, claimed, proof_);
    judge(made, claimed, solution);
    test_mutants(seed);
    try {
      if (part_of_search_ == Part::kCores) test_core_search(instance, truth, seed);
      if (part_of_search_ == Part::kChoices && truth.plan)
        test_all_assignments(instance, *truth.plan, seed);
    } catch (const std::exception& error) {
      ++threw_;
      complain(error.what());
    }
  }

  bool is_well() const { return wrong_ == 0; }
  // Read by mutants.py.
  std::string json() const {
    return fmt::format(
        "{{\"cases\": {}, \"false\": {}, \"refused\": {}, \"refused_false\": {}, \"believed\": {}, "
        "\"threw\": {}}}",
        cases_, false_, refused_or_short_, refused_false_, false_and_verified_, threw_);
  }
  std::string summary() const {
    std::string text = fmt::format(
        "{} certificates: {} of the claimed bound, {} of the optimum, {} of a lower bound (by "
        "reason: ",
        cases_, whole_, of_optimum_, cases_ - whole_);
    for (const auto& [reason, count] : lesser_) text += fmt::format("{}: {}; ", reason, count);
    text += fmt::format(")\n{} formulas are true for the optimal plan\n", formulas_);
    text += fmt::format("{} mutated: {} refused, {} unreadable, {} believed and true\n{} wrong",
                        mutants_, refused_, unreadable_, believed_, wrong_);
    return text;
  }

 private:
  // Without these options, incumbents or the joint search end most runs before the tree search has
  // proven much, and the Lagrangian bound does not run because there are too few agents.
  void prefer_tree_and_lagrangian(std::uint64_t seed) {
    SolveOptions& options = case_.options;
    options.omega = Omega::from_double(0);
    options.policy = Policy::kFree;
    options.techniques =
        Techniques::defaults().without(Technique::kPrimal).without(Technique::kJointSearch);
    if (seed % 2 != 0) return;
    options.tuning.lagrangian_min_agents = 1;
    options.tuning.lagrangian_start_work = 0;
    options.tuning.lagrangian_max_share = 100;
  }

  void write(const Instance& instance) const {
    if (const Roadmap* roadmap = instance.roadmap()) {
      write_roadmap(roadmap_, *roadmap, Durability::kProcess);
      write_instance(instance_file_, instance, roadmap_.filename(), Durability::kProcess);
    } else {
      write_map(map_, instance.grid());
      write_instance(instance_file_, instance, map_.filename(), Durability::kProcess);
    }
  }

  Solution solve(const Instance& instance) const {
    fs::remove(part_);  // left by the previous case
    ProofRecorder recorder(part_);
    SolveOptions options = case_.options;
    options.proof = &recorder;
    Limits limits;
    limits.set_deadline(Limits::Clock::now() +
                        std::chrono::microseconds(static_cast<std::int64_t>(a_.seconds * 1e6)));
    StopsAtSecondNode stops_early(limits);
    RunObserver* const observer = part_of_search_ == Part::kPrices ? &stops_early : nullptr;
    RunObserver none;
    const Solution solution = instance.has_choices()
                                  ? solve_with_choices(instance, options, limits, none)
                                  : detail::solve(instance, options, limits, observer);
    recorder.flush();
    return solution;
  }

  void judge(const Certificate& made, Cost claimed, const Solution& solution) {
    ++cases_;
    const Verdict verdict = verdict_of(a_, instance_file_, proof_);
    const bool is_false = claimed > optimum_;
    const bool is_refused = verdict.code != 0 || verdict.bound < claimed;
    false_ += is_false ? 1 : 0;
    refused_or_short_ += is_refused ? 1 : 0;
    refused_false_ += is_false && is_refused ? 1 : 0;
    false_and_verified_ += verdict.code == 0 && verdict.bound > optimum_ ? 1 : 0;
    if (verdict.code != 0)
      complain(fmt::format("a certificate of {} is not verified: {}", made.bound, verdict.text));
    else if (verdict.bound != made.bound)
      complain(fmt::format("{} was certified, and {} verified", made.bound, verdict.bound));
    else if (verdict.bound > optimum_)
      complain(fmt::format("{} was verified, and the optimum is {}", verdict.bound, optimum_));
    if (made.bound >= claimed) ++whole_;
    if (made.bound == optimum_) ++of_optimum_;
    if (made.bound >= claimed) return;
    const auto reason = solution.stats.texts.find("reason");
    ++lesser_[reason == solution.stats.texts.end() ? "none given" : reason->second.substr(0, 40)];
    if (reason == solution.stats.texts.end())
      complain(fmt::format("only {} of {} is certified", made.bound, claimed));
  }

  void test_mutants(std::uint64_t seed) {
    const Lines original = certificate_lines(proof_);
    for (int i = 0; i < a_.mutations; ++i)
      verify_mutant(original, seed * 1000 + static_cast<std::uint64_t>(i));
  }

  // The core search by itself, with different cutoffs, so that each bound above the sum of the
  // least costs is proven by a formula.
  void test_core_search([[maybe_unused]] const Instance& instance,
                        [[maybe_unused]] const oracle::Answer& truth,
                        [[maybe_unused]] std::uint64_t seed) {
#ifdef GROVE_WITH_CADICAL
    fs::remove(part_);
    ProofRecorder recorder(part_);
    const auto agents = static_cast<std::size_t>(instance.agent_count());
    recorder.tree({.root = 1, .cost = 0, .sequences = std::vector<Sequence>(agents)});
    Limits limits;
    limits.set_deadline(Limits::Clock::now() +
                        std::chrono::microseconds(static_cast<std::int64_t>(a_.seconds * 1e6)));
    const Problem problem(instance, limits);
    const AgentStopsCache stops(instance, problem.distances);
    constexpr std::size_t kMaxBytes = std::size_t{1} << 30;
    CoreSearch search(problem, stops, case_.options.techniques, kMaxBytes, limits, &recorder);
    const std::array<Cost, 4> cutoffs{kInfiniteCost, optimum_, optimum_ + 1, optimum_ + 3};
    const Cost cutoff = truth.plan ? cutoffs[seed / 2 % cutoffs.size()] : kInfiniteCost;
    while (search.step(cutoff) == CoreSearch::Outcome::kWorking) continue;
    if (!search.is_set_up()) return;
    recorder.formula_bound(search.lower_bound());
    recorder.flush();
    const Certificate made =
        write_certificate(instance, std::array{part_}, search.lower_bound(), proof_);
    judge(made, search.lower_bound(), Solution{});
    const Lines lines = certificate_lines(proof_);
    if (truth.plan) check_formula(lines, instance, *truth.plan);
    test_mutants(seed);
#endif
  }

  // The search over all assignments by itself, with multipliers of different quality. With bad ones
  // the least prices prove less, and the clauses must prove more.
  void test_all_assignments(const Instance& instance, const Plan& optimal, std::uint64_t seed) {
    Random random(seed ^ 0xA55);
    fs::remove(part_);
    ProofRecorder recorder(part_);
    SolveOptions options = case_.options;
    options.proof = &recorder;
    Limits limits;
    limits.set_deadline(Limits::Clock::now() +
                        std::chrono::microseconds(static_cast<std::int64_t>(a_.seconds * 1e6)));
    const DistanceFields distances(instance);
    AssignmentSearch assignments(instance, distances, seed);
    if (!assignments.first(limits)) return;
    RouteBound routes(assignments.routes());
    routes.improve(random.pick<std::int64_t>({50, 500, 5'000, 100'000}), limits);
    const Cost cutoff = optimum_ + random.between(0, 3);
    const auto search = AllAssignmentsSearch::make(instance, routes, cutoff, options, limits);
    if (!search) return;
    while (search->run(cutoff, kEffort) && !limits.stop_requested()) continue;
    recorder.flush();
    const Cost proven = std::min(search->lower_bound(), cutoff);
    judge(write_certificate(instance, std::array{part_}, proven, proof_), proven, Solution{});
    check_formula(certificate_lines(proof_), instance, optimal);
    test_mutants(seed + 1);
  }

  // The clauses of a formula that are true for all plans up to the optimum must be true for the
  // optimal plan.
  void check_formula([[maybe_unused]] const Lines& original,
                     [[maybe_unused]] const Instance& instance, [[maybe_unused]] const Plan& plan) {
#ifdef GROVE_WITH_CADICAL
    const Lines definitions = definitions_only(original, optimum_);
    if (definitions.empty()) return;
    ++formulas_;
    write_lines(definitions);
    const fs::path clauses = a_.folder / "proofs.cnf";
    fs::remove(clauses);
    const Verdict verdict =
        verdict_of(a_, instance_file_, mutant_, fmt::format("--clauses '{}'", clauses.string()));
    if (verdict.code != 1)
      complain("a formula without steps is not refused: " + verdict.text);
    else if (!has_model(clauses, definitions, instance, plan))
      complain("the optimal plan violates the clauses of a formula");
#endif
  }

  void write_lines(const Lines& lines) const {
    std::ofstream out(mutant_, std::ios::binary);
    for (const std::string& line : lines) out << line << '\n';
  }

  void verify_mutant(const Lines& original, std::uint64_t seed) {
    const Lines lines = mutated(original, seed);
    if (lines == original) return;
    write_lines(lines);
    ++mutants_;
    const Verdict verdict = verdict_of(a_, instance_file_, mutant_);
    switch (verdict.code) {
      case 0:
        if (verdict.bound > optimum_)
          complain(fmt::format("mutated with seed {}: {} is believed, and the optimum is {}", seed,
                               verdict.bound, optimum_));
        ++believed_;
        return;
      case 1:
        ++refused_;
        return;
      case 2:
        ++unreadable_;
        return;
      default:
        complain(fmt::format("mutated with seed {}: the checker ends with {}: {}", seed,
                             verdict.code, verdict.text));
    }
  }

  void complain(const std::string& what) {
    ++wrong_;
    if (a_.json) return;
    fmt::print("case {}: WRONG: {}\n{}\n", seed_, what, case_.to_text());
  }

  const Arguments& a_;
  const Part part_of_search_;
  const fs::path map_, roadmap_, instance_file_, part_, proof_, mutant_;
  std::uint64_t seed_ = 0;
  FuzzCase case_;
  Cost optimum_ = 0;
  int false_ = 0, refused_or_short_ = 0, refused_false_ = 0, false_and_verified_ = 0, threw_ = 0;
  int formulas_ = 0;
  int cases_ = 0, whole_ = 0, of_optimum_ = 0, wrong_ = 0;
  int mutants_ = 0, refused_ = 0, unreadable_ = 0, believed_ = 0;
  std::map<std::string, int> lesser_;
};

}  // namespace
}  // namespace grove::detail::fuzz

int main(int argc, char** argv) {
  grove::detail::fuzz::Arguments a;
  CLI::App app("Certificates of tiny instances, checked and mutated", "grove-fuzz-certificates");
  app.footer(grove::detail::fuzz::kFooter);
  app.add_option("--verify", a.verify, "the checker")->required()->check(CLI::ExistingFile);
  app.add_option("--folder", a.folder, "directory for files; created if missing");
  app.add_option("--count", a.count)->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--mutations", a.mutations, "number of mutations of each certificate")
      ->capture_default_str();
  app.add_option("--seed", a.seed, "seed of the first case; each next case has the next seed")
      ->capture_default_str();
  app.add_option("--seconds", a.seconds, "time limit of each case")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  std::vector<std::string> parts;
  for (const auto& named : grove::detail::fuzz::kParts) parts.emplace_back(named.name);
  app.add_option("--part", a.part, "component of the search that must prove the whole bound")
      ->check(CLI::IsMember(parts))
      ->capture_default_str();
  app.add_flag("--json", a.json, "print only the counts, as JSON");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  std::filesystem::create_directories(a.folder);
  grove::detail::fuzz::Trial trial(a);
  for (int i = 0; i < a.count; ++i) trial.test_seed(a.seed + static_cast<std::uint64_t>(i));
  fmt::print("{}\n", a.json ? trial.json() : trial.summary());
  return trial.is_well() ? 0 : 1;
}

// SPDX-License-Identifier: MIT
// Discrete-event simulation of a distributed search. Each rank has a worker and a communicator. An
// event is a time at which one of them is due to act; its actions schedule further events. One
// thread runs all ranks, with the engine's own coordinator, ranks, nodes and workers. One expander
// serves all workers. For each work item it uses the caches of the item's rank, and its per-agent
// data as they were after that rank's last node. Therefore a rank uses only its own results and
// those that other ranks sent to it.
//
// *Polls.* A communicator polls the network periodically, but a poll has an effect only if a
// message has arrived or there is something new to send. Therefore only the first poll after such a
// cause is simulated.
//
// *Batching.* Between two polls a rank neither receives nor sends anything, so all work items of
// its worker up to the next poll run in succession. This keeps the data of the rank in the
// processor's caches, which cannot hold the data of a thousand ranks.
#include "mpi/simulator/simulation.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <queue>
#include <stdexcept>
#include <utility>

#include "engine/solve.h"
#include "mpi/polling.h"
#include "mpi/rank_process.h"
#include "mpi/simulated_network.h"
#include "mpi/simulator/busy_profile.h"
#include "mpi/simulator/simulated_worker.h"
#include "mpi/simulator/timed_transport.h"

namespace grove::detail {
namespace {

constexpr double kNotDue = std::numeric_limits<double>::infinity();
constexpr double kGoldenRatio = 0.6180339887;  // its multiples spread evenly over [0, 1)

// Returns the options without primal search, because simulated ranks run none.
SolveOptions without_primal(SolveOptions options) {
  options.techniques = options.techniques.without(Technique::kPrimal);
  return options;
}

// Data shared by all ranks.
struct Setting {
  Setting(const Problem& the_problem, const SolveOptions& the_options, const Limits& the_limits,
          int ranks, const Machine& the_machine)
      : problem(the_problem),
        options(without_primal(the_options)),
        limits(the_limits),
        machine(the_machine),
        network(ranks,
                [this](int, int, std::size_t) { return communication.takes_s + machine.latency; }),
        stops(problem.instance, problem.distances) {
    for (AgentIndex agent = 0; agent < problem.instance.agent_count(); ++agent) stops.of(agent);
  }

  const Problem& problem;
  const SolveOptions options;
  const Limits& limits;
  const Machine& machine;
  RunObserver observer;
  Communication communication;
  SimulatedNetwork network;
  AgentStopsCache stops;
  MddInterner sets;
};

struct SimulatedRank {
  SimulatedRank(Setting& setting, int rank)
      : limits(setting.limits, kNotDue),
        transport(setting.network, rank, setting.machine, setting.communication),
        member(setting.problem, setting.options, limits, setting.observer, transport,
               setting.stops),
        worker(member.rank().components(), rank),
        player(worker, setting.machine, setting.sets),
        heard_at(setting.machine.poll *
                 (rank * kGoldenRatio - std::floor(rank * kGoldenRatio) - 1)) {}

  bool has_work() { return member.rank().components().has_work(); }

  const Limits limits;  // one per rank, because each rank cancels its own worker
  TimedTransport transport;
  RankProcess member;
  Worker worker;
  SimulatedWorker player;
  double heard_at;  // when the last message was handled; determines the poll times
  double communication_due = kNotDue;
  double communicates_until = 0;  // end of the current or last communication
  double communication_s = 0;
  double communication_processor_s = 0;
  bool sent_finished = false;
  bool left = false;
};

class Simulation {
 public:
  explicit Simulation(Setting& setting, int ranks)
      : setting_(setting),
        expander_(setting.problem, setting.stops, search_options_of(setting.options)) {
    for (int rank = 0; rank < ranks; ++rank) ranks_.emplace_back(setting, rank);
    communicated(0, 0);
  }

  SimulatedRun run() {
    bool stopped = false;
    while (left_ < std::ssize(ranks_) && !stopped) {
      if (agenda_.empty()) {
        stopped = setting_.limits.stop_requested();  // before the first tree
        if (stopped) break;
        throw std::logic_error("the simulated search has no next event");
      }
      const Event event = agenda_.top();
      agenda_.pop();
      setting_.network.advance_to(event.time);
      now_ = event.time;
      if (event.actor == Actor::kCommunicator)
        communication(event.rank);
      else
        work(event.rank);
      stopped = setting_.limits.stop_requested();
    }
    return result(!stopped);
  }

 private:
  enum class Actor : std::uint8_t { kCommunicator, kWorker };
  struct Event {
    double time;
    std::int64_t serial;  // number of the event in order of scheduling
    int rank;
    Actor actor;
  };
  struct Later {
    bool operator()(const Event& a, const Event& b) const {
      return a.time != b.time ? a.time > b.time : a.serial > b.serial;
    }
  };

  SimulatedRank& at(int rank) { return ranks_[static_cast<std::size_t>(rank)]; }
  void schedule(double time, int rank, Actor actor) {
    agenda_.push({time, serial_++, rank, actor});
  }

  // Returns the first time, at or after `time`, at which the rank can communicate.
  double first_communication(SimulatedRank& r, double time) const {
    const double interval = max_poll_interval(r.member.rank().ended(), setting_.machine.poll);
    if (time > r.communicates_until) time = next_poll(r.heard_at, time, interval);
    return std::max(time, r.communicates_until);
  }

  // Schedules a poll by the rank at its first poll time at or after `time`.
  void communicate_from(double time, int rank) {
    SimulatedRank& r = at(rank);
    time = first_communication(r, time);
    if (time >= r.communication_due) return;
    r.communication_due = time;
    schedule(time, rank, Actor::kCommunicator);
  }

  void communication(int rank) {
    SimulatedRank& r = at(rank);
    if (r.communication_due != now_) return;  // obsolete event: the rank has communicated since
    r.communication_due = kNotDue;
    setting_.communication = {};
    const double before_s = processor_time();
    const bool heard = r.member.exchange_messages(now_);
    if (r.member.rank().ended() && !r.sent_finished) {
      if (r.player.busy()) abandon_work(r);
      r.member.rank().send_finished({});
      r.sent_finished = true;
    }
    r.communication_processor_s += processor_time() - before_s;
    communicated(rank, now_);
    if (heard) r.heard_at = r.communicates_until;
  }

  // Schedules what follows from the communication that this rank started at `time`.
  void communicated(int rank, double time) {
    SimulatedRank& r = at(rank);
    r.communicates_until = time + setting_.communication.takes_s;
    r.communication_s += setting_.communication.takes_s;
    for (const int to : setting_.communication.receivers)
      communicate_from(setting_.network.next_arrival(to), to);
    if (const double next = setting_.network.next_arrival(rank); next < kNotDue)
      communicate_from(next, rank);
    if (const double next = r.member.next_send_time(); next < kNotDue) communicate_from(next, rank);
    if (!r.sent_finished && !r.player.busy() && r.has_work())
      schedule(r.communicates_until, rank, Actor::kWorker);
    if (!r.sent_finished || r.left || !r.member.left()) return;
    r.left = true;
    ++left_;
    wall_s_ = std::max(wall_s_, r.communicates_until);
  }

  // Runs work items of the rank's worker, up to the first one that ends at or after the next
  // possible communication.
  void work(int rank) {
    SimulatedRank& r = at(rank);
    if (r.sent_finished) return;
    const double alone_until = first_communication(r, now_);
    for (double time = now_; time == now_ || time < alone_until; time = r.player.busy_until()) {
      if (r.player.busy() && !end_work_item(rank, time)) return;
      r.player.begin(time, expander_);
      if (!r.player.busy()) return;
    }
    schedule(r.player.busy_until(), rank, Actor::kWorker);
  }

  // Ends the current work item. Returns false if the item ends after `time`, because the event was
  // scheduled before the item started.
  bool end_work_item(int rank, double time) {
    SimulatedRank& r = at(rank);
    if (r.player.busy_until() > time) return false;
    r.player.end();
    profile_.add(r.player.began(), time);
    communicate_from(time, rank);
    return true;
  }

  void abandon_work(SimulatedRank& r) {
    r.player.abandon(now_);
    profile_.add(r.player.began(), now_);
  }

  SimulatedRun result(bool ended) {
    SimulatedRun run;
    run.ended = ended;
    run.solution = at(0).member.coordinator()->conclude();
    run.wall_s = ended ? wall_s_ : now_;
    for (const SimulatedRank& r : ranks_)
      run.ranks.push_back({r.player.tally(), r.communication_s, r.transport.messages(),
                           r.transport.bytes(), r.transport.received(), r.transport.waited_s(),
                           r.communication_processor_s});
    run.busy = profile_.means(run.wall_s, SimulatedRun::kParts);
    return run;
  }

  Setting& setting_;
  std::deque<SimulatedRank> ranks_;
  Expander expander_;
  std::priority_queue<Event, std::vector<Event>, Later> agenda_;
  std::int64_t serial_ = 0;
  double now_ = 0;
  std::int64_t left_ = 0;
  double wall_s_ = 0;
  BusyProfile profile_;
};

}  // namespace

SimulatedRun simulate(const Problem& problem, const SolveOptions& options, const Limits& limits,
                      int ranks, const Machine& machine) {
  Setting setting(problem, options, limits, ranks, machine);
  return Simulation(setting, ranks).run();
}

}  // namespace grove::detail

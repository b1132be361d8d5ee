// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstdint>
#include <exception>
#include <string>

#include "api/access.h"
#include "api/run.h"
#include "engine/solve.h"
#include "grove/mpi.hpp"
#include "model/fingerprint.h"
#include "mpi/mpi_shared_memory.h"
#include "mpi/mpi_transport.h"
#include "mpi/shared_problem.h"
#include "mpi/solve_distributed.h"

namespace grove::mpi {
namespace {

void require_mpi() {
  int initialized = 0;
  int finalized = 0;
  int provided = MPI_THREAD_SINGLE;
  MPI_Initialized(&initialized);
  MPI_Finalized(&finalized);
  if (initialized == 1 && finalized == 0) MPI_Query_thread(&provided);
  if (provided < MPI_THREAD_FUNNELED)
    throw Error(
        "MPI is not initialised for threads; expected MPI_Init_thread with MPI_THREAD_FUNNELED");
}

// Collective. Returns the minimum of `mine` over all ranks.
std::int64_t least(std::int64_t mine, MPI_Comm communicator) {
  std::int64_t all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT64_T, MPI_MIN, communicator);
  return all;
}

// Collective. If `function` throws on one rank, an exception is thrown on all ranks.
template <class Function>
void collective(MPI_Comm communicator, Function&& function) {
  std::exception_ptr failure;
  try {
    function();
  } catch (...) {
    failure = std::current_exception();
  }
  const bool all_well = least(failure ? 0 : 1, communicator) == 1;
  if (failure) std::rethrow_exception(failure);
  if (!all_well) throw InvalidArgument("", "another rank refused its arguments");
}

void require_same(const detail::Instance& instance, MPI_Comm communicator) {
  const auto mine = static_cast<std::int64_t>(detail::fingerprint(instance));
  const std::int64_t smallest = least(mine, communicator);
  const std::int64_t greatest = ~least(~mine, communicator);
  if (smallest != greatest)
    throw InvalidArgument("/instance", "found different instances on the ranks; expected the same");
}

detail::SolveOptions shared_options(const detail::Instance& instance, const Options& options) {
  detail::SolveOptions search = search_options_of(instance, options);
  if (search.deterministic)
    throw InvalidArgument("/deterministic", "not supported with several processes; expected false");
  const auto method = detail::parse_method(options.method);
  if (method && detail::is_adaptation(*method))
    throw InvalidArgument(
        "/method", fmt::format("'{}' is not supported with several processes", options.method));
  return search;
}

}  // namespace

std::optional<Solution> solve(const Instance& instance, const Options& options,
                              MPI_Comm communicator) {
  require_mpi();
  const detail::Instance& inner = Access::instance(instance);
  detail::SolveOptions search;
  collective(communicator, [&] { search = shared_options(inner, options); });
  require_same(inner, communicator);
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);

  const auto [bytes, zero_bytes] = detail::SharedProblem::need(inner);
  const detail::MpiSharedMemory memory(communicator, bytes, zero_bytes);
  Run run(inner, options);
  std::optional<detail::Solution> answer;
  detail::Solution to_public =
      run([&](const detail::Limits& limits, detail::RunObserver& observer) -> detail::Solution {
        return with_public_exceptions([&] {
          detail::RunObserver silent;
          detail::RunObserver& listener = rank == 0 ? observer : silent;
          const detail::SharedProblem shared(inner, limits, search.threads, memory);
          const detail::Problem& problem = shared.problem();
          answer = presolve(problem, search, limits, listener);
          const bool all_search = least(answer ? 0 : 1, communicator) == 1;
          if (all_search) {
            detail::MpiTransport network(communicator);
            answer = solve_distributed(problem, search, limits, network, listener, [] {});
          } else if (rank == 0 && !answer) {  // a limit was reached on another rank
            answer = detail::solve(problem, search, limits, &listener);
          }
          return answer.value_or(detail::Solution());
        });
      });
  if (rank != 0) return std::nullopt;
  return public_solution(inner, to_public);
}

}  // namespace grove::mpi

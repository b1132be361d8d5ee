// SPDX-License-Identifier: MIT
#include "tools/mpi/rank_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <thread>
#include <utility>

#include "io/file_descriptor.h"
#include "tools/common/machine.h"

namespace grove::detail {
namespace {

std::vector<int> gather_numbers(const MpiSession& session, int mine) {
  std::vector<int> all;
  for (const std::string& text : session.gather(std::to_string(mine)))
    all.push_back(std::stoi(text));
  return all;
}

// Collective. Returns the number of ranks on which `mine` equals that of this rank.
int count_equal(const MpiSession& session, const std::string& mine) {
  return static_cast<int>(std::ranges::count(session.gather(mine), mine));
}

}  // namespace

void divide_machine(const CLI::App& app, SolveArguments& arguments, const MpiSession& session) {
  const int on_cores = count_equal(session, host_name() + usable_cores_text());
  const int on_host = count_equal(session, host_name());
  if (app.count("--threads") == 0) arguments.threads = std::max(1, usable_cores() / on_cores);
  if (app.count("--memory-limit") == 0) arguments.memory_limit_gb /= on_host;
}

RankLayout gather_rank_layout(const MpiSession& session, std::int64_t threads,
                              const SharedMemory& memory) {
  return {session.gather(host_name()),
          gather_numbers(session, static_cast<int>(threads)),
          gather_numbers(session, usable_cores()),
          gather_numbers(session, static_cast<int>(std::thread::hardware_concurrency())),
          session.gather(memory.why_not()),
          memory.bytes().size()};
}

std::string workers_text(const RankLayout& layout) {
  const bool same = std::set(layout.threads.begin(), layout.threads.end()).size() == 1;
  const auto hosts = std::set(layout.hosts.begin(), layout.hosts.end()).size();
  return fmt::format("{}{} on {} rank{}, {} host{}{}",
                     same ? fmt::format("{}", layout.threads.front())
                          : fmt::format("{}", fmt::join(layout.threads, ", ")),
                     layout.threads.size() > 1 && same ? " each" : "", layout.threads.size(),
                     layout.threads.size() == 1 ? "" : "s", hosts, hosts == 1 ? "" : "s",
                     layout.shared_bytes == 0
                         ? ""
                         : fmt::format(", {} MB shared", layout.shared_bytes / 1'000'000));
}

std::vector<std::string> warnings(const RankLayout& layout) {
  std::vector<std::string> found;
  std::map<std::string, std::pair<int, int>> by_host;  // threads, cores
  std::map<std::string, std::string> unshared;         // by host: the reason
  for (std::size_t rank = 0; rank < layout.hosts.size(); ++rank) {
    auto& [threads, cores] = by_host[layout.hosts[rank]];
    threads += layout.threads[rank];
    cores = layout.host_cores[rank];
    if (!layout.unshared[rank].empty()) unshared[layout.hosts[rank]] = layout.unshared[rank];
    if (layout.threads[rank] > layout.cores[rank] && layout.cores[rank] < layout.host_cores[rank])
      found.push_back(fmt::format(
          "rank {} has {} threads and may use {} of {} cores; see mpirun's --bind-to none, or "
          "srun's --cpus-per-task",
          rank, layout.threads[rank], layout.cores[rank], layout.host_cores[rank]));
  }
  for (const auto& [name, counts] : by_host) {
    const auto [threads, cores] = counts;
    if (threads > cores)
      found.push_back(fmt::format("host {} has {} cores for {} threads", name, cores, threads));
    else if (threads < cores)
      found.push_back(fmt::format(
          "host {} has {} cores, of which {} will be used; to use more, see --threads, mpirun's "
          "--bind-to none and srun's --cpus-per-task",
          name, cores, threads));
  }
  for (const auto& [name, why] : unshared)
    found.push_back(fmt::format(
        "ranks on host {} share no memory, each has its own distances and tables: {}", name, why));
  return found;
}

}  // namespace grove::detail

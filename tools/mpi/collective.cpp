// SPDX-License-Identifier: MIT
#include "tools/mpi/collective.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>
#include <vector>

namespace grove::detail {

void collective(const MpiSession& session, const std::function<void()>& what) {
  std::exception_ptr mine;
  std::string why;
  try {
    what();
  } catch (const InputError& error) {
    mine = std::current_exception();
    why = error.what();
  } catch (const CLI::ValidationError& error) {
    mine = std::current_exception();
    why = error.what();
  }
  const std::vector<std::string> all = session.gather(why);
  const auto failed = std::ranges::find_if(all, [](const auto& text) { return !text.empty(); });
  if (failed == all.end()) return;
  if (std::ranges::count(all, why) == session.ranks()) std::rethrow_exception(mine);
  throw InputError(fmt::format("rank {}", failed - all.begin()), "", *failed);
}

void CommandLines::accept() {
  agreed_ = true;
  const std::vector<std::string> all = session_.gather("");
  const auto refused = std::ranges::find_if(all, [](const auto& why) { return !why.empty(); });
  if (refused != all.end())
    throw InputError(fmt::format("rank {}", refused - all.begin()), "", *refused);
}

void CommandLines::refuse(const std::string& why) {
  if (!std::exchange(agreed_, true)) session_.gather(why);
}

void require_same(const MpiSession& session, const std::string& what, const std::string& mine) {
  const std::vector<std::string> all = session.gather(mine);
  const auto other =
      std::ranges::find_if(all, [&](const auto& text) { return text != all.front(); });
  if (other == all.end()) return;
  throw InputError(
      fmt::format("rank {}", other - all.begin()), "",
      fmt::format("found {} {}; expected {}, that of rank 0", what, *other, all.front()));
}

}  // namespace grove::detail

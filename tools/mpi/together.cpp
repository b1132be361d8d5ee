// SPDX-License-Identifier: MIT
#include "tools/mpi/together.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace grove::detail {

void together(const MpiSession& session, const std::function<void()>& what) {
  std::optional<InputError> mine;
  try {
    what();
  } catch (const InputError& error) {
    mine = error;
  }
  const std::vector<std::string> all = session.gather(mine ? mine->what() : "");
  const auto failed = std::ranges::find_if(all, [](const auto& text) { return !text.empty(); });
  if (failed == all.end()) return;
  if (mine && std::ranges::count(all, mine->what()) == session.ranks()) throw *mine;
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

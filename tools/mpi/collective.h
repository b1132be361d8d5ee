// SPDX-License-Identifier: MIT
// Operations that all ranks execute together, and which may fail on some of them.
#pragma once

#include <CLI/Error.hpp>
#include <functional>
#include <string>

#include "io/input_error.h"
#include "mpi/mpi_session.h"
#include "tools/common/commands.h"

namespace grove::detail {

// Collective. Calls `what` on each rank. If it throws InputError or CLI::ValidationError on any
// rank, throws on all: the same exception if all threw the same text, else InputError with the text
// of the first rank that failed, and its number.
void collective(const MpiSession& session, const std::function<void()>& what);

// Agreement of all ranks that their command lines are valid. Command lines and programs may differ
// between ranks, and a rank that ended by itself would leave the others waiting.
class CommandLines {
 public:
  // `session` must outlive this.
  explicit CommandLines(const MpiSession& session) : session_(session) {}

  // Each rank calls one of the two first. A command that starts calls accept(), which throws
  // InputError if another rank refused. After accept(), refuse() has no effect, so only errors that
  // occur on all ranks may end the command.
  void accept();
  void refuse(const std::string& why);

 private:
  const MpiSession& session_;
  bool agreed_ = false;
};

// Collective. Throws InputError unless `mine` is the same on all ranks. `what`: for instance
// "version".
void require_same(const MpiSession& session, const std::string& what, const std::string& mine);

}  // namespace grove::detail

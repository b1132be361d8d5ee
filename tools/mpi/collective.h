// SPDX-License-Identifier: MIT
// Collective operations that can fail on some ranks.
#pragma once

#include <CLI/Error.hpp>
#include <functional>
#include <string>

#include "io/input_error.h"
#include "mpi/mpi_session.h"
#include "tools/common/commands.h"

namespace grove::detail {

// Collective. Calls `what` on each rank. If it throws InputError or CLI::ValidationError on any
// rank, this function throws on all ranks: the same exception if it threw the same text on all
// ranks, otherwise InputError with the number and the text of the first rank that failed. Any other
// exception propagates on its rank only, which must then abort the job.
void collective(const MpiSession& session, const std::function<void()>& what);

// Lets all ranks agree whether their command lines are valid. Command lines and programs can differ
// between ranks, and if only one rank ended, the others would wait for it forever.
class CommandLines {
 public:
  // `session` must outlive this object.
  explicit CommandLines(const MpiSession& session) : session_(session) {}

  // Collective. Each rank must first call either accept(), when its command starts, or refuse().
  // accept() throws InputError if another rank refused. After accept(), refuse() has no effect, so
  // the command may then end only by errors that occur on all ranks; see the function collective().
  void accept();
  void refuse(const std::string& why);

 private:
  const MpiSession& session_;
  bool agreed_ = false;
};

// Collective. Throws InputError unless `mine` is equal on all ranks. `what`: its name in the error
// message, for instance "version".
void require_same(const MpiSession& session, const std::string& what, const std::string& mine);

}  // namespace grove::detail

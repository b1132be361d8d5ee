// SPDX-License-Identifier: MIT
// What all ranks do, each for itself, and which may fail on some of them.
#pragma once

#include <CLI/Error.hpp>
#include <functional>
#include <string>

#include "io/input_error.h"
#include "mpi/mpi_session.h"
#include "tools/common/commands.h"

namespace grove::detail {

// All ranks: calls `what`, and throws on all of them if it threw InputError or CLI::ValidationError
// on any: what all threw if they say the same, else InputError with the text of the first and which
// rank that is.
void collective(const MpiSession& session, const std::function<void()>& what);

// Whether all ranks accept their command lines, which may not be the same, nor the programs that
// read them. A rank alone would leave the others waiting for it.
class CommandLines {
 public:
  // `session` must outlive this.
  explicit CommandLines(const MpiSession& session) : session_(session) {}

  // All ranks do one of the two, once. A command that begins accepts: throws InputError if another
  // rank did not. Whoever has accepted may refuse what all refuse.
  void accept();
  void refuse(const std::string& why);

 private:
  const MpiSession& session_;
  bool agreed_ = false;
};

// All ranks: throws InputError unless all say the same. `what` is, for instance, "version".
void require_same(const MpiSession& session, const std::string& what, const std::string& mine);

}  // namespace grove::detail

// SPDX-License-Identifier: MIT
// Visitor composed of lambdas, for std::visit.
#pragma once

namespace grove::detail {

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;  // needed by clang 16

}  // namespace grove::detail

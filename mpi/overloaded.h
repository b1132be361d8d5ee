// SPDX-License-Identifier: MIT
// A visitor made of lambdas.
#pragma once

namespace grove::detail {

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;  // clang 16 asks for it

}  // namespace grove::detail

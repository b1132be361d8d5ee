// SPDX-License-Identifier: MIT
// One solve with the options of a user: sets the limits and calls the user's callbacks.
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <stop_token>

#include "engine/method.h"
#include "engine/run_observer.h"
#include "grove/solve.hpp"

namespace grove {

// Converts and checks `options`. Throws InvalidArgument if they are invalid or do not suit
// `instance`.
detail::SolveOptions search_options_of(const detail::Instance& instance, const Options& options);

class Run {
 public:
  // Both arguments must outlive this object.
  Run(const detail::Instance& instance, const Options& options);

  // Returns the result of search(limits, observer), with further statistics. Rethrows what the
  // search or a callback of the user throws.
  template <class Search>
  detail::Solution operator()(Search&& search) {
    detail::Solution solution = search(limits_, observer_);
    if (observer_.failure) std::rethrow_exception(observer_.failure);
    add_facts(solution);
    return solution;
  }

 private:
  using Clock = detail::Limits::Clock;

  class Observer : public detail::RunObserver {
   public:
    Observer(const detail::Instance& instance, const Options& options, std::atomic<bool>& stop,
             Clock::time_point begin)
        : instance_(instance), options_(options), stop_(stop), begin_(begin) {}
    void on_incumbent(const detail::Plan& plan, detail::PlanSource source,
                      const detail::Progress& progress) override;
    void on_event(detail::RunEvent event, const detail::Progress& progress) override;

    std::exception_ptr failure;  // exception of a user's callback

   private:
    Progress to_public(const detail::Progress& progress) const;
    template <class Function>
    void call(Function&& function);

    const detail::Instance& instance_;
    const Options& options_;
    std::atomic<bool>& stop_;
    const Clock::time_point begin_;
    Clock::time_point next_{};  // earliest time of the next on_progress call
  };

  void add_facts(detail::Solution& solution) const;

  const Clock::time_point begin_ = Clock::now();
  std::atomic<bool> stop_{false};
  std::stop_callback<std::function<void()>> stop_with_;
  detail::Limits limits_;
  Observer observer_;
};

}  // namespace grove

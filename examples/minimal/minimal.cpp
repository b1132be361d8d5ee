// SPDX-License-Identifier: MIT
// A minimal program with the library: a world, an instance, a plan with a proven bound, and a new
// plan after a robot was delayed and a task was added.
#include <cstdio>
#include <grove/grove.hpp>

int main() try {
  const grove::World world =
      grove::World::from_rows({"......", ".@@.@.", "......", ".@.@@.", "......"});
  const grove::Instance instance(
      world,
      {{.id = "red", .start = {grove::Cell{0, 0}}, .goal = grove::Cell{5, 4}},
       {.id = "blue", .start = {grove::Cell{5, 0}}, .goal = grove::Cell{0, 4}}},
      {{.id = "press", .place = grove::Cell{3, 1}, .agents = {"red", "blue"}, .duration = 3},
       {.id = "look", .place = grove::Cell{2, 3}, .agents = {"red"}}});

  const grove::Solution solution = grove::solve(
      instance,
      {.omega = 0, .time_limit = 10, .on_incumbent = [](const auto& plan, const auto& at) {
         std::printf("%.2f s: a plan of %ld, none costs less than %ld\n", at.seconds,
                     static_cast<long>(plan.cost), static_cast<long>(at.lower_bound));
       }});
  if (!solution.plan || !grove::check(instance, solution).empty()) return 1;
  for (int time = 0; time <= solution.plan->makespan(); ++time)
    std::printf("%2d  red %s  blue %s\n", time,
                to_string(solution.plan->pose(0, time).place).c_str(),
                to_string(solution.plan->pose(1, time).place).c_str());

  grove::Session session(instance, *solution.plan);
  session.advance(4, {{.agent = "red", .steps = 1}});
  session.change({.new_tasks = {{.id = "more", .place = grove::Cell{0, 2}, .agents = {"blue"}}}});
  const grove::Solution changed = session.replan({.time_limit = 1}, /*commit=*/1);
  if (!changed.plan) return 1;
  std::printf("red is late and blue has one task more: %ld steps from now on\n",
              static_cast<long>(changed.plan->cost));
  return 0;
} catch (const grove::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}

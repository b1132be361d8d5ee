# SPDX-License-Identifier: MIT
"""Turns a warehouse drawn in ASCII into an animated plan: warehouse.html, and warehouse.gif for documents."""
import grove

world = grove.World("""
    ..................
    ..####.####.####..
    ..................
    ..####.####.####..
    ..................
""")
shelves = [(2, 0), (9, 2), (14, 2), (4, 4), (11, 4), (13, 0)]
instance = grove.instance_from_arrays(
    world,
    starts=[(0, y) for y in range(5)],
    goals=[(17, y) for y in range(5)],
    tasks=[[shelves[i], shelves[(i + 2) % 6]] for i in range(5)],
)
solution = grove.solve(instance, time_limit=10, incumbent=lambda plan, at: print(at.seconds, plan))
print(solution, f"gap {100 * solution.gap:.1f} %")
for agent, task, begin, _ in grove.visits(solution.plan):
    print(f"{agent} is at {task} in step {begin}")
grove.picture(solution, "warehouse.gif", width=480)
grove.view(solution).save("warehouse.html")

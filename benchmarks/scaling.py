#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures the scaling of the distributed search: simulated with up to 4096 ranks, and checked with real ranks.

    benchmarks/scaling.py simulate --maps FOLDER [--jobs 2]        three hard instances: simulated.csv
    benchmarks/scaling.py long --ranks 1,128                       instances that take one core minutes: long.csv
    benchmarks/scaling.py weak                                 weak scaling: weak.csv
    benchmarks/scaling.py bound --maps FOLDER                      zero-cost communication: bound.csv
    benchmarks/scaling.py compare --maps FOLDER                    2 ranks, simulated and measured: compared.csv
    benchmarks/scaling.py processor --maps FOLDER                  1 to 8 ranks, by processor time: processor.csv
    benchmarks/scaling.py draw                                     scaling.png from these; needs matplotlib
    benchmarks/scaling.py tables                                   tables in Markdown, to stdout

All commands use the folder --output. Every run starts from a plan and uses no primal heuristics. Therefore the set of
nodes to expand hardly depends on the number of ranks. The start plan is in data/long, or is computed first and optimal.
results/scaling/README.md contains the results.
"""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import resource
import statistics
import sys
import tempfile
from pathlib import Path

from harness import tables
from harness.instances import Case, DrawnCase, Maps, instance_arguments
from harness.programs import MPIRUN, add_folders, median_optimum, optimum, run

HERE = Path(__file__).resolve().parent

# Each of these cases is solved to the optimum after 70,000 to 260,000 nodes. A simulation takes as long as a run on one
# rank, and longer if the ranks expand more nodes.
HARD = [Case("room-32-32-4", 22, 40, 2), Case("random-32-32-20", 50, None, 1),
        Case("room-32-32-4", 40, None, 4)]
# Each of these cases takes minutes on one core and at least 10^6 nodes. data/long contains their start plans.
OPEN = "map random --width 32 --height 32 --obstacles 0.2 --seed 1"
ROOMS = "map rooms --width 32 --height 32 --seed 1"
WAREHOUSE = "roadmap --kind warehouse"
LONG = [DrawnCase("rooms-50-mapf", ROOMS, 50, None, 1), DrawnCase("open-60-mapf", OPEN, 60, None, 1),
         DrawnCase("open-40-40", OPEN, 40, 40, 1), DrawnCase("rooms-25-60-mg", ROOMS, 25, 60, 1, mg=True),
         DrawnCase("rooms-25-50-mg", ROOMS, 25, 50, 1, mg=True),
         DrawnCase("warehouse-100-200", WAREHOUSE, 100, 200, 1)]
# Cases of increasing size for weak scaling: the number of ranks grows with the time on one rank.
WEAK = [DrawnCase(f"rooms-{agents}-mapf", ROOMS, agents, None, 1) for agents in (40, 43, 45, 50)]
# Each of these cases takes seconds on one core, for measurements on the current machine.
SHORT = [Case("room-32-32-4", 20, 20, 3), Case("room-32-32-4", 20, 30, 3),
         Case("room-32-32-4", 20, 40, 1), Case("room-32-32-4", 20, 40, 2)]
RANKS = [1, 2, 16, 128, 1024, 4096]
PROCESSOR_RANKS = [1, 2, 4, 8]
COST_PER_WORK = 1.3e-7  # seconds per unit of effort; see results/scaling/README.md
NO_LIMIT = ["--time-limit", 40000]
FREE_MESSAGES = ["--latency", 0, "--message-cost", 0, "--bandwidth", 1e15, "--poll", 0]
OPTIMAL = ["--omega", 0]
TREE_ONLY = ["--threads", 1, "--without", "primal,lacam"]


def until_bound_of(plan):
    """Returns options to start from a plan and to end as soon as the lower bound in its file is proven."""
    known = json.loads(plan.read_text(encoding="utf-8"))
    return ["--omega", f"{math.ceil((known['cost'] / known['lower_bound'] - 1) * 1e6) / 1e6:f}", "--start", plan]


def prepared(case, a, folder):
    """Returns the arguments of a solve: the case, its start plan and omega.

    The start plan is the one in data/long. If there is none, computes an optimal plan.
    """
    instance = instance_arguments(a.bin / "grove", Maps(a.maps), case, folder)
    kept = HERE / f"data/long/{case}.plan.json"
    if kept.exists():
        return [*instance, *until_bound_of(kept)]
    plan = folder / "start.json"
    optimum([a.bin / "grove", "solve", *instance, *OPTIMAL, "--time-limit", a.time_limit], plan)
    return [*instance, *OPTIMAL, "--start", plan]


def simulated(case, problem, ranks, a, folder, machine=()):
    """Simulates a case and returns a row per number of ranks. Prints runs that reached a limit instead."""
    table = folder / "table.csv"
    run([a.bin / "grove-sim", *problem, "--ranks", ",".join(map(str, ranks)), "--seconds-per-work",
         a.cost_per_work, "--memory-limit", a.memory_limit, "--output", table, *machine])
    with table.open(encoding="utf-8", newline="") as file:
        rows = [{"instance": str(case), **row} for row in csv.DictReader(file)]
    for row in rows:
        if row["status"] == "unfinished":
            print(f"{case}: {row['ranks']} ranks reached a limit (--memory-limit): no row", flush=True)
    return [row for row in rows if row["status"] != "unfinished"]


def measured(before, problem, a, folder):
    """Returns the seconds and the number of expanded nodes of the run with the median time."""
    stats = median_optimum([*before, "solve", *problem, *TREE_ONLY], folder / "plan.json", a.repeat)["stats"]
    return stats["wall_s"], stats["nodes_expanded"]


def write(path, rows):
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def read(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def chosen(cases, a):
    found = [case for case in cases if a.only in str(case)]
    if not found:
        sys.exit(f"scaling.py: error: --only: found '{a.only}'; expected a part of one of "
                 f"{', '.join(map(str, cases))}")
    return found


def merge(path, rows):
    """Adds rows to a file, sorted by instance and number of ranks. They replace rows in which both are the same."""
    def key(row):
        return order.index(row["instance"]), int(row.get("ranks", 0))

    order = [str(case) for case in HARD + SHORT + LONG + WEAK]
    others = read(path) if path.exists() else []
    new = {key(row) for row in rows}
    write(path, sorted([row for row in others if key(row) not in new] + rows, key=key))


def study(cases, output, machine, a):
    def rows_of(case):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            return simulated(case, prepared(case, a, folder), a.ranks, a, folder, machine)

    with concurrent.futures.ThreadPoolExecutor(a.jobs) as pool:
        for rows in pool.map(rows_of, chosen(cases, a)):
            if rows:
                merge(output, rows)
                print(f"{rows[0]['instance']}: simulated", flush=True)


def simulate(a):
    study(HARD, a.output / "simulated.csv", (), a)


def long(a):
    study(LONG, a.output / "long.csv", NO_LIMIT, a)


def ranks_for(alone, seconds):
    """Returns the number of ranks, at least 2, that divides a run on one rank into parts of about `seconds`."""
    return max(2, round(float(alone["wall_s"]) / seconds))


def weak(a):
    for case in chosen(WEAK, a):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            problem = prepared(case, a, folder)
            alone = simulated(case, problem, [1], a, folder, NO_LIMIT)
            rows = alone and simulated(case, problem, [ranks_for(alone[0], a.seconds)], a, folder, NO_LIMIT)
        if not rows:
            continue  # reported by simulated()
        merge(a.output / "weak.csv", alone + rows)
        print(f"{case}: simulated", flush=True)


def bound(a):
    study(HARD, a.output / "bound.csv", FREE_MESSAGES, a)


def comparison(case, a, folder):
    problem = prepared(case, a, folder)
    alone_s, alone_nodes = measured([a.bin / "grove"], problem, a, folder)
    both_s, both_nodes = measured([*MPIRUN, "-np", 2, a.bin / "grove-mpi"], problem, a, folder)
    one, two = simulated(case, problem, [1, 2], a, folder)
    return {"instance": str(case), "nodes_1": alone_nodes, "measured_1_s": f"{alone_s:.3f}",
            "simulated_1_s": f"{float(one['wall_s']):.3f}",
            "nodes_2": both_nodes, "simulated_nodes_2": two["nodes"],
            "measured_2_s": f"{both_s:.3f}", "simulated_2_s": f"{float(two['wall_s']):.3f}",
            "measured_speed_up": f"{alone_s / both_s:.3f}",
            "simulated_speed_up": f"{float(two['speed_up']):.3f}"}


def compare(a):
    for case in chosen(SHORT, a):
        with tempfile.TemporaryDirectory() as name:
            row = comparison(case, a, Path(name))
        merge(a.output / "compared.csv", [row])
        print(f"{case}: compared, load {os.getloadavg()[0]:.1f}", flush=True)


def processor_time(command):
    """Runs a command and returns the processor time of all its processes, in seconds."""
    def used():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    before = used()
    run(command)
    return used() - before


def by_processor(ranks, problem, a, folder):
    """Returns the median processor time of a search on `ranks` ranks in seconds, minus the time without a search."""
    solve = [*MPIRUN, "--oversubscribe", "--bind-to", "none", "-np", ranks, a.bin / "grove-mpi", "solve",
             *problem, *TREE_ONLY, "--quiet", "--output", folder / "plan.json"]
    return statistics.median(processor_time(solve) - processor_time([*solve, "--time-limit", 0.001])
                             for _ in range(a.repeat))


def processor(a):
    """Measures the total processor time of all ranks, also for more ranks than cores."""
    for case in chosen(SHORT, a):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            problem = prepared(case, a, folder)
            rows = [{"instance": str(case), "ranks": row["ranks"], "simulated_s": row["expanding_s"],
                     "processor_s": f"{by_processor(row['ranks'], problem, a, folder):.3f}"}
                    for row in simulated(case, problem, PROCESSOR_RANKS, a, folder)]
        merge(a.output / "processor.csv", rows)
        print(f"{case}: measured, load {os.getloadavg()[0]:.1f}", flush=True)


def shares(row):
    """Returns the shares into which the workers' time in a run divides. They sum to 1.

    If all ranks together spend less time on expansions than a single rank, the overhead is 0.
    """
    whole = float(row["wall_s"]) * int(row["ranks"])
    working = int(row["ranks"]) - int(row["ranks_without_node"])
    first = (working * float(row["first_node_s"])
             + int(row["ranks_without_node"]) * float(row["wall_s"])) / whole
    idle = float(row["idle_share"])
    useful = min(float(row["efficiency"]), 1 - idle)
    return {"expansions of a single rank": useful,
            "search overhead": 1 - idle - useful,
            "start-up idle": min(first, idle),
            "idle": max(0.0, idle - first)}


def overhead(row):
    return f"{100 * float(row['expanding_overhead']):+.1f} %"


def percent(share):
    return f"{100 * float(share):.1f} %"


def simulated_table(rows, free):
    efficiency = {(row["instance"], row["ranks"]): row["efficiency"] for row in free}
    head = ["instance", "ranks", "time", "speed-up", "efficiency", "zero-cost communication", "nodes",
            "search overhead", "start-up idle", "idle", "messages per node", "rank 0 communication"]
    lines = []
    for row in rows:
        _, _, first, later = shares(row).values()
        free_one = efficiency.get((row["instance"], row["ranks"]))
        lines.append([row["instance"], f"{int(row['ranks']):,}", f"{float(row['wall_s']):.3g} s",
                      f"{float(row['speed_up']):.1f}", f"**{percent(row['efficiency'])}**",
                      percent(free_one) if free_one else "",
                      f"{int(row['nodes']):,}", overhead(row),
                      percent(first), percent(later), f"{float(row['messages_per_node']):.2f}",
                      percent(row["coordinator_communication_share"])])
    return tables.table(head, lines)


def earlier_table(earlier, now):
    """Returns a table of the results of an earlier version, each beside the current result if there is one."""
    present = {(row["instance"], row["ranks"]): row for row in now}
    head = ["instance", "ranks", "time", "time now", "efficiency", "efficiency now", "search overhead",
            "search overhead now"]
    lines = []
    for before in earlier:
        both = [before, present.get((before["instance"], before["ranks"]))]
        lines.append([before["instance"], f"{int(before['ranks']):,}"] + [
            shown(row) if row else "" for shown in (
                lambda row: f"{float(row['wall_s']):.3g} s", lambda row: percent(row["efficiency"]),
                overhead) for row in both])
    return tables.table(head, lines)


def weak_table(rows):
    head = ["instance", "nodes", "one rank", "ranks", "time", "efficiency", "search overhead",
            "rank 0 communication"]
    lines = []
    for alone, many in zip(rows[::2], rows[1::2]):
        lines.append([alone["instance"], f"{int(alone['nodes']):,}", f"{float(alone['wall_s']):.3g} s", many["ranks"],
                      f"{float(many['wall_s']):.3g} s", f"**{percent(many['efficiency'])}**",
                      overhead(many),
                      percent(many["coordinator_communication_share"])])
    return tables.table(head, lines)


def compared_table(rows):
    head = ["instance", "nodes, 1 rank", "1 rank measured", "1 rank simulated", "nodes, 2 ranks (simulated)",
            "2 ranks measured", "2 ranks simulated", "speed-up measured", "speed-up simulated"]
    lines = [[row["instance"], row["nodes_1"], f"{row['measured_1_s']} s",
              f"{row['simulated_1_s']} s", f"{row['nodes_2']} ({row['simulated_nodes_2']})",
              f"{row['measured_2_s']} s", f"{row['simulated_2_s']} s",
              f"**{float(row['measured_speed_up']):.2f}**",
              f"**{float(row['simulated_speed_up']):.2f}**"] for row in rows]
    medians = [statistics.median(float(row[column]) for row in rows)
               for column in ("measured_speed_up", "simulated_speed_up")]
    lines.append(["median", *[""] * 6, *[f"**{median:.2f}**" for median in medians]])
    return tables.table(head, lines)


def processor_table(rows):
    """Returns a table of the increase of the total processor time with the number of ranks, relative to one rank."""
    def growth(instance, column):
        times = [float(row[column]) for row in rows if row["instance"] == instance]
        return [f"{100 * (time / times[0] - 1):+.0f} %" for time in times[1:]]

    head = ["instance", "one rank"] + [f"{ranks} ranks{how}" for ranks in PROCESSOR_RANKS[1:]
                                       for how in ("", ", simulated")]
    lines = []
    for instance in dict.fromkeys(row["instance"] for row in rows):
        alone = next(row for row in rows if row["instance"] == instance)
        both = zip(growth(instance, "processor_s"), growth(instance, "simulated_s"))
        lines.append([instance, f"{float(alone['processor_s']):.2f} s", *[text for pair in both for text in pair]])
    return tables.table(head, lines)


def print_tables(a):
    print(simulated_table(read(a.output / "simulated.csv"), read(a.output / "bound.csv")))
    print()
    print(simulated_table(read(a.output / "long.csv"), []))
    print()
    print(earlier_table(read(a.output / "earlier.csv"),
                        read(a.output / "simulated.csv") + read(a.output / "long.csv")))
    print()
    print(weak_table(read(a.output / "weak.csv")))
    print()
    print(compared_table(read(a.output / "compared.csv")))
    print()
    print(processor_table(read(a.output / "processor.csv")))


def draw(a):
    try:
        import matplotlib
    except ImportError:
        raise SystemExit("scaling.py: error: draw: found no module matplotlib; expected the Debian package "
                         "python3-matplotlib") from None
    matplotlib.use("Agg")
    from matplotlib import pyplot

    groups = tables.grouped(read(a.output / "simulated.csv"), "instance")
    figure, panels = pyplot.subplots(1, 1 + len(groups), figsize=(15, 4.8), sharey=True)
    draw_efficiency(panels[0], groups, tables.grouped(read(a.output / "long.csv"), "instance"),
                    tables.grouped(read(a.output / "bound.csv"), "instance"))
    for panel, ((name,), rows) in zip(panels[1:], groups.items()):
        draw_shares(panel, name, rows)
    handles, labels = panels[1].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=len(labels), frameon=False, fontsize=9)
    figure.tight_layout(rect=(0, 0.07, 1, 1))
    figure.savefig(a.output / "scaling.png", dpi=100)


def text_of(ranks):
    return [f"{int(number):,}" for number in ranks]


def draw_efficiency(panel, groups, longer, free):
    def draw_line(rows, line, **look):
        drawn, = panel.plot([int(row["ranks"]) for row in rows],
                            [float(row["efficiency"]) for row in rows], line, **look)
        return drawn.get_color()

    for rows in longer.values():
        draw_line(rows, ".-", color="grey", linewidth=1)
    panel.plot([], [], ".-", color="grey", linewidth=1, label=f"{len(longer)} long instances (minutes on one rank)")
    for (key, rows), marker in zip(groups.items(), "osD"):
        color = draw_line(rows, f"{marker}-", label=f"{key[0]}\n({float(rows[0]['wall_s']):.0f} s on one rank)")
        draw_line(free.get(key, []), "x--", color=color, linewidth=1)
    panel.plot([], [], "x--", color="black", linewidth=1, label="zero-cost communication")
    panel.set_xscale("log", base=2)
    ranks = sorted({int(row["ranks"]) for rows in groups.values() for row in rows})
    panel.set_xticks(ranks, text_of(ranks), rotation=45)
    panel.minorticks_off()
    panel.set_ylim(0, 1.3)
    panel.axhline(1, color="grey", linewidth=0.8, linestyle=":")
    panel.set_xlabel("ranks")
    panel.set_ylabel("efficiency: speed-up / ranks")
    panel.set_title("Efficiency", fontsize=11)
    panel.grid(alpha=0.3)
    panel.legend(fontsize=7.5, loc="lower left")


def draw_shares(panel, name, rows):
    ranks = text_of(row["ranks"] for row in rows)
    bottoms = [0.0] * len(rows)
    colours = ["#2b7bba", "#e6550d", "#bdbdbd", "#e3e3e3"]
    all_shares = [shares(row) for row in rows]
    for label, colour in zip(all_shares[0], colours):
        heights = [share[label] for share in all_shares]
        panel.bar(ranks, heights, bottom=bottoms, label=label, color=colour, width=0.75)
        bottoms = [bottom + height for bottom, height in zip(bottoms, heights)]
    panel.plot(ranks, [float(row["coordinator_communication_share"]) for row in rows], "k.--",
               linewidth=1, label="rank 0 communication (on its own processor)")
    panel.set_xlabel("ranks")
    panel.set_title(f"Workers' time: {name}", fontsize=9.5)
    panel.tick_params(axis="x", rotation=45)


def whole_numbers(text):
    return [int(word) for word in text.split(",")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0],
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["simulate", "long", "hours", "weak", "bound", "compare", "processor", "draw",
                                         "tables"])
    parser.add_argument("--ranks", type=whole_numbers,
                        default=RANKS, help="comma-separated numbers of ranks; the first is 1")
    parser.add_argument("--only", default="", help="only instances whose name contains this text")
    parser.add_argument("--repeat", type=int, default=3, help="runs per measurement; the median counts")
    parser.add_argument("--jobs", type=int, default=1, help="simulations at a time (default: 1)")
    parser.add_argument("--cost-per-work", type=float, default=COST_PER_WORK,
                        help="seconds per unit of work")
    parser.add_argument("--seconds", type=float, default=2.5,
                        help="weak: seconds of the work of a single rank, for each rank")
    parser.add_argument("--memory-limit", type=float, default=8, help="memory limit of a simulation, GB")
    parser.add_argument("--time-limit", type=float, default=600,
                        help="time limit for finding the start plan, seconds")
    parser.add_argument("--output", type=Path, default=HERE / "results/scaling")
    add_folders(parser)
    a = parser.parse_args()
    {"simulate": simulate, "long": long, "hours": long, "weak": weak, "bound": bound, "compare": compare,
     "processor": processor, "draw": draw, "tables": print_tables}[a.what](a)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the paper's experiments: its methods and Grove's search on its data set; writes a report.

    paper.py OUT [--movingai DIR] [--scenarios 1-50] [--agents 5,10,20] [--tasks 10,20,..] [--time-limit S] [--jobs J]
             [--certify]

Comparison: MG-MAPF on three maps, CTS-CBS-A, -B and -C and four baselines at the paper's omega. Study of
omega: CTS-MAPF on rooms with the fewest agents, the paper's CTS-CBS at omega 0, 0.01, 0.1 and infinity.
Both include Grove's own search at omega 0.

The same command resumes an earlier run, also with more scenarios, agents or tasks, but only with the same maps and
time limit. OUT/report/report.html is the report of all results in OUT.
"""
import argparse
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

GROVE = Path(__file__).resolve().parent.parent / "build/release/bin/grove"
COMPARISON = {
    "auto": "--omega 0",
    "cts-cbs-a": "--method cts-cbs-a --policy fixed --omega 0.01",
    "cts-cbs-b": "--method cts-cbs-b --policy fixed --omega 0.01",
    "cts-cbs-c": "--method cts-cbs-c --policy fixed --omega 0.01",
    "optimal-cbs": "--method optimal-cbs --omega 0",
    "hcbs": "--method hcbs --omega 0",
    "mgcbs": "--method mgcbs --omega 0",
    "s-cbs": "--method s-cbs",
}
STUDY = {"auto": "--omega 0"} | {f"cts-cbs_{omega}": f"--policy fixed --omega {omega}"
                                 for omega in ("0", "0.01", "0.1", "inf")}


def run(*words):
    """Runs a command. If it fails, exits with its exit code, or with 128 + N if signal N ended it.

    The command has its own process group, so it receives Ctrl-C only through this program.
    """
    try:
        child = subprocess.Popen([str(word) for word in words], process_group=0)
    except OSError as error:
        sys.exit(f"paper.py: error: {words[0]}: {error.strerror}; expected the program (tools/quickstart builds it)")
    for each in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(each) != signal.SIG_IGN:
            signal.signal(each, lambda number, _: child.send_signal(number))
    code = child.wait()
    if code != 0:
        sys.exit(code if code > 0 else 128 - code)


def settings_of(arguments):
    """Returns the settings that all results in a folder must have in common."""
    return {"movingai": arguments.movingai and str(Path(arguments.movingai).resolve()),
            "time_limit": float(arguments.time_limit)}


def refuse_other_settings(path, settings):
    if path.exists() and (there := json.loads(path.read_text(encoding="utf-8"))) != settings:
        sys.exit(f"paper.py: error: {path}: found {settings}, but the results there have {there}; expected the same "
                 "maps and time limit, or another folder")


def list_of_study(folder, agents):
    """Writes the instance list for the study and returns its path.

    The study uses the rooms map, or the last map if there is none, with the fewest agents.
    """
    entries = [line for line in (folder / "manifest-cts.txt").read_text(encoding="utf-8").splitlines()
               if line and not line.startswith("#")]
    maps = sorted({entry.split("_s")[0] for entry in entries})
    chosen = next((name for name in maps if name.startswith("room")), maps[-1])
    fewest = min(int(number) for number in agents.split(","))
    path = folder / "manifest-study.txt"
    path.write_text("".join(f"{entry}\n" for entry in entries
                            if entry.startswith(f"{chosen}_s") and f"_n{fewest}_" in entry), encoding="utf-8")
    return path


def bench(instances, methods, folder, arguments):
    words = ["bench", instances, "--output-dir", folder, "--time-limit", arguments.time_limit]
    if arguments.jobs:
        words += ["--jobs", arguments.jobs]
    if arguments.certify:
        words.append("--certify")
    for name, options in methods.items():
        words += ["--run", f"{name}: {options}"]
    run(arguments.grove, *words)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", metavar="OUT", type=Path, help="folder for the results; created if missing")
    parser.add_argument("--movingai", metavar="DIR", default=os.environ.get("GROVE_MOVINGAI"),
                        help="maps and scenarios of Moving AI (default: the environment variable GROVE_MOVINGAI; "
                        "without it, generated maps)")
    parser.add_argument("--scenarios", metavar="K-K", default="1-50")
    parser.add_argument("--agents", metavar="N,N", default="5,10,20")
    parser.add_argument("--tasks", metavar="M,M", default="10,20,30,40,50")
    parser.add_argument("--time-limit", metavar="S", default="180",
                        help="time limit of each run, seconds (default: 180)")
    parser.add_argument("--grove", metavar="PROGRAM", default=GROVE, help="program grove")
    parser.add_argument("--certify", action="store_true",
                        help="certify and verify the lower bound of each run (column certified)")
    parser.add_argument("--jobs", metavar="J", help="runs at a time (default: one per core)")
    arguments = parser.parse_args()

    settings = arguments.out / "settings.json"
    refuse_other_settings(settings, settings_of(arguments))
    sets = arguments.out / "set"
    run(arguments.grove, "generate", "paper", "--output-dir", sets, "--scenarios", arguments.scenarios,
        "--agents", arguments.agents, "--tasks", arguments.tasks,
        *(["--movingai", arguments.movingai] if arguments.movingai else []))
    settings.write_text(json.dumps(settings_of(arguments)) + "\n", encoding="utf-8")
    bench(sets / "manifest-mg.txt", COMPARISON, arguments.out / "comparison", arguments)
    bench(list_of_study(sets, arguments.agents), STUDY, arguments.out / "study", arguments)
    run(arguments.grove, "report", arguments.out / "comparison", arguments.out / "study",
        "-o", arguments.out / "report")


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: MIT
"""Implements the command line of grove toio."""
import asyncio
import contextlib
import os
import signal
from typing import NamedTuple

from grove_driving.arguments import (Parser, amount, integer, integers, number, positive, robot_at_for, seed, share,
                                     wrong)
from grove_driving.bad_input import BadInput, at
from grove_driving.drive_log import ExecutionLog, open_log
from grove_driving.program import FAILURE, exit_code, print_error

from . import demo, rings
from .cells import read_cell_order, size
from .clock import VirtualLoop
from .driver import Driver
from .mat import MATS, MM, make_grid
from .protocol import MIN_SPEED, MAX_SPEED
from .simulate import simulate
from .simulated import Disturbances

DEFAULT_CELLS = (7, 5)
SIMULATION = ("loss", "slip", "noise", "lift", "fast", "seed")
DEFAULTS = {"loss": 0.05, "slip": 0.05, "noise": 1.0, "lift": [], "fast": False, "seed": 0}

DESCRIPTION = """\
Drives toio cubes along a passing order that 'grove execute INSTANCE PLAN --order ORDER.json' has written
for an instance on a grid. The cubes are simulated unless --bluetooth is given."""

EPILOG = """\
Each cube does its actions one after the other, each when the order allows it. An action is done when the
cube is detected at rest on its cell. So cubes never touch, even if messages or cubes are late or lost. A
cube that was lifted continues when it is put back near its cell; until then others wait for it.

With simulated cubes the summary has the least distance between two centres. If it is below the diagonal of
a cube, 45.3 mm, the cubes count as touching, whatever their orientation. If --time-limit is reached, the
error message names the cubes that wait, and for which cubes.

Exit codes:
  0    all actions are done
  1    not done within --time-limit, cubes touched (in simulation), or internal failure
  2    bad usage or input: one line on stderr with place, what was found and what was expected
  130  stopped by Ctrl-C (143 by SIGTERM); the cubes were stopped

Examples:
  grove toio --demo --fast
  grove execute my.cts.json my.plan.json --order order.json
  grove toio order.json --mat collection --loss 0.2 --lift red@5=3 --log drive.jsonl
  grove toio order.json --bluetooth --cube red=toio-M0p"""


class Lifted(NamedTuple):
    robot: str
    at: float
    seconds: float


def _noise(text):
    return number(text, 0, 2, "a number from 0 to 2")


def _speed(text):
    return integer(text, MIN_SPEED, MAX_SPEED, f"an integer from {MIN_SPEED} to {MAX_SPEED}")


def _cells(text):
    expected = "WIDTHxHEIGHT, for example 7x5"
    parts = text.split("x")
    if len(parts) != 2:
        raise wrong(text, expected)
    return tuple(integers(text, parts, 1, 1000, expected))


def _mat(text):
    if text in MATS:
        return MATS[text]
    expected = f"one of {', '.join(MATS)}, or X0,Y0,X1,Y1"
    numbers = text.split(",")
    if len(numbers) != 4:
        raise wrong(text, expected)
    x0, y0, x1, y1 = integers(text, numbers, 0, 65534, expected)
    if x0 >= x1 or y0 >= y1:
        raise wrong(text, expected)
    return x0, y0, x1, y1


def _lift(text):
    return Lifted(*robot_at_for(text))


def _cube(text):
    robot, equals, name = text.partition("=")
    if not robot or not equals or not name:
        raise wrong(text, "ROBOT=NAME or ROBOT=ADDRESS")
    return robot, name


def _parser():
    parser = Parser(prog="grove toio", description=DESCRIPTION, epilog=EPILOG)
    add = parser.add_argument
    add("order", nargs="?", metavar="ORDER.json", help="passing order")
    add("--demo", action="store_true", help="solve and drive the demonstration: 3 cubes, 6 tasks, 7 x 5 cells")
    add("--mat", type=_mat, default=MATS["simple"], metavar="MAT",
        help=f"{', '.join(MATS)}, or the corners X0,Y0,X1,Y1: top left, bottom right (default: simple)")
    add("--cells", type=_cells, metavar="WxH", help="cells on the mat (default: 7x5, or more if the order needs more)")
    add("--pitch", type=positive, metavar="UNITS",
        help="distance of neighbouring cells (default: as large as the mat allows)")
    add("--speed", type=_speed, default=40, metavar="N", help="speed of the motors, 10 to 255 (default: 40)")
    add("--step-seconds", type=positive, default=1.0, metavar="S", help="duration of one step of work (default: 1)")
    add("--time-limit", type=positive, default=600.0, metavar="S", help="stop after S seconds (default: 600)")
    add("--log", metavar="DRIVE.jsonl", help="write the execution log to this file")
    add("--quiet", action="store_true", help="print only errors")
    kinds = parser.add_mutually_exclusive_group()
    kinds.add_argument("--simulate", action="store_true", help="drive simulated cubes (default)")
    kinds.add_argument("--bluetooth", action="store_true", help="drive real cubes")
    add("--cube", type=_cube, action="append", default=[], metavar="ROBOT=CUBE",
        help="name or address of the cube of a robot (default: the cube on its start)")
    _add_simulation(parser.add_argument_group("simulated cubes").add_argument)
    return parser


def _add_simulation(add):
    """Adds the options for simulation, without defaults, so that _parse() can detect which options were given."""
    add("--fast", action="store_const", const=True, help="run in virtual time: fast and repeatable")
    add("--loss", type=share, metavar="SHARE", help="share of lost messages, in each direction (default: 0.05)")
    add("--slip", type=amount, metavar="RATE", help="slips per second of driving (default: 0.05)")
    add("--noise", type=_noise, metavar="UNITS", help="maximum error of notified positions (default: 1)")
    add("--lift", type=_lift, action="append", metavar="ROBOT@S=S",
        help="lift a cube at a time in seconds, for a duration in seconds or 'never' to put it back (repeatable)")
    add("--seed", type=seed, metavar="N", help="seed of all random events (default: 0)")


def _parse(arguments):
    a = _parser().parse_args(arguments)
    given = [name for name in SIMULATION if getattr(a, name) is not None]
    if a.bluetooth and given:
        raise BadInput(f"--{given[0]}: requires simulated cubes; found --bluetooth")
    if a.cube and not a.bluetooth:
        raise BadInput("--cube: requires --bluetooth")
    if a.demo == bool(a.order):
        raise BadInput(f"ORDER.json: found {'both ORDER.json and' if a.demo else 'neither ORDER.json nor'} --demo; "
                       "expected one of them (see 'grove toio --help')")
    for name in SIMULATION:
        setattr(a, name, DEFAULTS[name] if getattr(a, name) is None else getattr(a, name))
    return a


def _check_robots(a, order):
    names = [r.name for r in order.robots]
    for option, robots in (("--lift", [lift.robot for lift in a.lift]), ("--cube", [robot for robot, _ in a.cube])):
        for robot in robots:
            if robot not in names:
                raise BadInput(f"{option}: found robot '{robot}'; expected one of {', '.join(names)}")
    if len({robot for robot, _ in a.cube}) < len(a.cube) or len({cube for _, cube in a.cube}) < len(a.cube):
        raise BadInput("--cube: found a robot or a cube twice; expected each once")


def _make_grid(a, order, file):
    used = size(order)
    width, height = a.cells or tuple(map(max, DEFAULT_CELLS, used))
    if used[0] > width or used[1] > height:
        raise BadInput(f"--cells: found {width}x{height}; expected at least {used[0]}x{used[1]} for this order")
    grid = make_grid(a.mat, width, height, a.pitch)
    for members in order.rings.values():
        cells = [order.robots[i].place_before(k) for i, k in members]
        least = rings.least_pitch(cells)
        if grid.pitch < least:
            i, k = members[0]
            raise at(file, f"/robots/{i}/actions/{k}/ring",
                     f"a ring of {len(members)} robots on cells of {grid.pitch:.1f} units",
                     f"at least {least:.1f}, so that cubes do not touch (a larger --mat, or fewer --cells)")
    return grid


async def _drive_real(a, order, grid, options):
    from .bluetooth import connect_cubes
    cubes = await connect_cubes(order, grid, dict(a.cube))
    try:
        return await Driver(order, cubes, grid, **options).drive(a.time_limit), None
    finally:
        for cube in cubes.values():
            await cube.disconnect()


async def _drive(a, order, grid, options):
    """Drives the cubes along the order and returns (outcome, world). The world is None with real cubes."""
    task = asyncio.current_task()
    asyncio.get_running_loop().add_signal_handler(signal.SIGTERM, task.cancel)
    if a.bluetooth:
        return await _drive_real(a, order, grid, options)
    return await simulate(order, grid, Disturbances(a.loss, a.slip, a.noise), a.seed, a.lift, a.time_limit, **options)


def _describe(a, order, grid, name):
    yield f"Order         {name}: {len(order.robots)} robots, {sum(len(r.actions) for r in order.robots)} actions"
    yield (f"Mat           {grid.width} x {grid.height} cells of {grid.pitch:.1f} units ({grid.pitch * MM:.0f} mm), "
           f"tolerance {grid.tolerance:.1f} units")
    yield "Cubes         " + ("real ones" if a.bluetooth else
                              f"simulated: {100 * a.loss:g} % of messages lost, {a.slip:g} slips a second, "
                              f"positions off by {a.noise:g} units, seed {a.seed}")
    if a.bluetooth:
        yield "Starts        " + ", ".join(f"{r.name} {list(r.start)} at ({x:.0f}, {y:.0f})"
                                           for r in order.robots for x, y in [grid.centre(r.start)])


def _visited(a, order, outcome):
    if not a.demo:
        return "all visited" if outcome.completed else "not all visited"
    left = demo.tasks_left(order, outcome.done)
    return "all visited" if not left else f"not visited: {', '.join(left)}"


def _summary(a, order, outcome, world):
    yield f"Time          {outcome.seconds:.1f} s"
    yield f"Actions       {outcome.actions} of {outcome.all_actions} done"
    yield f"Tasks         {_visited(a, order, outcome)}"
    yield f"Writes        {outcome.writes}, {outcome.repeats} of them repeats, {outcome.corrections} short rolls"
    if world and world.least_pair:
        yield (f"Distance      at least {world.least_mm:.1f} mm between centres, of {' and '.join(world.least_pair)} "
               f"after {world.least_at:.1f} s")


def _failure(a, outcome, world):
    if world and world.touched:
        return (f"{' and '.join(world.least_pair)} touched after {world.least_at:.1f} s: {world.least_mm:.1f} mm "
                "between their centres")
    if not outcome.completed:
        return f"not done within {a.time_limit:g} s: {'; '.join(outcome.waits)}"
    return None


def _printer(a):
    return (lambda text: None) if a.quiet else (lambda text: print(text, flush=True))


def _run(arguments):
    a = _parse(arguments)
    name = "the demonstration" if a.demo else os.path.basename(a.order)
    order = demo.demo_order() if a.demo else read_cell_order(a.order)
    _check_robots(a, order)
    grid = _make_grid(a, order, name if a.demo else a.order)
    say = _printer(a)
    for line in _describe(a, order, grid, name):
        say(line)
    with contextlib.ExitStack() as stack:
        options = {"speed": a.speed, "step_seconds": a.step_seconds, "say": say}
        if a.log:
            stream = stack.enter_context(open_log(a.log))
            options["log"] = ExecutionLog(stream, "demo.order.json" if a.demo else name, [r.name for r in order.robots],
                                      a.step_seconds)
        runner = stack.enter_context(asyncio.Runner(loop_factory=VirtualLoop if a.fast else None))
        outcome, world = runner.run(_drive(a, order, grid, options))
    for line in _summary(a, order, outcome, world):
        say(line)
    failure = _failure(a, outcome, world)
    if failure:
        print_error(failure)
    return FAILURE if failure else 0


def main(arguments):
    return exit_code(_run, arguments)

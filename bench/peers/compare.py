"""Boresight beside other programs on the peers' antenna family, in one session on one thread:
every program in turn, round by round, CPU time, median of the rounds. Prints a table of items,
numbers of modes and programs, with the ratio to Boresight's time and the difference in value.
Called by `./dev peers`; the routes of a program and their values are its own lines."""

import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

# What is compared; the number of values that must agree, to what relative difference, and the
# name of the item to a program given by --limit.
ITEMS = {
    "response": ("1000-point frequency response t -> y", 3, 1e-8, "fr"),
    "rms": ("rms of y in unit white noise", 1, 1e-9, "h2"),
    "sensitivity_peak": ("Ms", 1, 1e-6, "hinf_S"),
    "wind_peak": ("peak of t -> y", 1, 1e-6, "hinf_W"),
    "margins": ("all margins of the loop", 6, 1e-8, "mar"),
    "simulation": ("600 000 steps of 1 ms", 3, 1e-8, "lsim"),
    "sampling": ("zero-order hold at 1 ms", 2, 1e-9, "c2d"),
    "nl_none": ("60 s of the rate loop with its valve", 5, 2e-3, "nl_none"),
    "nl_tanh": ("the same with smoothed Coulomb friction", 5, 2e-3, "nl_tanh"),
    "nl_lugre": ("the same with LuGre friction", 5, 2e-3, "nl_lugre"),
    "lyapunov": ("Lyapunov equation, trace", 1, 1e-8, None),
    "riccati": ("Riccati equation, trace", 1, 1e-6, None),
    "discrete_riccati": ("discrete Riccati equation, trace", 1, 1e-6, None),
    "tune": ("four gains for the least rms with Ms at most 2", 2, 1e-6, "tune"),
}
SMALLEST_ONLY = {"lyapunov", "riccati", "discrete_riccati"}
SIMULATED = {5, 50}
DRIVEN = {5, 20}
TUNED = {5, 500}
HERE = pathlib.Path(__file__).resolve().parent


def run(command, seconds, **environment):
    """The JSON lines a program prints, or one that says why it printed none."""
    one_thread = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "LC_ALL": "C.UTF-8"}
    try:
        done = subprocess.run(
            command, env=os.environ | one_thread | environment, capture_output=True, text=True, timeout=seconds
        )
    except subprocess.TimeoutExpired:
        return [{"error": f"not done in {seconds} s"}]
    lines = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    if lines:
        return lines
    return [{"error": (done.stderr.strip() or "printed nothing").splitlines()[-1]}] if done.returncode else []


class Boresight:
    name = "Boresight"

    def __init__(self, program):
        self.program = program

    def measure(self, item, modes, seconds):
        command = [self.program, f"--benchmark_filter=^peer_{item}_[a-z_]+/{modes}$", "--benchmark_format=json"]
        command += ["--benchmark_min_time=0.1", "--benchmark_repetitions=3"]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=seconds)
        except subprocess.TimeoutExpired:
            return [{"error": f"not done in {seconds} s"}]
        if not done.stdout.startswith("{"):
            return []
        lines = {}
        for entry in json.loads(done.stdout)["benchmarks"]:
            route = entry["run_name"].split("/")[0].removeprefix(f"peer_{item}_").replace("_", " ")
            line = lines.setdefault(route, {"peer": f"Boresight, {route}"})
            if entry.get("error_occurred"):
                line["error"] = entry["error_message"]
            elif entry.get("aggregate_name") == "median":
                unit = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}[entry["time_unit"]]
                line["med"] = entry["cpu_time"] * unit
                line["val"] = [entry[key] for key in (f"value{i}" for i in range(9)) if key in entry]
                notes = {key.removeprefix("note_"): entry[key] for key in entry if key.startswith("note_")}
                line["notes"] = ", ".join(f"{key.replace('_', ' ')} {value:.4g}" for key, value in notes.items())
        return list(lines.values())


class Program:
    def __init__(self, name, command):
        self.name = name
        self.command = command

    def measure(self, item, modes, seconds):
        return run([*self.command, str(modes), item], seconds)


class Limit:
    """A program that is called with the peers' name of an item and the number of modes, and adds
    its lines to the file that the variable RES names."""

    def __init__(self, program):
        self.name = pathlib.Path(program).name
        self.program = program

    def measure(self, item, modes, seconds):
        if ITEMS[item][3] is None:
            return []
        with tempfile.NamedTemporaryFile("w+") as results:
            lines = run([self.program, ITEMS[item][3], str(modes)], seconds, RES=results.name)
            lines = [json.loads(line) for line in results.read().splitlines()] or lines
        return [
            line | {"peer": f"{self.name}: {line['peer']}"}
            for line in lines
            if line.get("item", ITEMS[item][3]) == ITEMS[item][3] and "peer" in line
        ]


def human(seconds):
    for unit, scale in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)):
        if seconds >= scale or unit == "us":
            return f"{seconds / scale:.3g} {unit}"


def difference(found, expected, count):
    """Worst relative difference among the first `count` values; those that are missing do not count."""
    pairs = [(f, e) for f, e in zip(found[:count], expected[:count]) if not math.isnan(f)]
    return max((abs(f - e) / max(abs(e), 1e-300) for f, e in pairs), default=math.nan)


def median(numbers):
    return sorted(numbers)[len(numbers) // 2]


def compare(item, modes, programs, rounds, seconds):
    """Rows of one item and number of modes: peer -> times, values or error."""
    rows = {}
    for _ in range(rounds):
        for program in programs:
            if rows.get(program.name, {}).get("error"):
                continue
            for line in program.measure(item, modes, seconds):
                row = rows.setdefault(line.get("peer", program.name), {"times": []})
                if "error" in line:
                    row["error"] = line["error"]
                else:
                    row["times"].append(line["med"])
                    row["val"] = line["val"]
                    row["notes"] = line.get("notes", "")
    return rows


def table(item, rows_of):
    """Prints the table of one item; rows_of: modes -> rows. False if a value of ours is off."""
    text, count, tolerance, _ = ITEMS[item]
    print(f"\n### {item}: {text}\n")
    print(f"| program | {' | '.join(f'{modes} modes' for modes in rows_of)} | worst difference in value |")
    print("|---" * (len(rows_of) + 2) + "|")
    notes, agree = [], True
    peers = {peer for rows in rows_of.values() for peer in rows}
    for peer in sorted(peers, key=lambda name: (not name.startswith("Boresight"), name)):
        cells, worst = [], 0.0
        for modes, rows in rows_of.items():
            own = [row for name, row in rows.items() if name.startswith("Boresight") and row["times"]]
            fastest = min(own, key=lambda row: median(row["times"]), default=None)
            row = rows.get(peer)
            if row is None:
                cells.append("-")
            elif not row["times"]:
                cells.append("fails")
                notes.append(f"{peer}, {modes} modes: {row.get('error', 'no value').strip()}")
                agree = agree and not peer.startswith("Boresight")
            else:
                time = median(row["times"])
                cells.append(human(time) + (f" ({time / median(fastest['times']):.3g}x)" if fastest else ""))
                off = difference(row["val"], fastest["val"], count) if fastest else 0.0
                if off > tolerance:
                    cells[-1] += " differs"
                    agree = agree and not peer.startswith("Boresight")
                worst = max(worst, off)
                if row["notes"]:
                    notes.append(f"{peer}, {modes} modes: {row['notes']}")
        print(f"| {peer} | {' | '.join(cells)} | {worst:.0e} |")
    if notes:
        print("\n" + "\n".join(f"- {note}" for note in notes))
    return agree


def main():
    parser = argparse.ArgumentParser(prog="./dev peers", description=__doc__)
    parser.add_argument("items", nargs="*", metavar="ITEM", help=", ".join(ITEMS) + " (default: all)")
    parser.add_argument("--modes", default="5,20,50", help="numbers of modes, with commas (default: 5,20,50)")
    parser.add_argument("--rounds", type=int, default=3, help="turns of each program (default: 3)")
    parser.add_argument("--seconds", type=float, default=300.0, help="longest run of one program (default: 300)")
    parser.add_argument("--limit", action="append", default=[], metavar="PROGRAM",
                        help="also run PROGRAM ITEM MODES, which adds JSON lines to the file $RES")
    for name in ("boresight", "systems", "slicot", "slicot-tune"):
        parser.add_argument(f"--{name}", required=True, help=argparse.SUPPRESS)
    options = parser.parse_args()
    items = options.items or list(ITEMS)
    unknown = [item for item in items if item not in ITEMS]
    if unknown:
        parser.error(f"no item '{unknown[0]}'; there are {', '.join(ITEMS)}")
    sizes = [int(number) for number in options.modes.split(",")]

    print(f"CPU time of one thread, median of {options.rounds} rounds; in brackets as a multiple of")
    print("Boresight's fastest route. `differs`: from that route's values by more than the item allows.")
    agree = True
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([options.systems, folder, *map(str, sizes)], check=True)
        programs = [Boresight(options.boresight), Program("SLICOT", [options.slicot, folder])]
        programs.append(Program("NLopt on SLICOT", [options.slicot_tune, folder]))
        programs.append(Program("SciPy", [sys.executable, "-B", str(HERE / "scipy_peer.py"), folder]))
        programs.append(Program("SciPy drive", [sys.executable, "-B", str(HERE / "scipy_drive.py"), folder]))
        octave = ["octave-cli", "--quiet", "--no-history", str(HERE / "octave_peer.m"), folder]
        programs.append(Program("Octave", octave))
        programs += [Limit(program) for program in options.limit]
        for item in items:
            rows_of = {
                modes: compare(item, modes, programs, options.rounds, options.seconds)
                for modes in sizes
                if not (item in SMALLEST_ONLY and modes != 5)
                and not (item == "simulation" and modes not in SIMULATED)
                and not (item.startswith("nl_") and modes not in DRIVEN)
                and not (item == "tune" and modes not in TUNED)
            }
            agree = table(item, rows_of) and agree
            sys.stdout.flush()
    sys.exit(0 if agree else 1)


main()

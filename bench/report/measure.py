"""Runs vndf_bench one input and count after the other, shows what it found, and joins its files into one.

All benchmarks of one input and count are interleaved in random order: their ratios are of the same minutes of
the same machine. Google Benchmark prints nothing until all of those are done, hence the pieces.
"""

import argparse
import contextlib
import json
import os
import re
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pandas as pd

from tables import BUSY_INPUT, read_speeds, split_names

# Batch sizes between the large and the small serve two plots: no peers but the listing and ISPC's.
MAIN_COUNTS = (4096, 4194304)
CURVE = r"(?:sample_.*|evaluate_.*|pdf_normals|copy|paper_listing|ispc_.*)$"
# Its time tells the two states of a shared core apart: bench/README.md.
REFERENCE = r"sample_normals/polar/\w+/camera/4096"
BUSY = 1.1
# What is measured a second time, beside busy threads.
OPERATIONS = (
    r"(?:sample_(?:normals|disk|reflection|dielectric)|evaluate_(?:reflection|dielectric)|pdf_normals)"
)
BESIDE_BUSY = rf"(?:{OPERATIONS}|ispc_\w+)/\w+/\w+/camera/4096"
# Ellipsoids are compared with plain GGX once.
ELLIPSOIDS = "input == 'camera' and count == 4096"


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bench", type=Path, required=True, help="the program vndf_bench")
    parser.add_argument("--out", type=Path, required=True, help="where its results go, in its JSON")
    parser.add_argument("--seconds", type=float, default=75, help="that all of it should take (default 75)")
    parser.add_argument("--repetitions", type=int, default=9, help="of which the median counts (default 9)")
    parser.add_argument("--inputs", default=".*", help="regular expression of the inputs (default: all)")
    return parser.parse_args()


def in_pieces(bench: Path, inputs: str) -> list[list[str]]:
    """Names of one input and count, without what no plot or table shows."""
    listed = subprocess.run([bench, "--benchmark_list_tests"], capture_output=True, text=True, check=True)
    names = pd.Series(listed.stdout.split())
    table = split_names(names).assign(name=names)
    plain = table["shape"] == "plain"
    curve = table.operation.str.match(CURVE) | table["count"].isin(MAIN_COUNTS)
    shown = table[(plain & curve | table.eval(ELLIPSOIDS)) & table.input.str.fullmatch(inputs)]
    return [list(piece.name) for _, piece in shown.groupby(["input", "count"])]


@contextlib.contextmanager
def all_threads_busy(command: list[str | Path]) -> Iterator[None]:
    """As in a renderer that uses all of them: this process keeps one hardware thread, each of the others runs the
    command until the end."""
    ours, *others = sorted(os.sched_getaffinity(0))
    processes = []
    try:
        for other in others:
            os.sched_setaffinity(0, {other})  # a child begins where its parent is
            processes.append(subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        os.sched_setaffinity(0, {ours})
        yield
    finally:
        os.sched_setaffinity(0, {ours, *others})
        for process in processes:
            process.kill()
            process.wait()


def cost(name: str) -> float:
    """Of a repetition, in units of its least time: a batch too large for it takes longer."""
    return 3.0 if int(name.split("/")[4]) > 1 << 20 else 1.0


def run(bench: Path, names: list[str], min_time: float, repetitions: int, out: Path) -> None:
    """Runs these benchmarks and no others."""
    names_filter = "^(" + "|".join(re.escape(name) for name in names) + ")$"
    command = [
        bench,
        f"--benchmark_filter={names_filter}",
        f"--benchmark_min_time={min_time:.4f}",
        f"--benchmark_repetitions={repetitions}",
        "--benchmark_enable_random_interleaving=true",
        "--benchmark_report_aggregates_only=true",
        f"--benchmark_out={out}",
        "--benchmark_out_format=json",
    ]
    finished = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if finished.returncode != 0:
        sys.exit(f"{bench.name} failed:\n{finished.stderr}")


def busy_name(name: str) -> str:
    """Of a benchmark that was measured so."""
    alone, busy = BUSY_INPUT
    return name.replace(f"/{alone}/", f"/{busy}/")


def reference_name(bench: Path) -> str:
    """Of a call that only needs the core, on the best instruction set that there is."""
    listed = subprocess.run([bench, "--benchmark_list_tests"], capture_output=True, text=True, check=True)
    return [name for name in listed.stdout.split() if re.fullmatch(REFERENCE, name)][-1]


def reference(bench: Path, out: Path) -> float:
    """Nanoseconds of that call."""
    run(bench, [reference_name(bench)], 0.02, 5, out)
    runs = json.loads(out.read_text())["benchmarks"]
    return next(run["cpu_time"] for run in runs if run["aggregate_name"] == "median")


def main() -> None:
    arguments = parse_arguments()
    pieces = in_pieces(arguments.bench, arguments.inputs)
    if not pieces:
        sys.exit(f"{arguments.bench.name} has no benchmark of these inputs")
    # Beside the repetitions, finding the number of iterations takes about as long as two of them.
    units = sum(cost(name) for piece in pieces for name in piece) * (arguments.repetitions + 2)
    min_time = min(0.05, max(0.002, arguments.seconds / units))
    part = arguments.out.with_suffix(".part.json")
    context: dict[str, Any] = {}
    runs: list[dict[str, Any]] = []
    start = time.monotonic()
    before = reference(arguments.bench, part)
    for index, names in enumerate(pieces, 1):
        source, count = names[0].split("/")[3:5]
        elapsed = f"{time.monotonic() - start:.0f} s so far"
        print(f"\nbench {index}/{len(pieces)}: {source}, {count} samples a call, {elapsed}", flush=True)
        run(arguments.bench, names, min_time, arguments.repetitions, part)
        found = json.loads(part.read_text())
        after = reference(arguments.bench, part)
        for result in found["benchmarks"]:
            result["pace"] = max(before, after)
        before = after
        context = context or found["context"]
        # In the order of the names, not in the random one in which they were measured.
        runs += sorted(found["benchmarks"], key=lambda run: names.index(run["run_name"]))
        speeds = read_speeds(runs[-len(found["benchmarks"]) :])
        rates = speeds.pivot_table("msamples", ["operation", "warp", "threads"], "isa", sort=False)
        print(rates.to_string(na_rep="-", float_format="{:.1f}".format), flush=True)
    fastest = min(run["pace"] for run in runs)
    for result in runs:
        result["pace"] /= fastest
    slowest = max(run["pace"] for run in runs)
    beside = [name for piece in pieces for name in piece if re.fullmatch(BESIDE_BUSY, name)]
    if beside and hasattr(os, "sched_getaffinity") and len(os.sched_getaffinity(0)) > 1:  # on Linux
        print("\nbench: the same, 4096 samples a call, with all other hardware threads busy", flush=True)
        load = [
            arguments.bench,
            f"--benchmark_filter={reference_name(arguments.bench)}",
            "--benchmark_min_time=1e5",
        ]
        with all_threads_busy(load):
            run(arguments.bench, beside, min_time, arguments.repetitions, part)
            found = json.loads(part.read_text())["benchmarks"]
            pace = reference(arguments.bench, part) / fastest
        print(f"bench: there the reference kernel takes {pace:.2f} times its shortest time")
        for result in sorted(found, key=lambda run: beside.index(run["run_name"])):
            runs.append(result | {"run_name": busy_name(result["run_name"]), "pace": pace})
    part.unlink()
    print(f"\nbench: the reference kernel took 1 to {slowest:.2f} times its shortest time")
    if slowest > BUSY:
        print("bench: warning: something else ran on this core; the report marks what was measured then")
    arguments.out.write_text(json.dumps({"context": context, "benchmarks": runs}, indent=1))
    print(f"\nbench: {time.monotonic() - start:.0f} s; the numbers are million samples per second")


if __name__ == "__main__":
    main()

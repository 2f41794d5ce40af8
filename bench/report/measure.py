"""Runs vndf_bench one input and count after the other, shows what it found, and joins its files into one.

Within one input and count all benchmarks are interleaved in random order, so that the ratios between them are of the same
minutes of the same machine. Google Benchmark prints nothing until all of those are done, hence the pieces.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from results import ROOFLINE, Speed, plain_of, read_speeds, unique

# Batch sizes between the large and the small serve one plot: one input does, and no peers but the listing.
MAIN_COUNTS = ("4096", "4194304")
CURVE = r"^(sample_[^/]*|copy|paper_listing)/"
# Ellipsoids are compared with plain GGX once.
ELLIPSOID_PIECE = ("camera", "4096")


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bench", type=Path, required=True, help="the program vndf_bench")
    parser.add_argument("--out", type=Path, required=True, help="where its results go, in Google Benchmark's JSON")
    parser.add_argument("--seconds", type=float, default=75, help="the time all of it should take (default 75)")
    parser.add_argument("--repetitions", type=int, default=9, help="of which the median counts (default 9)")
    parser.add_argument("--inputs", default="camera|uniform|camera_unaligned", help="regular expression of the inputs")
    return parser.parse_args()


def list_names(bench: Path) -> list[str]:
    listed = subprocess.run([bench, "--benchmark_list_tests"], capture_output=True, text=True, check=True)
    return [name for name in listed.stdout.split("\n") if name.count("/") >= 4]


def in_pieces(names: list[str], inputs: str) -> list[list[str]]:
    """Groups of one input and count, without what no plot or table shows."""
    pieces: dict[tuple[str, str], list[str]] = {}
    for name in names:
        operation, _, _, source, count = name.split("/")[:5]
        if plain_of(operation):
            shown = (source, count) == ELLIPSOID_PIECE
        else:
            shown = count in MAIN_COUNTS or bool(re.match(CURVE, name))
        if shown and re.fullmatch(inputs, source):
            pieces.setdefault((source, count), []).append(name)
    return [pieces[key] for key in sorted(pieces, key=lambda key: (key[0], int(key[1])))]


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


def in_order(file: Path, names: list[str]) -> list[dict[str, Any]]:
    """The results in the order of the names, not in the random one in which they were found."""
    return sorted(json.loads(file.read_text())["benchmarks"], key=lambda run: names.index(run["run_name"]))


def show(speeds: list[Speed]) -> None:
    """One line per operation and warp, the instruction sets side by side, in million samples per second."""
    # The roofline is there for every instruction set, slowest first.
    isas = unique(speed.isa for speed in sorted(speeds, key=lambda speed: speed.operation != ROOFLINE))
    print(f"  {'M samples/s':<42}" + "".join(f"{isa:>10}" for isa in isas))
    for operation, warp, source in unique((s.operation, s.warp, s.input) for s in speeds):
        rates = {s.isa: s.msamples for s in speeds if (s.operation, s.warp, s.input) == (operation, warp, source)}
        suffix = f" ({source.split('/', 1)[1]})" if "/" in source else ""
        cells = "".join(f"{rates[isa]:10.1f}" if isa in rates else f"{'-':>10}" for isa in isas)
        print(f"  {operation + ' ' + warp + suffix:<42}{cells}")
    if any(speed.operation == ROOFLINE for speed in speeds):
        print("  copy reads and writes the same columns and computes nothing.")


def main() -> None:
    arguments = parse_arguments()
    pieces = in_pieces(list_names(arguments.bench), arguments.inputs)
    if not pieces:
        sys.exit(f"{arguments.bench.name} has no benchmark of these inputs")
    # Beside the repetitions, finding the number of iterations takes about as long as two of them.
    units = sum(cost(name) for piece in pieces for name in piece) * (arguments.repetitions + 2)
    min_time = min(0.05, max(0.002, arguments.seconds / units))
    part = arguments.out.with_suffix(".part.json")
    joined: dict[str, object] = {}
    runs: list[dict[str, Any]] = []
    start = time.monotonic()
    for index, names in enumerate(pieces):
        source, count = names[0].split("/")[3:5]
        print(f"\nbench {index + 1}/{len(pieces)}: {source}, {count} samples a call, {len(names)} benchmarks, "
              f"median of {arguments.repetitions} ({time.monotonic() - start:.0f} s so far)", flush=True)
        run(arguments.bench, names, min_time, arguments.repetitions, part)
        show(read_speeds(in_order(part, names)))
        joined = joined or {"context": json.loads(part.read_text())["context"]}
        runs += in_order(part, names)
    part.unlink()
    joined["benchmarks"] = runs
    arguments.out.write_text(json.dumps(joined, indent=1))
    print(f"\nbench: {time.monotonic() - start:.0f} s")


if __name__ == "__main__":
    main()

"""Reads what the measuring programs wrote and joins speed with error, for any operation, warp and instruction set."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterable, Optional

EPS = 2.0**-24
ROOFLINE = "copy"
LISTING = ("paper_listing", "polar", "scalar")
# Suffixes of the operations that take an ellipsoid, with what is given of it.
ELLIPSOIDS = {"one_shape": "five constants", "turned": "θz per lane", "tilted": "five columns"}
# A result that is not finite has no distance; the largest that two unit vectors can have stands for it in plots.
WORST_EPS = 2 / EPS


@dataclass(frozen=True)
class Speed:
    """The median of one benchmark."""

    operation: str
    warp: str
    isa: str
    input: str
    count: int
    ns: float
    bytes: Optional[float]  # read and written per sample, where the benchmark tells
    spread: float  # coefficient of variation over the repetitions

    @property
    def msamples(self) -> float:
        return 1e3 / self.ns


@dataclass(frozen=True)
class ErrorRow:
    """The errors of one implementation on one hard case."""

    implementation: str
    warp: str
    isa: str  # "any": the bits are the same on every set
    row: str
    samples: int
    mean_eps: Optional[float]
    p999_eps: Optional[float]
    max_eps: Optional[float]
    norm_eps: Optional[float]
    slope_error: Optional[float]
    worst_input: str
    undefined: bool = False  # no single right answer exists: any unit normal will do
    ratio: Optional[float] = None  # of the normals, reference/ratio.h: how much of the largest loss is the formula's
    shared_domain: bool = False  # unit views above the horizon, alpha at most 1: what every peer promises to accept


@dataclass(frozen=True)
class ErrorSummary:
    """Over all hard cases: the mean of means, the largest p99.9 and maximum, and the row of that maximum."""

    mean_eps: Optional[float]  # None: a result was not finite, and so has no distance
    p999_eps: Optional[float]
    max_eps: Optional[float]
    worst_row: str
    shared_max_eps: Optional[float]  # over the cases of the shared domain
    shared_worst_row: str
    typical_max_eps: Optional[float]  # of the first case, which is not hard
    ratio: Optional[float]  # the largest of what the error is to what the inputs' rounding moves the exact result by


@dataclass(frozen=True)
class Result:
    speed: Speed
    vs_listing: Optional[float]
    roofline_share: Optional[float]
    error: Optional[ErrorSummary]


@dataclass
class Measurements:
    speeds: list[Speed]
    errors: list[ErrorRow]
    peers: dict[str, str]  # a peer's name -> the operation it does
    row_notes: dict[str, str]  # hard case -> its description
    facts: dict[str, Any]  # what else the error measurement told
    results: list[Result] = field(default_factory=list)

    def is_peer(self, operation: str) -> bool:
        return operation in self.peers or operation == LISTING[0]

    @property
    def peer_operation(self) -> str:
        """The operation of ours that the peers do as well."""
        return self.peers.get(LISTING[0], "sample_normals")

    def is_ours(self, operation: str) -> bool:
        return not self.is_peer(operation) and operation != ROOFLINE

    def errors_of(self, operation: str, warp: str, isa: str) -> list[ErrorRow]:
        return [
            e
            for e in self.errors
            if e.implementation == operation and e.warp == warp and e.isa in ("any", isa) and not e.undefined
        ]


def unique(values: Iterable[Any]) -> list[Any]:
    """The distinct values in the order of their first appearance."""
    return list(dict.fromkeys(values))


def plain_of(operation: str) -> Optional[str]:
    """The same operation with plain GGX, if this one takes an ellipsoid."""
    return next((operation[: -len(kind) - 1] for kind in ELLIPSOIDS if operation.endswith("_" + kind)), None)


def read_speeds(runs: Iterable[dict[str, Any]]) -> list[Speed]:
    """Medians of Google Benchmark's runs; the runs themselves where there are no aggregates."""
    medians: dict[str, dict[str, Any]] = {}
    spreads: dict[str, float] = {}
    plain: dict[str, dict[str, Any]] = {}
    for run in runs:
        name = run.get("run_name", run["name"])
        if run.get("error_occurred"):
            continue
        if run.get("run_type") != "aggregate":
            plain.setdefault(name, run)
        elif run["aggregate_name"] == "median":
            medians[name] = run
        elif run["aggregate_name"] == "cv":
            spreads[name] = run["cpu_time"]
    best = {**plain, **medians}
    return [speed for name, run in best.items() if (speed := parse_run(name, run, spreads.get(name, math.nan)))]


def parse_run(name: str, run: dict[str, Any], spread: float) -> Optional[Speed]:
    """One benchmark named operation/warp/isa/input/count; what follows the count is told with the input."""
    parts = name.split("/")
    if len(parts) < 5 or not parts[4].isdigit():
        return None
    operation, warp, isa, source, count = parts[:5]
    extra = [part for part in parts[5:] if part not in ("real_time", "manual_time", "process_time")]
    if "items_per_second" in run:
        ns = 1e9 / run["items_per_second"]
    else:
        ns = run["cpu_time"] * {"ns": 1, "us": 1e3, "ms": 1e6, "s": 1e9}[run["time_unit"]] / int(count)
    traffic = run["bytes_per_second"] * ns * 1e-9 if "bytes_per_second" in run else None
    return Speed(operation, warp, isa, "/".join([source, *extra]), int(count), ns, traffic, spread)


def finite(value: Any) -> Optional[float]:
    """A JSON number, or None for null and for the words that stand for infinities."""
    return value if isinstance(value, (int, float)) and math.isfinite(value) else None


def error_row(row: dict[str, Any]) -> ErrorRow:
    return ErrorRow(
        implementation=row["implementation"],
        warp=row["warp"],
        isa=row.get("isa", "any"),
        row=row["row"],
        samples=row["samples"],
        mean_eps=finite(row["mean_eps"]),
        p999_eps=finite(row["p999_eps"]),
        max_eps=finite(row["max_eps"]),
        norm_eps=finite(row["norm_eps"]),
        slope_error=finite(row.get("slope_error")),
        worst_input=row["worst_input"],
        undefined=row.get("undefined", False),
        ratio=finite(row.get("ratio")),
        shared_domain=row.get("shared_domain", False),
    )


def read_errors(path: Path) -> dict[str, Any]:
    document = json.loads(path.read_text())
    rows = [error_row(row) for row in document["rows"]]
    return {
        "errors": rows,
        "peers": document.get("peers", {}),
        "row_notes": document.get("row_notes", {}),
        "facts": {key: value for key, value in document.items() if key not in ("rows", "peers", "row_notes")},
    }


def summarise(rows: list[ErrorRow]) -> Optional[ErrorSummary]:
    if not rows:
        return None
    means = [row.mean_eps for row in rows]
    worst = worst_of(rows)
    shared = worst_of([row for row in rows if row.shared_domain] or rows)
    return ErrorSummary(
        mean_eps=None if None in means else sum(means) / len(means),
        p999_eps=largest(row.p999_eps for row in rows),
        max_eps=worst.max_eps,
        worst_row=worst.row,
        shared_max_eps=shared.max_eps,
        shared_worst_row=shared.row,
        typical_max_eps=rows[0].max_eps,
        ratio=max((row.ratio for row in rows if row.ratio is not None), default=None),
    )


def worst_of(rows: list[ErrorRow]) -> ErrorRow:
    return max(rows, key=lambda row: (or_worst(row.max_eps), or_worst(row.mean_eps)))


def largest(values: Iterable[Optional[float]]) -> Optional[float]:
    """None if one of them is."""
    found = list(values)
    return None if None in found else max(found)


def or_worst(eps: Optional[float]) -> float:
    return WORST_EPS if eps is None else eps


def copy_ns(data: Measurements, operation: str, traffic: Optional[float], count: int) -> Optional[float]:
    """The time per sample of the best copy of the columns that the operation reads and writes."""
    # Threads add up; the roofline is that of one.
    copies = [s for s in data.speeds if s.operation == ROOFLINE and s.count == count and "threads" not in s.input]
    if not copies:
        return None
    best = min(copies, key=lambda copy: copy.ns)
    if traffic and best.bytes:
        return best.ns * traffic / best.bytes
    # The copy is that of the operation that the peers do, too. Of others it tells nothing without their traffic.
    same = operation in (data.peer_operation, ROOFLINE) or data.is_peer(operation)
    return best.ns if same else None


def join(data: Measurements) -> None:
    """Fills data.results: each speed with its ratios and its errors."""
    listing = {(s.input, s.count): s.ns for s in data.speeds if (s.operation, s.warp, s.isa) == LISTING}
    for speed in data.speeds:
        roof = copy_ns(data, speed.operation, speed.bytes, speed.count)
        base = listing.get((speed.input.split("/")[0], speed.count))
        data.results.append(
            Result(
                speed=speed,
                vs_listing=base / speed.ns if base else None,
                roofline_share=roof / speed.ns if roof else None,
                error=summarise(data.errors_of(speed.operation, speed.warp, speed.isa)),
            )
        )


def load(benchmark: Path, errors: Path) -> Measurements:
    speeds = read_speeds(json.loads(benchmark.read_text())["benchmarks"])
    data = Measurements(speeds=speeds, **read_errors(errors))
    join(data)
    return data


def report_json(machine: dict[str, Any], results: Iterable[Result]) -> dict[str, Any]:
    def row(result: Result) -> dict[str, Any]:
        speed, error = result.speed, result.error
        return {
            "operation": speed.operation,
            "warp": speed.warp,
            "isa": speed.isa,
            "input": speed.input,
            "count": speed.count,
            "ns_per_sample": speed.ns,
            "msamples_per_s": speed.msamples,
            "vs_listing": result.vs_listing,
            "roofline_share": result.roofline_share,
            "mean_eps": error.mean_eps if error else None,
            "p999_eps": error.p999_eps if error else None,
            "max_eps": error.max_eps if error else None,
            "worst_row": error.worst_row if error else None,
            "ratio": error.ratio if error else None,
        }

    return {"machine": machine, "results": [row(result) for result in results]}

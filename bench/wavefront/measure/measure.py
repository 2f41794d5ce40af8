"""Measures the wavefront renderer: time by stage beside other shading steps, scaling over threads, error at equal
samples and at equal time. Writes measure.json, pictures and table.md, the table of the README.

Other work on the machine disturbs times. So runs that are compared are short and interleaved, times of stages are
those of the threads' own clocks, and the fastest of several runs counts.
"""

import argparse
import json
import re
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pandas as pd

sys.path.insert(0, str(Path(__file__).parents[2] / "report"))
import machine  # noqa: E402
import pictures  # noqa: E402
import wavefront_plots  # noqa: E402

LIBRARY = "vndf_wavefront"
# Other shading steps in the same renderer. The kernel is compiled for AVX2.
STEPS = {"listing": "measure/vndf_wavefront_listing", "lanes": "measure/vndf_wavefront_lanes"}
WAYS = {
    "ndf": ("--sampler", "ndf", "--warp", "polar"),
    "polar": ("--sampler", "vndf", "--warp", "polar"),
    "concentric": ("--sampler", "vndf", "--warp", "concentric"),
    "spherical_cap": ("--sampler", "vndf", "--warp", "spherical_cap"),
    "bounded": ("--sampler", "bounded", "--warp", "spherical_cap"),
}
SAMPLES = (4, 16, 64)
ERROR_SIZE = "160x90"
# Of the frame above: all of it, and the golden knot, where metals alone are seen.
REGIONS = {"frame": "0,0,159,89", "knot": "54,6,105,50"}
STAGES = ("camera", "intersect", "bin", "gather", "lights", "library", "scatter", "shadow", "accumulate")
Run = dict[str, Any]


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, required=True, help="the renderer's build directory")
    parser.add_argument("--out", type=Path, required=True, help="folder of the results")
    parser.add_argument("--source", type=Path, default=Path("."), help="the source tree, to name its revision")
    parser.add_argument("--compiler", default="unknown", help="its name and version")
    parser.add_argument("--size", default="320x180", help="of the timed frames (default 320x180)")
    parser.add_argument("--spp", type=int, default=8, help="of the timed frames (default 8)")
    parser.add_argument("--repetitions", type=int, default=9, help="of which the fastest counts (default 9)")
    parser.add_argument("--reference", type=int, default=4096, help="samples of the reference (default 4096)")
    parser.add_argument("--seeds", type=int, default=3, help="frames that errors are the means of (default 3)")
    return parser.parse_args()


def render(program: Path, out: Path, *options: str) -> Run:
    """Renders to out.exr and answers the statistics."""
    statistics = out.with_suffix(".json")
    command = [program, "--out", out.with_suffix(".exr"), "--statistics", statistics, *options]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return json.loads(statistics.read_text())


def processor_seconds(run: Run) -> float:
    return sum(run[stage] for stage in STAGES)


def fastest(
    runs: dict[Any, tuple[Any, ...]], repetitions: int, out: Path, seconds: Callable[[Run], float]
) -> dict[Any, Run]:
    """Of each run, all being interleaved."""
    best: dict[Any, Run] = {}
    for _ in range(repetitions):
        for name, (program, *options) in runs.items():
            run = render(program, out, *options)
            if name not in best or seconds(run) < seconds(best[name]):
                best[name] = run
    return best


def measure_steps(arguments: argparse.Namespace, isas: list[str]) -> pd.DataFrame:
    """Nanoseconds by stage for a shaded vertex; `step` is that of the vertices that the step shades."""
    options = ("--size", arguments.size, "--spp", str(arguments.spp), "--threads", "1")
    runs = {("library", isa): (arguments.build / LIBRARY, *options, "--isa", isa) for isa in isas}
    for step, program in STEPS.items():
        runs[step, "avx2" if step == "lanes" else "scalar"] = (arguments.build / program, *options)
    rows = []
    for (step, isa), run in fastest(runs, arguments.repetitions, arguments.out / "step", processor_seconds).items():
        busy = processor_seconds(run)
        rows.append(
            {
                "step": step,
                "isa": isa,
                "step_ns": 1e9 * run["library"] / run["shaded"],
                "step_share": run["library"] / busy,
                "vertices_per_second": run["vertices"] / busy,
                "samples_per_second": run["paths"] / busy,
                "bytes_per_path": run["bytes_per_path"],
                **{stage: 1e9 * run[stage] / run["vertices"] for stage in STAGES},
            }
        )
    return pd.DataFrame(rows)


def measure_scaling(arguments: argparse.Namespace, cores: int) -> pd.DataFrame:
    options = ("--size", arguments.size, "--spp", str(arguments.spp))
    counts = sorted({1, *(1 << bit for bit in range(cores.bit_length())), cores})
    runs = {n: (arguments.build / LIBRARY, *options, "--threads", str(n)) for n in counts if n <= cores}
    # The clock on the wall: an undisturbed run is rarer.
    best = fastest(runs, 3 * arguments.repetitions, arguments.out / "threads", lambda run: run["seconds"])
    return pd.DataFrame(
        [{"threads": n, "samples_per_second": run["paths"] / run["seconds"]} for n, run in best.items()]
    )


def squared_error(image: Path, reference: Path, region: str) -> float:
    """Mean over pixels and channels, relative to brightness, or a few bright pixels would say all."""
    x0, y0, x1, y1 = region.split(",")
    cut = ("--cut", f"{x0},{y0},{x1},{y1}")
    difference = (image, reference, "--sub", "--dup", "--mul")
    brightness = (reference, "--dup", "--mul", "--addc", "0.01")
    scaled = ("--div", *cut, "--mulc", "1e6", "--printstats")  # it prints six digits behind the point
    told = subprocess.run(
        ["oiiotool", *difference, *brightness, *scaled], check=True, capture_output=True, text=True
    ).stdout
    means = re.search(r"Stats Avg: (\S+) (\S+) (\S+)", told)
    assert means, told
    return 1e-6 * sum(float(mean) for mean in means.groups()) / 3


def measure_errors(arguments: argparse.Namespace) -> pd.DataFrame:
    program, out, size = arguments.build / LIBRARY, arguments.out, ("--size", ERROR_SIZE)
    render(program, out / "reference", *size, "--spp", str(arguments.reference), "--seed", "12345")
    rows = []
    for spp in SAMPLES:
        for seed in range(arguments.seeds):
            for way, options in WAYS.items():
                run = render(program, out / "way", *size, "--spp", str(spp), "--seed", str(seed), *options)
                for region, window in REGIONS.items():
                    error = squared_error(out / "way.exr", out / "reference.exr", window)
                    rows.append((way, region, spp, processor_seconds(run), error))
    table = pd.DataFrame(rows, columns=["way", "region", "spp", "seconds", "error"])
    means = table.groupby(["way", "region", "spp"], sort=False).agg(
        seconds=("seconds", "min"), error=("error", "mean")
    )
    return means.assign(rmse=means.error**0.5).drop(columns="error").reset_index()


def markdown(heads: str, rows: list[list[str]]) -> str:
    """A table whose columns but the first hold numbers."""
    columns = heads.split("|")
    lines = [columns, ["---"] + ["---:"] * (len(columns) - 1), *rows]
    return "\n".join("| " + " | ".join(cell.strip() for cell in line) + " |" for line in lines) + "\n"


def tell(steps: pd.DataFrame, scaling: pd.DataFrame, errors: pd.DataFrame) -> str:
    """The README's tables."""
    speeds = [
        [
            row["name"],
            f"{row.step_ns:.0f}",
            f"{100 * row.step_share:.1f} %",
            f"{1e-6 * row.vertices_per_second:.2f}",
            f"{1e-6 * row.samples_per_second:.2f}",
        ]
        for _, row in wavefront_plots.in_order(steps).iterrows()
    ]
    heads = "one core | step, ns a vertex | of the time | M vertices/s | M samples/s"
    one = scaling.samples_per_second[0]
    threads = [
        [f"{row.threads:.0f}", f"{1e-6 * row.samples_per_second:.2f}", f"{row.samples_per_second / one:.2f}"]
        for _, row in scaling.iterrows()
    ]
    compared = wavefront_plots.against_ndf(errors).pivot(index="way", columns="region").loc[list(WAYS)]
    ratios = [
        [wavefront_plots.WAYS[way], f"{row['rmse', 'frame']:.3f}"]
        + [f"{row[f'equal_{what}', region]:.2f}" for region in REGIONS for what in ("samples", "time")]
        for way, row in compared.iterrows()
    ]
    return "\n".join(
        [
            markdown(heads, speeds),
            markdown("threads | M samples/s | times one", threads),
            markdown(
                "sampling | RMSE | frame: equal samples | equal time | knot: equal samples | equal time", ratios
            ),
        ]
    )


def main() -> None:
    arguments = parse_arguments()
    out = arguments.out
    out.mkdir(parents=True, exist_ok=True)
    about = machine.describe(arguments.source, arguments.compiler, "", time.strftime("%Y-%m-%d"))
    start = time.monotonic()
    isas = []
    for isa in ("scalar", "sse42", "avx2", "avx512", "neon"):
        try:
            render(arguments.build / LIBRARY, out / "try", "--size", "1x1", "--spp", "1", "--isa", isa)
            isas.append(isa)
        except subprocess.CalledProcessError:
            print(f"{isa} is not on this machine: not measured")
    steps = measure_steps(arguments, isas)
    print(steps.round(3).to_string(), f"\n{time.monotonic() - start:.0f} s so far", flush=True)
    scaling = measure_scaling(arguments, int(about["cores"]))
    print(scaling.to_string(), f"\n{time.monotonic() - start:.0f} s so far", flush=True)
    errors = measure_errors(arguments)
    print(errors.to_string(), f"\n{time.monotonic() - start:.0f} s so far", flush=True)

    tables = {"steps": steps, "scaling": scaling, "errors": errors}
    document = {"about": about, "size": arguments.size, "spp": arguments.spp, "error_size": ERROR_SIZE}
    document |= {"repetitions": arguments.repetitions, "seeds": arguments.seeds, "reference": arguments.reference}
    document |= {name: table.to_dict("records") for name, table in tables.items()}
    (out / "measure.json").write_text(json.dumps(document, indent=1) + "\n")
    for name, draw in (("steps", wavefront_plots.steps), ("errors", wavefront_plots.errors)):
        (out / f"{name}.svg").write_text(pictures.in_both_modes(draw, tables[name])["light"])
    (out / "table.md").write_text(tell(steps, scaling, errors))
    print(f"\n{tell(steps, scaling, errors)}\nwrote {out.resolve()}: measure.json, steps.svg, errors.svg, table.md")


if __name__ == "__main__":
    main()

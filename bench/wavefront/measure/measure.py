"""Measures the wavefront renderer: time by stage against other shading steps, error at equal samples and at equal time,
scaling over threads. Writes measure.json and plots beside it.

Times of stages are of the processor, so other work on the machine disturbs them little. The fastest of a few runs counts.
"""

import argparse
import json
import subprocess
import time
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

WAYS = {
    "ndf": ["--sampler", "ndf"],
    "vndf polar": ["--sampler", "vndf", "--warp", "polar"],
    "vndf concentric": ["--sampler", "vndf", "--warp", "concentric"],
    "vndf cap": ["--sampler", "vndf", "--warp", "spherical_cap"],
    "bounded": ["--sampler", "bounded", "--warp", "spherical_cap"],
}
STEPS = {"library": "vndf_wavefront", "listing": "measure/vndf_wavefront_listing", "lanes": "measure/vndf_wavefront_lanes"}


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, required=True, help="the renderer's build directory")
    parser.add_argument("--out", type=Path, required=True, help="folder of the results")
    parser.add_argument("--size", default="320x180", help="of the frames (default 320x180)")
    parser.add_argument("--spp", type=int, default=32, help="of the timed frames (default 32)")
    parser.add_argument("--reference", type=int, default=4096, help="samples of the reference (default 4096)")
    parser.add_argument("--repetitions", type=int, default=3, help="of which the fastest counts (default 3)")
    parser.add_argument("--threads", type=int, default=2, help="most threads (default 2)")
    return parser.parse_args()


def render(program: Path, out: Path, *options: str) -> dict[str, Any]:
    """Renders to out.exr and answers the statistics."""
    statistics = out.with_suffix(".json")
    command = [program, "--quiet", "--out", out.with_suffix(".exr"), "--statistics", statistics, *options]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return json.loads(statistics.read_text())


def busy(run: dict[str, Any]) -> float:
    """Seconds of processors, of all threads together."""
    return sum(run["stages"].values())


def fastest(repetitions: int, *arguments: Any) -> dict[str, Any]:
    return min((render(*arguments) for _ in range(repetitions)), key=busy)


def pixels(exr: Path) -> np.ndarray:
    """By oiiotool, as raw floats in a PFM, whose rows come from the bottom."""
    pfm = exr.with_suffix(".pfm")
    subprocess.run(["oiiotool", exr, "-o", pfm], check=True)
    kind, size, _, data = pfm.read_bytes().split(b"\n", 3)
    width, height = (int(number) for number in size.split())
    assert kind == b"PF"
    return np.frombuffer(data, "<f4").reshape(height, width, 3)


def rmse(image: np.ndarray, reference: np.ndarray) -> float:
    """Relative to brightness, or a few bright pixels would say all."""
    return float(np.sqrt(np.mean((image - reference) ** 2 / (reference**2 + 0.01))))


def stages(arguments: argparse.Namespace) -> dict[str, Any]:
    options = ["--size", arguments.size, "--spp", str(arguments.spp), "--threads", "1"]
    runs = {}
    for isa in ("scalar", "sse42", "avx2", "avx512"):
        try:
            runs[f"library {isa}"] = fastest(
                arguments.repetitions, arguments.build / STEPS["library"], arguments.out / "step", *options, "--isa", isa
            )
        except subprocess.CalledProcessError:
            print(f"no {isa} here")
    for step in ("listing", "lanes"):
        runs[step] = fastest(arguments.repetitions, arguments.build / STEPS[step], arguments.out / "step", *options)
    for name, run in runs.items():
        nanoseconds = 1e9 * run["stages"]["library"] / run["shaded_by_library"]
        run["step_nanoseconds"] = nanoseconds
        rate = 1e-6 * run["vertices"] / busy(run)
        share = 100 * run["stages"]["library"] / busy(run)
        print(f"{name:16} {rate:5.2f} M vertices/s, shading step {nanoseconds:6.1f} ns a vertex, {share:4.1f} %")
    return runs


def errors(arguments: argparse.Namespace) -> dict[str, Any]:
    program = arguments.build / STEPS["library"]
    size = ["--size", arguments.size]
    render(program, arguments.out / "reference", *size, "--spp", str(arguments.reference), "--seed", "12345")
    reference = pixels(arguments.out / "reference.exr")
    results: dict[str, Any] = {}
    for way, options in WAYS.items():
        rows = []
        for spp in (4, 16, 64, 256):
            run = render(program, arguments.out / "way", *size, "--spp", str(spp), *options)
            rows.append({"spp": spp, "seconds": busy(run), "rmse": rmse(pixels(arguments.out / "way.exr"), reference)})
        results[way] = rows
        print(f"{way:16}" + "".join(f"  {row['spp']} spp {row['rmse']:.4f}" for row in rows))
    return results


def scaling(arguments: argparse.Namespace) -> dict[str, float]:
    options = ["--size", arguments.size, "--spp", str(arguments.spp)]
    program = arguments.build / STEPS["library"]
    return {
        str(threads): fastest(arguments.repetitions, program, arguments.out / "threads", *options, "--threads", str(threads))[
            "seconds"
        ]
        for threads in range(1, arguments.threads + 1)
    }


def plot(results: dict[str, Any], out: Path) -> None:
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4))
    names = list(results["stages"])
    bottom = np.zeros(len(names))
    for stage in results["stages"][names[0]]["stages"]:
        values = np.array(
            [1e9 * results["stages"][name]["stages"][stage] / results["stages"][name]["vertices"] for name in names]
        )
        left.bar(names, values, bottom=bottom, label=stage)
        bottom += values
    left.set_ylabel("ns per shaded vertex")
    left.tick_params(axis="x", rotation=20)
    left.legend(fontsize=8)
    for way, rows in results["errors"].items():
        right.loglog([row["spp"] for row in rows], [row["rmse"] for row in rows], "o-", label=way)
    right.set_xlabel("samples per pixel")
    right.set_ylabel("relative RMSE")
    right.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(out / "measure.svg")


def main() -> None:
    arguments = parse_arguments()
    arguments.out.mkdir(parents=True, exist_ok=True)
    results = {"date": time.strftime("%Y-%m-%d"), "size": arguments.size, "spp": arguments.spp}
    results["stages"] = stages(arguments)
    results["scaling"] = scaling(arguments)
    results["errors"] = errors(arguments)
    (arguments.out / "measure.json").write_text(json.dumps(results, indent=1))
    plot(results, arguments.out)


if __name__ == "__main__":
    main()

"""Joins the measurements of speed and of error into a page, a JSON file and a table on the terminal."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import ellipsoid
import machine
import page
import plots
import results
import theme

# The input and the batch size that headlines and the first table are about.
INPUT, COUNT = "camera", 4096


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--benchmark", type=Path, required=True, help="what measure.py wrote, or vndf_bench itself")
    parser.add_argument("--errors", type=Path, required=True, help="what vndf_errors wrote")
    parser.add_argument("--warps", type=Path, required=True, help="what vndf_warps wrote")
    parser.add_argument("--ellipsoid", type=Path, required=True, help="what vndf_ellipsoid wrote")
    parser.add_argument("--out", type=Path, required=True, help="directory of index.html, report.json and the plot")
    parser.add_argument("--source", type=Path, default=Path("."), help="the source tree, to name its revision")
    parser.add_argument("--compiler", default="unknown", help="its name and version")
    parser.add_argument("--flags", default="unknown", help="what it was called with")
    return parser.parse_args()


def print_table(data: results.Measurements) -> None:
    """The headline input: operation and warp, then one line per instruction set."""
    print(f"\n{INPUT}/{COUNT}, one core, errors over all hard cases in units of 2^-24")
    print(f"{'':<44}{'ns':>8}{'M/s':>9}{'x listing':>11}{'of copy':>9}{'mean':>10}{'p99.9':>10}{'max':>10}  worst")
    chosen = [r for r in data.results if r.speed.input == INPUT and r.speed.count == COUNT]
    for result in page.in_groups(data, chosen):
        speed, error = result.speed, result.error
        name = f"{speed.operation} {speed.warp} {speed.isa}"
        line = f"{name:<44}{speed.ns:8.3f}{speed.msamples:9.1f}"
        line += f"{result.vs_listing:10.2f}x" if result.vs_listing else f"{'-':>11}"
        line += f"{100 * result.roofline_share:8.0f}%" if result.roofline_share else f"{'-':>9}"
        if error:
            line += "".join(f"{'NaN' if v is None else f'{v:.3g}':>10}" for v in (error.mean_eps, error.p999_eps, error.max_eps))
            line += f"  {error.worst_row}"
        print(line)


def main() -> None:
    arguments = parse_arguments()
    theme.use()
    data = results.load(arguments.benchmark, arguments.errors)
    about = machine.describe(arguments.source, arguments.compiler, arguments.flags)
    figures = plots.draw(data, plots.read_warps(arguments.warps), INPUT, COUNT)

    ellipsoids = ellipsoid.read(arguments.ellipsoid)
    costs = ellipsoid.costs(data, INPUT, COUNT)
    section = ellipsoid.section(ellipsoids, costs, INPUT, COUNT)
    document = {**results.report_json(about, data.results), "ellipsoid": ellipsoid.summary(ellipsoids, costs)}

    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / "index.html").write_text(page.render(data, figures, about, INPUT, COUNT, section))
    (arguments.out / "report.json").write_text(json.dumps(document, indent=1) + "\n")
    if figures.speed_against_error:
        (arguments.out / "speed_vs_error.svg").write_text(theme.standalone(figures.speed_against_error[0]))
    print_table(data)
    print(f"\nwrote {(arguments.out / 'index.html').resolve()} and report.json beside it")


if __name__ == "__main__":
    main()

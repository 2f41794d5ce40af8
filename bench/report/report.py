"""Joins the measurements of speed and of error into a page, a JSON file and a table on the terminal."""

import argparse
import json
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

import machine
import page
import pictures
import tables

# What headlines and the first figures are about.
INPUT, COUNT = "camera", 4096
SPEEDS = ["ns", "msamples", "vs_listing", "vs_ispc", "roofline_share", "pace"]
ERRORS = ["mean_eps", "p999_eps", "max_eps", "worst_row", "ratio"]


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "directory", type=Path, help="of benchmark, errors, warps and ellipsoid.json, and the page"
    )
    parser.add_argument(
        "--source", type=Path, default=Path("."), help="the source tree, to name its revision"
    )
    parser.add_argument("--wavefront", type=Path, help="what bench/wavefront/measure wrote, if it is there")
    parser.add_argument("--compiler", default="unknown", help="its name and version")
    parser.add_argument("--flags", default="unknown", help="what it was called with")
    return parser.parse_args()


def read_ellipsoids(document: dict[str, Any], speeds: pd.DataFrame) -> dict[str, pd.DataFrame]:
    errors = tables.read_errors(document["errors"])
    densities = pd.DataFrame(document["densities"])
    return {
        "costs": tables.ellipsoid_costs(speeds),
        "errors": errors.assign(note=errors.row.map(document["row_notes"])),
        "rejections": pd.DataFrame(document["rejections"]),
        "densities": densities.assign(pdf=[np.array(pdf, dtype=float) for pdf in densities.pdf]),
    }


def read_wavefront(file: Path | None) -> dict[str, Any]:
    """Empty where the renderer was not measured."""
    if not file or not file.exists():
        return {}
    measured = json.loads(file.read_text())
    return measured | {name: pd.DataFrame(measured[name]) for name in ("steps", "scaling", "errors")}


def records(table: pd.DataFrame) -> list[dict[str, Any]]:
    """For JSON, which has no NaN."""
    return json.loads(table.to_json(orient="records"))


def main() -> None:
    arguments = parse_arguments()
    out = arguments.directory
    benchmark, facts, warps, ellipsoid = (
        json.loads((out / f"{name}.json").read_text())
        for name in ("benchmark", "errors", "warps", "ellipsoid")
    )
    speeds = tables.read_speeds(benchmark["benchmarks"])
    errors = tables.read_errors(facts["rows"])
    results = tables.join(speeds, errors, facts["peers"])
    headline = results[(results.input == INPUT) & (results["count"] == COUNT) & (results.threads == 1)]
    ellipsoids = read_ellipsoids(ellipsoid, headline)
    wavefront = read_wavefront(arguments.wavefront)
    figures = pictures.draw_all(results, headline, errors, pd.DataFrame(warps["maps"]), ellipsoids, wavefront)
    about = machine.describe(
        arguments.source, arguments.compiler, arguments.flags, benchmark["context"]["date"]
    )
    isas = tables.isas(benchmark["context"])

    facts |= {"about": about, "isas": isas, "kinds": tables.ELLIPSOIDS, "wavefront": wavefront}
    (out / "index.html").write_text(page.render(results, headline, errors, ellipsoids, figures, facts))
    told = results[[*tables.IMPLEMENTATION, "input", "count", "threads", *SPEEDS, *ERRORS]]
    document = {
        "machine": {**about, "instruction_sets": isas},
        "results": records(told.rename(columns={"ns": "ns_per_sample", "msamples": "msamples_per_s"})),
        "ellipsoid": {
            name: records(table.drop(columns="pdf", errors="ignore")) for name, table in ellipsoids.items()
        },
    }
    (out / "report.json").write_text(json.dumps(document, indent=1) + "\n")
    for mode, svg in figures["speed_against_error"]["sample_normals"].items():
        (out / f"speed_vs_error.{mode}.svg").write_text(svg)

    print(f"\n{INPUT}/{COUNT}, one core, errors over all hard cases in units of 2^-24\n")
    shown = headline[[*tables.IMPLEMENTATION, *SPEEDS, *ERRORS]]
    print(shown.to_string(index=False, na_rep="-", float_format=lambda value: f"{value:.3g}"))
    for isa, supported in isas.items():
        if not supported:
            print(f"{isa} is not on this machine: not measured")
    print(f"\nwrote {(out / 'index.html').resolve()} and report.json beside it")


if __name__ == "__main__":
    main()

"""Every figure of the page, as SVG for light and for dark."""

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib
import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.figure import Figure

import ellipsoid_plots
import plots
import wavefront_plots
from words import nice

STYLES = Path(__file__).parent / "style"
MODES = ("light", "dark")
SAMPLED = "sample_normals"  # what the peers do


def in_both_modes(draw: Callable[..., Figure], *arguments: Any) -> dict[str, str]:
    pictures = {}
    for mode in MODES:
        with plt.style.context([STYLES / "report.mplstyle", STYLES / f"{mode}.mplstyle"]):
            text = io.StringIO()
            figure = draw(*arguments)
            figure.savefig(text, format="svg", metadata={"Date": None})
            plt.close(figure)
            pictures[mode] = text.getvalue()
    return pictures


def colors() -> dict[str, dict[str, str]]:
    """Those of the figures, for the page."""
    names = {
        "ink": "text.color",
        "soft": "axes.labelcolor",
        "line": "grid.color",
        "panel": "savefig.facecolor",
        "page": "figure.facecolor",
    }
    modes = {}
    for mode in MODES:
        style = matplotlib.rc_params_from_file(STYLES / f"{mode}.mplstyle", use_default_template=False)
        modes[mode] = {name: style[key] for name, key in names.items()}
        modes[mode]["accent"] = style["axes.prop_cycle"].by_key()["color"][0]
    return modes


def error_series(errors: pd.DataFrame, operation: str) -> list[tuple[pd.DataFrame, str, str]]:
    """Every warp of ours and, where they do the same, the published listings of these warps."""
    errors = errors[~errors.undefined]
    ours = errors[errors.operation == operation].groupby("warp", sort=False)
    series = [(rows, f"vndf, {nice(warp)}", color) for color, (warp, rows) in zip(plots.OF_WARPS, ours)]
    if operation == SAMPLED:
        theirs = errors[(errors.isa == "scalar") & errors.warp.isin(ours.groups)]
        theirs = theirs.groupby("operation", sort=False)
        series += [(rows, nice(name), color) for color, (name, rows) in zip((plots.PEER, "C3"), theirs)]
    return series


def small_calls(curves: pd.DataFrame) -> dict[str, str] | None:
    """Of polar sampling and of what has no warp, where ISPC's peers were built."""
    rows = curves[curves.warp.isin(["polar", "none"]) & (curves["count"] <= 4096)]
    rows = rows[(rows.kind == "ours") | rows.operation.str.startswith("ispc_")]
    operations = ["sample_normals", "sample_reflection", "evaluate_reflection", "sample_dielectric"]
    if not (rows.kind == "peer").any():
        return None
    return in_both_modes(plots.small_calls, rows, operations)


def draw_all(
    results: pd.DataFrame,
    headline: pd.DataFrame,
    errors: pd.DataFrame,
    maps: pd.DataFrame,
    ellipsoid: dict[str, pd.DataFrame],
    wavefront: dict[str, Any],
) -> dict[str, Any]:
    """Some are by operation: of ours those whose errors were measured, that of the peers first."""
    compared = headline[headline.worst_row.notna()]
    peers = compared[compared.kind == "peer"]
    plain = headline[(headline.kind != "copy") & (headline["shape"] == "plain")]
    curves = results[results.input.isin(headline.input) & (results.threads == 1)]
    listing = curves[curves.operation == "paper_listing"]
    speed, batches, cases = {}, {}, {}
    for operation, ours in compared[compared.kind == "ours"].groupby("operation", sort=False):
        curve = curves[curves.operation == operation]
        same = operation == SAMPLED
        rows = pd.concat([ours, peers]) if same else ours
        speed[operation] = in_both_modes(plots.speed_against_error, rows)
        batches[operation] = in_both_modes(plots.throughput, curve, listing if same else None)
        cases[operation] = in_both_modes(plots.error_per_case, error_series(errors, operation))
    return {
        "speed_against_error": speed,
        "throughput": batches,
        "small_calls": small_calls(curves),
        "errors": cases,
        "overview": in_both_modes(plots.overview, plain),
        "checker": in_both_modes(plots.warped_square, maps, "checker"),
        "points": in_both_modes(plots.warped_square, maps, "points"),
        "densities": in_both_modes(ellipsoid_plots.densities, ellipsoid["densities"]),
        "ellipsoid_costs": in_both_modes(ellipsoid_plots.costs, ellipsoid["costs"]),
        "ellipsoid_errors": in_both_modes(ellipsoid_plots.errors, ellipsoid["errors"]),
        **draw_wavefront(wavefront),
    }


def draw_wavefront(measured: dict[str, Any]) -> dict[str, dict[str, str]]:
    draws = {"steps": wavefront_plots.steps, "errors": wavefront_plots.errors}
    return {f"wavefront_{name}": in_both_modes(draw, measured[name]) for name, draw in draws.items() if measured}

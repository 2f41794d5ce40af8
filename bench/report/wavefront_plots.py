"""The figures of the wavefront renderer, from what bench/wavefront/measure/measure.py wrote."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import StrMethodFormatter

from plots import DASHES, log_axis, stripes, style
from words import nice, number

# The step first, so that all of it can be compared; what remains is rays and memory.
STAGES = {
    "shading step": ["library"],
    "gather": ["gather"],
    "lights": ["lights"],
    "scatter": ["scatter"],
    "queues": ["camera", "bin", "accumulate"],
    "rays": ["intersect", "shadow"],
}
WAYS = {
    "ndf": "NDF",
    "polar": "visible, polar",
    "concentric": "visible, concentric",
    "spherical_cap": "visible, cap",
    "bounded": "bounded, cap",
}
OF_WAYS = ["C6", "C0", "C1", "C2", "C3"]
OF_STAGES = ["C5", "C0", "C1", "C7", "C3", "C6"]
EQUAL = 64  # samples of NDF sampling that the others are compared at


def name_of(row: pd.Series) -> str:
    step = {"listing": "paper’s listing", "lanes": "fused kernel", "library": "library"}[row.step]
    return f"{step}, {nice(row.isa)}"


def in_order(steps: pd.DataFrame) -> pd.DataFrame:
    """With names, and the listing first: it is what the others are beside."""
    rows = steps.sort_values("step", key=lambda step: step != "listing", kind="stable").reset_index(drop=True)
    return rows.assign(name=rows.apply(name_of, axis=1))


def steps(table: pd.DataFrame) -> Figure:
    """Left, a vertex by stages; right, the shading step alone."""
    rows = in_order(table)
    figure, (whole, alone) = plt.subplots(
        1, 2, figsize=(9, 0.9 + 0.3 * len(rows)), sharey=True, gridspec_kw={"width_ratios": (3, 2)}
    )
    for axes in (whole, alone):
        stripes(axes, list(rows.name))
    left = np.zeros(len(rows))
    for (name, stages), color in zip(STAGES.items(), OF_STAGES):
        ns = rows[stages].sum(axis=1).to_numpy()
        whole.barh(rows.index, ns, left=left, height=0.62, color=color, label=name)
        left += ns
    whole.set_xlabel("ns per shaded vertex, one core (left is better)")
    alone.barh(rows.index, rows.step_ns, height=0.62, color=OF_STAGES[0])
    for at, ns in rows.step_ns.items():
        alone.annotate(number(ns), (ns, at), xytext=(3, 0), textcoords="offset points", va="center", fontsize=8)
    alone.set_xlabel("the shading step alone, ns a vertex")
    alone.set_xlim(0, 1.15 * rows.step_ns.max())
    height = figure.get_size_inches()[1]
    figure.subplots_adjust(left=0.165, right=0.985, top=1 - 0.32 / height, bottom=0.5 / height, wspace=0.1)
    handles, names = whole.get_legend_handles_labels()
    figure.legend(handles, names, loc="upper right", ncol=len(names), bbox_to_anchor=(0.99, 1.0))
    return figure


def against_ndf(table: pd.DataFrame) -> pd.DataFrame:
    """Errors in units of NDF sampling's at EQUAL samples: at as many samples, and at the same time."""
    rows = []
    for region, errors in table.groupby("region", sort=False):
        ndf = errors[(errors.way == "ndf") & (errors.spp == EQUAL)].iloc[0]
        for way, curve in errors.groupby("way", sort=False):
            at_time = np.exp(np.interp(np.log(ndf.seconds), np.log(curve.seconds), np.log(curve.rmse)))
            at_samples = curve.rmse[curve.spp == EQUAL].iloc[0]
            rows.append((region, way, at_samples, at_samples / ndf.rmse, at_time / ndf.rmse))
    return pd.DataFrame(rows, columns=["region", "way", "rmse", "equal_samples", "equal_time"])


def curves(axes: Axes, table: pd.DataFrame, title: str) -> None:
    for color, (way, rows) in zip(OF_WAYS, table.groupby("way", sort=False)):
        axes.plot(rows.seconds, rows.rmse, "o-", color=color, ms=3.5, label=WAYS[way])
    axes.set(xscale="log", yscale="log", title=title, xlabel="seconds of one core")
    for axis in (axes.xaxis, axes.yaxis):
        log_axis(axis, (1, 2, 5))
        axis.set_major_formatter(StrMethodFormatter("{x:g}"))


def errors(table: pd.DataFrame) -> Figure:
    """Error over time, and in units of NDF sampling's: dots at equal samples, rings at equal time."""
    figure, (knot, ratios) = plt.subplots(1, 2, figsize=(9, 3.2))
    curves(knot, table[table.region == "knot"], "the golden knot")
    knot.set_ylabel("relative RMSE (down is better)")
    compared = against_ndf(table)
    order = list(WAYS)
    stripes(ratios, list(WAYS.values()))
    for region, shift in (("knot", -0.14), ("frame", 0.14)):
        rows = compared[compared.region == region]
        y = rows.way.map(order.index) + shift
        color = "C0" if region == "knot" else "C6"
        ratios.plot(rows.equal_samples, y, "o", color=color, ms=5.5, label=f"{region}, equal samples")
        ratios.plot(rows.equal_time, y, "o", mfc="none", mec=color, ms=8, label=f"{region}, equal time")
    ratios.axvline(1, color=style("axes.labelcolor"), lw=1, ls=DASHES, zorder=1)
    ratios.set_xlabel(f"RMSE over NDF’s, {EQUAL} samples a pixel (left is better)")
    figure.subplots_adjust(left=0.07, right=0.985, top=0.86, bottom=0.16, wspace=0.42)
    knot.legend(loc="lower left", fontsize=7.5)
    handles, names = ratios.get_legend_handles_labels()
    figure.legend(handles, names, loc="upper right", ncol=2, bbox_to_anchor=(0.99, 1.0), fontsize=7.5)
    return figure

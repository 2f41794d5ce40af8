"""The figures of the library beside its peers, each drawn from tables in the colours of the style in use."""

import math
from collections.abc import Iterable

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.ticker import EngFormatter, FixedLocator, FuncFormatter, LogLocator, NullLocator

from tables import EPS, WORST_EPS
from words import nice

# The colours of style/*.mplstyle by what they stand for; a list's are taken in turn.
PEER = "C5"
OF_WARPS = ["C0", "C1", "C2", "C3", "C4"]
OF_ISAS = {"scalar": "C6", "sse42": "C7", "avx2": "C0", "avx512": "C1", "neon": "C4"}
MARKERS = ["o", "s", "^", "D", "v", "P"]
DASHES = (0, (4, 3))


def style(name: str) -> str:
    return plt.rcParams[name]


def log_axis(axis: Axis, steps: Iterable[float] = (1,)) -> None:
    """Plain words at the decades and, if asked, between: 1, 10, 100, 1 k, 1 M."""
    axis.set_major_locator(LogLocator(subs=steps, numticks=99))
    axis.set_major_formatter(EngFormatter())
    axis.set_minor_locator(NullLocator())


def stripes(axes: Axes, names: list[str]) -> None:
    """Rows from top to bottom, every other one on a darker ground."""
    axes.set_yticks(range(len(names)), names)
    axes.tick_params(axis="y", length=0, labelcolor=style("text.color"))
    axes.set_ylim(len(names) - 0.4, -0.6)
    axes.grid(axis="y", visible=False)
    for row in range(0, len(names), 2):
        axes.axhspan(row - 0.5, row + 0.5, color=style("grid.color"), alpha=0.22, lw=0)


# --- Speed against error ------------------------------------------------------------------------------------


def speed_against_error(rows: pd.DataFrame) -> Figure:
    """One operation and its peers: columns of tables.join, of one input and count."""
    rows = rows.assign(
        error=rows.shared_max_eps.clip(upper=WORST_EPS), easy=rows.typical_max_eps.clip(upper=WORST_EPS)
    )
    ours, peers = rows[rows.kind == "ours"], rows[rows.kind == "peer"]
    # A peer that samples something else is shown, but beats nobody.
    rivals = rows[rows.does == ours.does.iloc[0]].sort_values(["error", "msamples"], ascending=[True, False])
    front = rivals[rivals.msamples > rivals.msamples.cummax().shift(fill_value=0)]
    roof = 1e3 / ours.roof_ns.iloc[0]
    soft, ground = style("axes.labelcolor"), style("axes.facecolor")

    figure, axes = plt.subplots(figsize=(9, 5.6))
    axes.set(xscale="log", xlim=(rows.easy.min() / 12, max(25 * rows.error.max(), 800)))
    axes.set(yscale="log", ylim=(rows.msamples.min() / 1.6, 1.35 * max(rows.msamples.max(), roof)))
    corners = [(front.error.iloc[0], axes.get_ylim()[0]), *zip(front.error, front.msamples)]
    corners.append((axes.get_xlim()[1], front.msamples.iloc[-1]))
    axes.step(
        *zip(*corners), "C2", where="post", lw=5, alpha=0.25, zorder=1, label="Pareto front: beaten by none"
    )
    axes.axhline(roof, color=soft, lw=1, ls=DASHES, label="copy: the same columns, nothing computed")

    axes.hlines(ours.msamples, ours.easy, ours.error, color=style("xtick.color"), lw=1, zorder=1)
    axes.hlines(peers.msamples, peers.easy, peers.error, color=PEER, lw=1, alpha=0.4, zorder=1)
    axes.plot(ours.easy, ours.msamples, "|", color=soft, ms=6)
    axes.plot(peers.easy, peers.msamples, "|", color=PEER, ms=6)
    for (warp, points), marker in zip(ours.groupby("warp", sort=False), MARKERS):
        axes.plot(points.error, points.msamples, color=style("xtick.color"), lw=1, zorder=1)
        axes.plot([], [], marker, color=soft, label=f"vndf, {nice(warp)}")
        for point, color in zip(points.itertuples(), points.isa.map(OF_ISAS)):
            axes.plot(point.error, point.msamples, marker, color=color, mec=ground, ms=8, zorder=3)
    for isa in ours.isa.unique():
        axes.plot([], [], "s", color=OF_ISAS[isa], label=nice(isa))
    for other, fill in ((False, PEER), (True, ground)):
        points = peers[(peers.does != ours.does.iloc[0]) == other]
        axes.plot(points.error, points.msamples, "X", mfc=fill, mec=PEER, ms=6.5, zorder=3)
    name_points(axes, peers)

    log_axis(axes.xaxis)
    log_axis(axes.yaxis, (1, 2, 5))
    axes.set_xlabel(
        "largest error over the hard cases, in units of 2⁻²⁴ (left is better); tick: over the typical case"
    )
    axes.set_ylabel("million samples per second, one core (up is better)")
    distance = axes.secondary_xaxis("top", functions=(lambda eps: eps * EPS, lambda d: d / EPS))
    distance.xaxis.set_minor_locator(NullLocator())
    distance.set_xlabel("the same as a distance between unit vectors", fontsize=8)
    distance.spines["top"].set_visible(False)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), ncol=4, columnspacing=1.6)
    figure.subplots_adjust(left=0.075, right=0.985, top=0.9, bottom=0.2)
    return figure


def name_points(axes: Axes, points: pd.DataFrame) -> None:
    """Names to the right of points, a line apart where the points are closer."""
    points = points.assign(
        at=axes.transData.transform(points[["error", "msamples"]])[:, 1] * 72 / axes.figure.dpi
    )
    last = -math.inf
    for point in points.sort_values("at").itertuples():
        last = max(point.at, last + 10)
        name = nice(point.operation) + ("" if point.isa == "scalar" else f" {nice(point.isa)}")
        shift = {"xytext": (7, last - point.at), "textcoords": "offset points", "va": "center_baseline"}
        axes.annotate(name, (point.error, point.msamples), color=PEER, fontsize=8.2, **shift)


# --- Speed --------------------------------------------------------------------------------------------------


def dots(axes: Axes, rows: pd.DataFrame, value: str) -> None:
    """A line of the picture per operation and warp, a dot per instruction set."""
    first = rows.drop_duplicates("group")
    y = rows.group.map(dict(zip(first.group, range(len(first)))))
    ends = rows.groupby(y)[value].agg(["min", "max"])
    axes.hlines(ends.index, ends["min"], ends["max"], color=style("xtick.color"), lw=1.6)
    for isa in rows.isa.unique():
        mine = rows.isa == isa
        axes.plot(rows[value][mine], y[mine], "o", color=OF_ISAS[isa], ms=5.5, label=nice(isa))
    axes.set_xscale("log")
    warps = first.warp.map(lambda warp: "" if warp in ("none", "own") else f", {nice(warp)}")
    stripes(axes, list(first.operation.map(nice) + warps))


def overview(rows: pd.DataFrame) -> Figure:
    """How fast every operation is on every set, ours and the peers', with the copy of the same columns."""
    first = rows.drop_duplicates("group")
    figure, axes = plt.subplots(figsize=(9, 1.1 + 0.22 * len(first)))
    dots(axes, rows, "msamples")
    axes.plot(1e3 / first.roof_ns, range(len(first)), "|", color=style("axes.labelcolor"), ms=9, label="copy")
    for text, kind in zip(axes.get_yticklabels(), first.kind):
        text.set_color(PEER if kind == "peer" else style("text.color"))
    log_axis(axes.xaxis, (1, 2, 5))
    axes.set_xlabel("million samples per second, one core (right is better)")
    legend_above(figure, axes)
    return figure


def legend_above(figure: Figure, axes: Axes) -> None:
    """A legend on top, and room for long names on the left."""
    height = figure.get_size_inches()[1]
    figure.subplots_adjust(left=0.34, right=0.985, top=1 - 0.38 / height, bottom=0.5 / height)
    handles, names = axes.get_legend_handles_labels()
    figure.legend(handles, names, loc="upper right", ncol=len(names), bbox_to_anchor=(0.99, 1.0))


def throughput(rows: pd.DataFrame, listing: pd.DataFrame | None) -> Figure:
    """One operation against the batch size, a panel per warp; the listing's rows where it does the same."""
    warps, isas = rows.warp.unique(), rows.isa.unique()
    figure, panels = plt.subplots(1, len(warps), figsize=(9, 3.7), sharey=True, squeeze=False)
    roof = rows.drop_duplicates("count").sort_values("count")
    for axes, warp in zip(panels[0], warps):
        axes.plot(roof["count"], 1e3 / roof.roof_ns, color=style("axes.labelcolor"), ls=DASHES, label="copy")
        series = [] if listing is None else [(listing, PEER, "paper listing")]
        mine = rows[rows.warp == warp]
        series += [(mine[mine.isa == isa], OF_ISAS[isa], nice(isa)) for isa in isas]
        for line, color, name in series:
            line = line.sort_values("count")
            axes.plot(line["count"], line.msamples, "o-", color=color, ms=3.5, label=name)
        axes.set_title(f"{nice(mine.operation.iloc[0])}, {nice(warp)}")
        axes.set(xscale="log", yscale="log", xlabel="samples per call")
        axes.xaxis.set_major_locator(FixedLocator([1 << exponent for exponent in range(0, 24, 4)]))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: binary(value)))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.tick_params(axis="x", labelrotation=45)
        log_axis(axes.yaxis, (1, 2, 5))
    panels[0][0].set_ylabel("million samples per second")
    handles, names = panels[0][0].get_legend_handles_labels()
    figure.legend(handles[::-1], names[::-1], loc="lower center", ncol=len(names))
    figure.subplots_adjust(left=0.07, right=0.99, top=0.92, bottom=0.3, wspace=0.08)
    return figure


def small_calls(rows: pd.DataFrame, operations: list[str]) -> Figure:
    """Nanoseconds of a call against its samples, ours and ISPC's: a panel per operation."""
    isas = [isa for isa in rows.isa.unique() if isa in set(rows.isa[rows.kind == "peer"])]
    figure, panels = plt.subplots(1, len(operations), figsize=(9, 3.7), sharey=True, squeeze=False)
    for axes, operation in zip(panels[0], operations):
        same = rows[rows.does == operation].sort_values("count")
        for isa in isas:
            color = OF_ISAS[isa]
            for kind, dashes, name in (("ours", "-", nice(isa)), ("peer", DASHES, "")):
                line = same[(same.isa == isa) & (same.kind == kind)]
                axes.plot(line["count"], line.ns * line["count"], color=color, ls=dashes, lw=1.3, label=name or None)
        axes.set_title(nice(operation))
        axes.set(xscale="log", yscale="log", xlabel="samples per call")
        axes.xaxis.set_major_locator(FixedLocator([1, 4, 16, 64, 256, 1024, 4096]))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: binary(value)))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.tick_params(axis="x", labelrotation=45)
        log_axis(axes.yaxis)
    panels[0][0].plot([], [], color=style("axes.labelcolor"), ls=DASHES, label="in ISPC")
    panels[0][0].set_ylabel("nanoseconds per call")
    handles, names = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, names, loc="lower center", ncol=len(names))
    figure.subplots_adjust(left=0.07, right=0.99, top=0.92, bottom=0.3, wspace=0.08)
    return figure


def binary(count: float) -> str:
    for limit, unit in ((1 << 20, " Mi"), (1 << 10, " Ki")):
        if count >= limit:
            return f"{count / limit:g}{unit}"
    return f"{count:g}"


# --- Error per hard case ------------------------------------------------------------------------------------


def error_per_case(series: list[tuple[pd.DataFrame, str, str]], largest: float = 9e7) -> Figure:
    """A line per case and series (rows, name in the legend if any, colour), from the mean to the maximum."""
    cases = list(series[0][0].row.unique())
    step = 1 / (len(series) + 1.2)
    figure, axes = plt.subplots(figsize=(9, 1.2 + 0.1 * len(cases) / step))
    axes.set(xscale="log", xlim=(0.12, largest))
    for index, (rows, name, color) in enumerate(series):
        rows = rows[rows.row.isin(cases)]
        y = rows.row.map(cases.index) + (index - (len(series) - 1) / 2) * step
        distances = rows[["mean_eps", "p999_eps", "max_eps"]].clip(upper=WORST_EPS)
        mean, p999, worst = distances.to_numpy().T
        color = style("axes.labelcolor") if color == "soft" else color
        axes.hlines(y, mean, worst, color=color, lw=1.2, alpha=0.8)
        axes.plot(p999, y, "|", color=color, ms=5, mew=1.2)
        axes.plot(worst, y, "o", color=color, ms=4.5)
        hollow = np.isinf(rows.max_eps)
        axes.plot(worst[hollow], y[hollow], "o", color=style("axes.facecolor"), ms=2.5)
        if name:
            axes.plot([], [], "o-", color=color, ms=4.5, lw=1.2, label=name)
    stripes(axes, [nice(case) for case in cases])
    log_axis(axes.xaxis)
    axes.set_xlabel("units of 2⁻²⁴: line from the mean, tick at p99.9, dot at the maximum (left is better)")
    legend_above(figure, axes)
    return figure


# --- The warped square --------------------------------------------------------------------------------------


def warped_square(maps: pd.DataFrame, kind: str) -> Figure:
    """One row per map, one column per view angle: `checker` cells or `points`, in slope space."""
    rows, columns = maps["map"].nunique(), maps.degrees.nunique()
    figure, panels = plt.subplots(rows, columns, figsize=(9, 8.6 / columns * rows + 0.31), squeeze=False)
    windows = {degrees: window(np.concatenate([*same.points])) for degrees, same in maps.groupby("degrees")}
    for axes, entry in zip(panels.flat, maps.itertuples()):
        x, y = windows[entry.degrees]
        place = axes.get_subplotspec()
        color = OF_WARPS[place.rowspan.start % len(OF_WARPS)]
        # Pixels, at the resolution of the style: as outlines they would be most of the page's size.
        if kind == "checker":
            axes.add_collection(PolyCollection(entry.checker, fc=color, alpha=0.75, lw=0, rasterized=True))
        else:
            axes.plot(*np.transpose(entry.points), "o", color=color, ms=2, mew=0, rasterized=True)
        axes.set(xlim=x, ylim=y, aspect="equal", xticks=[], yticks=[])
        axes.spines[:].set_visible(True)
        axes.axhline(0, color=style("grid.color"), lw=0.6, zorder=0)
        axes.axvline(0, color=style("grid.color"), lw=0.6, zorder=0)
        if place.is_first_row():
            axes.set_title(f"{entry.degrees:g}° from the normal", fontsize=9, loc="center", pad=5)
        if place.is_first_col():
            axes.set_ylabel(nice(entry.map), color=style("text.color"), fontweight="bold")
    height = figure.get_size_inches()[1]
    figure.subplots_adjust(
        left=0.035, right=0.995, top=1 - 0.26 / height, bottom=0.05 / height, wspace=0.04, hspace=0.04
    )
    return figure


def window(points: np.ndarray) -> list[tuple[float, float]]:
    """A square that shows most points: slopes have no bound."""
    low, high = np.quantile(points, [1 / 14, 13 / 14], axis=0)
    half = (high - low).max() / 2 * 1.1
    return [(middle - half, middle + half) for middle in (low + high) / 2]

"""The figures of the report, each as SVG text."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Iterable, Optional

import theme
from results import EPS, LISTING, ErrorRow, Measurements, Result, copy_ns, or_worst, unique

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Outline
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter, NullLocator
from matplotlib.transforms import Bbox

MARKERS = ["o", "s", "^", "D", "v", "P"]
NICE = {
    "sse42": "SSE4.2",
    "avx2": "AVX2",
    "avx512": "AVX-512",
    "heitz_2017": "Heitz 2017",
    "heitz_deon_2014": "Heitz, d’Eon 2014",
    "heitz_deon_2014_roots": "2014, by roots",
    "ndf_walter_2007": "NDF, Walter 2007",
    "ispc_listing": "ISPC listing",
    "ispc_caps": "ISPC caps",
    "spherical_cap_listing": "caps listing",
    "paper_listing_fast": "fast listing",
    "plus_z": "exactly +z",
    "minus_z": "exactly −z",
    "near_plus_z": "near +z",
    "near_minus_z": "near −z",
}


def nice(word: str) -> str:
    """A name as people write it."""
    return NICE.get(word, word.replace("_", " "))


def short(value: float) -> str:
    """1, 10, 100, 1 k, 1 M: the labels of a logarithmic axis."""
    for limit, unit in ((1e9, " G"), (1e6, " M"), (1e3, " k")):
        if value >= limit:
            return f"{value / limit:g}{unit}"
    return f"{value:g}"


def grouped(value: int) -> str:
    """Thousands apart by narrow spaces."""
    return f"{value:,}".replace(",", "\u202f")


def log_axis(axis: Any, low: float, high: float, steps: Iterable[float] = (1,)) -> None:
    """Plain words at the decades and, if asked, between."""
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    ticks = [step * 10.0**decade for decade in decades for step in steps]
    axis.set_major_locator(FixedLocator([tick for tick in ticks if low <= tick <= high]))
    axis.set_major_formatter(FuncFormatter(lambda value, _: short(value)))
    axis.set_minor_locator(NullLocator())
    axis.set_minor_formatter(NullFormatter())


# --- Labels beside points ------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Label:
    text: str
    x: float
    y: float
    role: str
    bold: bool = False


def overlap(a: Bbox, b: Bbox) -> float:
    width = min(a.x1, b.x1) - max(a.x0, b.x0)
    height = min(a.y1, b.y1) - max(a.y0, b.y0)
    return max(width, 0.0) * max(height, 0.0)


def obstacles(axes: Axes, labels: list[Label], lines: list[list[tuple[float, float]]],
              scale: float) -> list[tuple[Bbox, float]]:
    """The points and the upright or level lines, each with the weight of covering it: a line may be crossed at need."""
    boxes = []
    for label in labels:
        x, y = axes.transData.transform((label.x, label.y))
        boxes.append((Bbox.from_extents(x - 4.5 * scale, y - 4.5 * scale, x + 4.5 * scale, y + 4.5 * scale), 1.0))
    for line in lines:
        (x0, y0), (x1, y1) = axes.transData.transform([line[0], line[-1]])
        boxes.append((Bbox.from_extents(min(x0, x1) - scale, min(y0, y1) - scale, max(x0, x1) + scale,
                                        max(y0, y1) + scale), 0.12))
    return boxes


def place_labels(axes: Axes, labels: list[Label], lines: list[list[tuple[float, float]]]) -> None:
    """Writes each label where it covers no point and no other label, near its point; a thin line leads to it if far."""
    figure = axes.figure
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    scale = figure.dpi / 72
    frame = axes.get_window_extent(renderer)
    taken = obstacles(axes, labels, lines, scale)
    for label in sorted(labels, key=lambda item: (not item.bold, -item.y)):
        text = axes.text(label.x, label.y, label.text, color=theme.color(label.role), fontsize=8.2,
                         fontweight="bold" if label.bold else "normal", va="center_baseline", gid=theme.HALO)
        size = text.get_window_extent(renderer)
        at_x, at_y = axes.transData.transform((label.x, label.y))
        best: Optional[tuple[float, Bbox, float, float]] = None
        for distance in (8, 14, 22, 32, 44, 58, 74):
            for degrees in (0, 180, 20, -20, 160, -160, 40, -40, 140, -140, 65, -65, 115, -115, 90, -90):
                angle = math.radians(degrees)
                dx, dy = distance * scale * math.cos(angle), 0.8 * distance * scale * math.sin(angle)
                # The label's near edge sits at the end of the ray: left, right or the middle of it.
                shift = 0.0 if math.cos(angle) > 0.3 else -1.0 if math.cos(angle) < -0.3 else -0.5
                box = Bbox.from_bounds(at_x + dx + shift * size.width, at_y + dy - size.height / 2,
                                       size.width, size.height)
                hidden = sum(weight * overlap(box.padded(1.5), other) for other, weight in taken)
                outside = size.width * size.height - overlap(box, frame)
                cost = hidden + 4 * outside + 0.9 * distance * scale
                if best is None or cost < best[0]:
                    best = (cost, box, dx, dy)
        assert best is not None
        _, box, dx, dy = best
        text.set_position(axes.transData.inverted().transform((box.x0, (box.y0 + box.y1) / 2)))
        taken.append((box, 1.0))
        if math.hypot(dx, dy) > 12 * scale:
            ends = axes.transData.inverted().transform([(at_x + 0.35 * dx, at_y + 0.35 * dy),
                                                        (at_x + 0.93 * dx, at_y + 0.93 * dy)])
            axes.plot(ends[:, 0], ends[:, 1], color=theme.color(label.role), lw=0.5, alpha=0.6, zorder=1)


# --- Speed against error -------------------------------------------------------------------------------------------


def pareto_front(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Of points (error, speed), those that no other beats in both, by growing error."""
    front: list[tuple[float, float]] = []
    for error, speed in sorted(points, key=lambda point: (point[0], -point[1])):
        if not front or speed > front[-1][1]:
            front.append((error, speed))
    return front


def comparable(data: Measurements, operation: str, source: str, count: int) -> list[Result]:
    """One operation and, for the sampling of normals, its peers: measured in speed and error, same input and count."""
    def wanted(result: Result) -> bool:
        speed = result.speed
        mine = speed.operation == operation
        peer = data.is_peer(speed.operation) and operation == data.peer_operation
        return (mine or peer) and speed.input == source and speed.count == count and result.error is not None

    return [result for result in data.results if wanted(result)]


def label_of(data: Measurements, result: Result) -> str:
    speed = result.speed
    if data.is_ours(speed.operation):
        return f"{nice(speed.isa)} {nice(speed.warp)}"
    name = nice(speed.operation)
    return name if speed.isa == "scalar" else f"{name} {nice(speed.isa)}"


def speed_against_error(data: Measurements, operation: str, source: str, count: int) -> Optional[str]:
    rows = comparable(data, operation, source, count)
    if len(rows) < 2:
        return None
    figure, axes = plt.subplots(figsize=(9, 5.6))
    axes.set_xscale("log")
    axes.set_yscale("log")
    points = [(or_worst(row.error.shared_max_eps), row.speed.msamples) for row in rows]
    typical = [or_worst(row.error.typical_max_eps) for row in rows]
    # A peer that samples something else is shown, but beats nobody.
    rivals = [data.peers.get(row.speed.operation, operation) == operation for row in rows]
    warps = unique(row.speed.warp for row in rows if data.is_ours(row.speed.operation))

    errors, speeds = zip(*points)
    roof = roofline_by_count(data, operation).get(count)
    axes.set_xlim(min(typical) / 12, max(max(errors) * 30, 1e5))
    axes.set_ylim(min(speeds) / 1.6, max(speeds + ((roof,) if roof else ())) * 1.35)

    front = pareto_front([point for point, rival in zip(points, rivals) if rival])
    steps = [(front[0][0], axes.get_ylim()[0]), *front, (axes.get_xlim()[1], front[-1][1])]
    axes.step(*zip(*steps), where="post", color=theme.color("front"), lw=5, alpha=0.22, solid_joinstyle="round", zorder=1)
    if roof:
        axes.axhline(roof, color=theme.color("soft"), lw=1, ls=(0, (4, 3)), zorder=1)
        axes.annotate("copy: the same columns read and written, nothing computed", (0.995, roof), color=theme.color("soft"),
                      xycoords=axes.get_yaxis_transform(), xytext=(0, -4), textcoords="offset points",
                      ha="right", va="top", fontsize=8)

    labels = []
    lines = [[(error, min(speeds)), (error, speed)] for error, speed in front]
    for row, (error, speed), easy, rival in zip(rows, points, typical, rivals):
        ours = data.is_ours(row.speed.operation)
        role = "accent" if ours else "peer"
        marker = MARKERS[warps.index(row.speed.warp) % len(MARKERS)] if ours else "X"
        on_front = (error, speed) in front
        axes.plot([easy, error], [speed, speed], color=theme.color(role), lw=0.8, alpha=0.45, zorder=1)
        axes.plot(easy, speed, "|", color=theme.color(role), ms=6, mew=1.2, alpha=0.8, zorder=2)
        axes.plot(error, speed, marker, ms=7.5 if ours else 6.5, mfc=theme.color(role if rival else "panel"), mew=1.6 if on_front else 0.8, zorder=3,
                  mec=theme.color("front" if on_front else "panel" if rival else role))
        labels.append(Label(label_of(data, row), error, speed, role, bold=on_front))
        lines.append([(easy, speed), (error, speed)])
    for index, warp in enumerate(warps):
        mine = sorted((s, e) for row, (e, s) in zip(rows, points)
                      if data.is_ours(row.speed.operation) and row.speed.warp == warp)
        lines.append([(e, s) for s, e in mine])
        axes.plot([e for _, e in mine], [s for s, _ in mine], color=theme.color("accent"), lw=0.8, alpha=0.5, zorder=2)
        axes.plot([], [], MARKERS[index % len(MARKERS)], color=theme.color("accent"), ms=7, label=f"vndf, {nice(warp)}")
    axes.plot([], [], "X", color=theme.color("peer"), ms=6.5, label="peers")
    axes.plot([], [], color=theme.color("front"), lw=5, alpha=0.3, label="Pareto front: nothing is both faster and closer")

    log_axis(axes.xaxis, axes.get_xlim()[0], 2 / EPS)
    log_axis(axes.yaxis, *axes.get_ylim(), steps=(1, 2, 5))
    axes.set_xlabel("largest error over the hard cases, in units of 2⁻²⁴ (left is better); the tick on its left: over the typical case")
    axes.set_ylabel("million samples per second, one core (up is better)")
    distance = axes.secondary_xaxis("top", functions=(lambda eps: eps * EPS, lambda d: d / EPS))
    distance.xaxis.set_major_locator(FixedLocator([10.0**-k for k in range(8)]))
    distance.xaxis.set_major_formatter(FuncFormatter(lambda value, _: "1" if value > 0.5 else f"{value:.0e}".replace("e-0", "e−")))
    distance.xaxis.set_minor_locator(NullLocator())
    distance.set_xlabel("the same as a distance between unit vectors", fontsize=8)
    distance.spines["top"].set_visible(False)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=5, fontsize=8.2, handletextpad=0.4, columnspacing=1.4)
    figure.subplots_adjust(left=0.075, right=0.985, top=0.9, bottom=0.17)
    place_labels(axes, labels, lines)
    return theme.to_svg(figure, f"Speed of {nice(operation)} and of its peers against the largest error over all hard cases")


# --- Throughput against batch size ---------------------------------------------------------------------------------


def throughput(data: Measurements, operation: str, source: str) -> Optional[str]:
    mine = [s for s in data.speeds if s.operation == operation and s.input == source]
    warps, isas = unique(s.warp for s in mine), unique(s.isa for s in mine)
    counts = sorted({s.count for s in mine})
    if len(counts) < 2:
        return None
    figure, panels = plt.subplots(1, len(warps), figsize=(9, 3.7), sharey=True, squeeze=False)
    for axes, warp in zip(panels[0], warps):
        axes.set_xscale("log", base=2)
        axes.set_yscale("log")
        axes.set_title(f"{nice(operation)}, {nice(warp)}")
        draw_line(axes, roofline_by_count(data, operation), "soft", "copy", dashed=True)
        listing = [s for s in data.speeds if (s.operation, s.warp, s.isa) == LISTING and s.input == source]
        if data.peer_operation == operation:
            draw_line(axes, {s.count: s.msamples for s in listing}, "peer", "paper listing")
        for index, isa in enumerate(isas):
            series = {s.count: s.msamples for s in mine if s.warp == warp and s.isa == isa}
            draw_line(axes, series, f"seq{index % 6}", nice(isa))
        axes.xaxis.set_major_locator(FixedLocator(counts))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: binary(value)))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.tick_params(axis="x", labelrotation=45)
        axes.set_xlabel("samples per call")
    low, high = panels[0][0].get_ylim()
    log_axis(panels[0][0].yaxis, low, high, steps=(1, 2, 5))
    panels[0][0].set_ylabel("million samples per second")
    handles, names = panels[0][0].get_legend_handles_labels()
    figure.legend(handles[::-1], names[::-1], loc="lower center", ncol=len(names), fontsize=8.5)
    figure.subplots_adjust(left=0.07, right=0.99, top=0.92, bottom=0.3, wspace=0.08)
    return theme.to_svg(figure, f"Throughput of {nice(operation)} against batch size")


def binary(count: float) -> str:
    for limit, unit in ((1 << 20, " Mi"), (1 << 10, " Ki")):
        if count >= limit:
            return f"{count / limit:g}{unit}"
    return f"{count:g}"


def roofline_by_count(data: Measurements, operation: str) -> dict[int, float]:
    """Million samples per second of the copy of the operation's columns."""
    traffic = next((s.bytes for s in data.speeds if s.operation == operation), None)
    times = {count: copy_ns(data, operation, traffic, count) for count in sorted({s.count for s in data.speeds})}
    return {count: 1e3 / ns for count, ns in times.items() if ns}


def draw_line(axes: Axes, series: dict[int, float], role: str, label: str, dashed: bool = False) -> None:
    if series:
        counts = sorted(series)
        axes.plot(counts, [series[count] for count in counts], color=theme.color(role), label=label, lw=1.6,
                  ls=(0, (4, 3)) if dashed else "-", marker="" if dashed else "o", ms=3.5)


# --- Error per hard case -------------------------------------------------------------------------------------------


def error_per_case(data: Measurements, operation: str) -> Optional[str]:
    mine = [e for e in data.errors if e.implementation == operation]
    cases = unique(e.row for e in mine if not e.undefined)
    if not cases:
        return None
    series = [(operation, warp, f"vndf, {nice(warp)}", f"cat{index}") for index, warp in enumerate(unique(e.warp for e in mine))]
    scalar_peers = [e for e in data.errors if e.isa == "scalar" and e.warp in {e.warp for e in mine}]
    if operation == data.peer_operation:
        for index, (name, warp) in enumerate(unique((e.implementation, e.warp) for e in scalar_peers)):
            series.append((name, warp, nice(name), ("peer", "cat3")[index % 2]))
    rows = [([e for e in data.errors if (e.implementation, e.warp) == (name, warp)], label, role)
            for name, warp, label, role in series]
    return case_figure(cases, rows, f"Error of {nice(operation)} in every hard case")


def case_figure(cases: list[str], series: list[tuple[list[ErrorRow], str, str]], description: str,
                largest: float = 9e7) -> str:
    """One line per case and series (rows, name in the legend if any, colour), from the mean to the maximum with a tick at
    p99.9."""
    figure, axes = plt.subplots(figsize=(9, 1.3 + 0.115 * len(cases) * (len(series) + 1.2)))
    axes.set_xscale("log")
    step = 1 / (len(series) + 1.2)
    for index, (rows, label, role) in enumerate(series):
        for row in rows:
            if row.row in cases:
                draw_case(axes, row, cases.index(row.row) + (index - (len(series) - 1) / 2) * step, role)
        if label:
            axes.plot([], [], "o-", color=theme.color(role), ms=4.5, lw=1.2, label=label)
    axes.set_yticks(range(len(cases)), [nice(case) for case in cases])
    axes.tick_params(axis="y", length=0, labelcolor=theme.color("ink"))
    axes.set_ylim(len(cases) - 0.4, -0.6)
    axes.grid(axis="y", visible=False)
    for index in range(0, len(cases), 2):
        axes.axhspan(index - 0.5, index + 0.5, color=theme.color("line"), alpha=0.22, lw=0)
    axes.set_xlim(0.08, largest)
    log_axis(axes.xaxis, *axes.get_xlim())
    axes.set_xlabel("error in units of 2⁻²⁴: line from the mean, tick at p99.9, dot at the maximum (left is better)")
    figure.legend(loc="upper right", ncol=sum(bool(label) for _, label, _ in series), fontsize=8.5, bbox_to_anchor=(0.99, 1.0))
    height = figure.get_size_inches()[1]
    figure.subplots_adjust(left=0.27, right=0.985, top=1 - 0.38 / height, bottom=0.5 / height)
    return theme.to_svg(figure, description)


def draw_case(axes: Axes, row: ErrorRow, y: float, role: str) -> None:
    color = theme.color(role)
    low = 0.1
    mean, p999, worst = (max(or_worst(value), low) for value in (row.mean_eps, row.p999_eps, row.max_eps))
    axes.plot([mean, worst], [y, y], color=color, lw=1.2, alpha=0.8, solid_capstyle="butt")
    axes.plot([p999], [y], "|", color=color, ms=5, mew=1.2)
    hollow = row.max_eps is None
    axes.plot([worst], [y], "o", mec=color, mfc=theme.color("panel") if hollow else color, ms=4.5, mew=1)


# --- The warped square ---------------------------------------------------------------------------------------------


def warped_square(warps: dict[str, Any], kind: str) -> str:
    """One row per map, one column per view angle: `checker` cells or `points`, in slope space."""
    maps, angles = unique(m["map"] for m in warps["maps"]), unique(m["degrees"] for m in warps["maps"])
    figure, panels = plt.subplots(len(maps), len(angles), figsize=(9, 9 / len(angles) * len(maps) + 0.2), squeeze=False)
    for entry in warps["maps"]:
        row, column = maps.index(entry["map"]), angles.index(entry["degrees"])
        axes = panels[row][column]
        if kind == "checker":
            draw_checker(axes, entry["checker"], f"cat{row % 5}")
        else:
            draw_points(axes, entry["points"], f"cat{row % 5}")
        frame_slopes(axes, window_of(warps, entry["degrees"]))
        if row == 0:
            axes.set_title(f"{entry['degrees']:g}° from the normal", fontsize=9, fontweight="normal", loc="center", pad=5)
        if column == 0:
            axes.set_ylabel(nice(entry["map"]), color=theme.color("ink"), fontsize=9, fontweight="bold")
    height = figure.get_size_inches()[1]
    figure.subplots_adjust(left=0.035, right=0.995, top=1 - 0.26 / height, bottom=0.05 / height, wspace=0.04, hspace=0.04)
    return theme.to_svg(figure, f"The unit square's {kind} warped into slope space by each map at several view angles")


def window_of(warps: dict[str, Any], degrees: float) -> tuple[float, float, float, float]:
    """A square that shows most points: slopes have no bound."""
    points = [point for entry in warps["maps"] if entry["degrees"] == degrees for point in entry["points"]]
    ranges = []
    for axis in (0, 1):
        values = sorted(point[axis] for point in points)
        ranges.append((values[len(values) // 14], values[-len(values) // 14]))
    half = max(high - low for low, high in ranges) / 2 * 1.1
    (x0, x1), (y0, y1) = ranges
    return (x0 + x1) / 2 - half, (x0 + x1) / 2 + half, (y0 + y1) / 2 - half, (y0 + y1) / 2 + half


def frame_slopes(axes: Axes, window: tuple[float, float, float, float]) -> None:
    x0, x1, y0, y1 = window
    axes.set_xlim(x0, x1)
    axes.set_ylim(y0, y1)
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xticks([])
    axes.set_yticks([])
    for spine in axes.spines.values():
        spine.set_visible(True)
    for position in (axes.axhline, axes.axvline):
        position(0, color=theme.color("line"), lw=0.6, zorder=0)


def draw_checker(axes: Axes, cells: list[list[list[float]]], role: str) -> None:
    vertices: list[list[float]] = []
    codes: list[int] = []
    for cell in cells:
        vertices += [*cell, cell[0]]
        codes += [Outline.MOVETO, *[Outline.LINETO] * (len(cell) - 1), Outline.CLOSEPOLY]
    axes.add_patch(PathPatch(Outline(vertices, codes), fc=theme.color(role), alpha=0.75, lw=0))


def draw_points(axes: Axes, points: list[list[float]], role: str) -> None:
    """Dots as one path of lines without length and round ends: a tenth of the size of as many markers."""
    vertices = [vertex for point in points for vertex in (point, point)]
    codes = [Outline.MOVETO, Outline.LINETO] * len(points)
    axes.add_patch(PathPatch(Outline(vertices, codes), fc="none", ec=theme.color(role), lw=2, capstyle="round"))


def read_warps(path: Path) -> dict[str, Any]:
    return json.loads(path.read_text())


# --- All of them ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Figures:
    speed_against_error: list[str]
    throughput: list[str]
    error_per_case: list[str]
    checker: Optional[str]
    points: Optional[str]


def draw(data: Measurements, warps: dict[str, Any], source: str, count: int) -> Figures:
    """One figure per operation where there is data for it, that with the peers first."""
    operations = unique(speed.operation for speed in data.speeds if data.is_ours(speed.operation))
    operations.sort(key=lambda operation: operation != data.peer_operation)

    measured = {row.implementation for row in data.errors}

    def each(make: Callable[[str], Optional[str]]) -> list[str]:
        return [svg for operation in operations if (svg := make(operation))]

    return Figures(
        speed_against_error=each(lambda operation: speed_against_error(data, operation, source, count)),
        throughput=each(lambda operation: throughput(data, operation, source) if operation in measured else None),
        error_per_case=each(lambda operation: error_per_case(data, operation)),
        checker=warped_square(warps, "checker"),
        points=warped_square(warps, "points"),
    )

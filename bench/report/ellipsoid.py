"""The ellipsoid NDF: its cost and its errors beside plain GGX, what rejection would cost, and its densities."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Optional

import page
import theme
from plots import case_figure, nice
from results import ELLIPSOIDS, ErrorRow, Measurements, error_row, plain_of, unique

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import PowerNorm
from matplotlib.ticker import FixedLocator, FuncFormatter


@dataclass(frozen=True)
class Setting:
    """An ellipsoid and a view."""

    name: str
    alpha: tuple[float, float]
    theta: tuple[float, float, float]
    degrees: float  # of the view from the normal
    phi: float  # of the view from x, in degrees


@dataclass(frozen=True)
class Ellipsoids:
    """What vndf_ellipsoid wrote."""

    errors: list[ErrorRow]  # of "ellipsoid" and of "plain"
    row_notes: dict[str, str]
    rejections: list[tuple[Setting, list[float]]]  # the shares that versions 1, 2 and 3 reject
    densities: list[tuple[Setting, np.ndarray]]  # over the disk seen from above, rows of y upwards, NaN outside


@dataclass(frozen=True)
class Cost:
    """Nanoseconds per sample of one operation with plain GGX and with each kind of ellipsoid."""

    operation: str
    warp: str
    isa: str
    plain_ns: float
    ellipsoid_ns: dict[str, float]


def read(path: Path) -> Ellipsoids:
    document = json.loads(path.read_text())

    def setting(entry: dict[str, Any]) -> Setting:
        return Setting(entry["name"], tuple(entry["alpha"]), tuple(entry["theta"]), entry["degrees"], entry["phi"])

    return Ellipsoids(
        errors=[error_row(row) for row in document["errors"]],
        row_notes=document["row_notes"],
        rejections=[(setting(entry), entry["rejected"]) for entry in document["rejections"]],
        densities=[(setting(entry), np.array(entry["pdf"], dtype=float)) for entry in document["densities"]],
    )


def costs(data: Measurements, source: str, count: int) -> list[Cost]:
    """Every operation that was measured both ways, in the order of the instruction sets, slowest first."""
    speeds = {(s.operation, s.warp, s.isa): s.ns for s in data.speeds if (s.input, s.count) == (source, count)}
    operations = unique(plain for operation, _, _ in speeds if (plain := plain_of(operation)))
    found = []
    for (operation, warp, isa), ns in speeds.items():
        kinds = {kind: speeds.get((f"{operation}_{kind}", warp, isa)) for kind in ELLIPSOIDS}
        if operation in operations and None not in kinds.values():
            found.append(Cost(operation, warp, isa, ns, kinds))
    isas = unique(cost.isa for cost in found)
    warps = unique(cost.warp for cost in found)
    return sorted(found, key=lambda c: (operations.index(c.operation), warps.index(c.warp), isas.index(c.isa)))


def summary(ellipsoids: Ellipsoids, found: list[Cost]) -> dict[str, Any]:
    """For report.json. The densities' grids stay in the file that they came in."""
    return {
        "costs": [asdict(cost) for cost in found],
        "errors": [asdict(row) for row in ellipsoids.errors],
        "rejections": [{**asdict(setting), "rejected": shares} for setting, shares in ellipsoids.rejections],
        "densities": [asdict(setting) for setting, _ in ellipsoids.densities],
    }


# --- Tables --------------------------------------------------------------------------------------------------------


def cost_table(found: list[Cost]) -> str:
    head = ["", "warp", "set", "plain GGX, M/s"]
    for words in ELLIPSOIDS.values():
        head += [f"{words}, M/s", "× time"]
    rows = []
    previous = None
    for cost in found:
        cells = [page.text(nice(word)) for word in (cost.operation, cost.warp, cost.isa)]
        cells.append(page.number(1e3 / cost.plain_ns))
        for kind in ELLIPSOIDS:
            ns = cost.ellipsoid_ns[kind]
            cells += [page.number(1e3 / ns), f"{ns / cost.plain_ns:.2f}×"]
        group = (cost.operation, cost.warp)
        rows.append(("break" if previous not in (None, group) else "", cells))
        previous = group
    return page.table(head, rows, words=3)


def error_table(ellipsoids: Ellipsoids) -> str:
    plain = {(e.row, e.warp): e for e in ellipsoids.errors if e.implementation == "plain"}
    rows = []
    for e in (e for e in ellipsoids.errors if e.implementation == "ellipsoid"):
        other = plain[e.row, e.warp]
        numbers = [e.mean_eps, e.p999_eps, e.max_eps, other.mean_eps, other.p999_eps, other.max_eps]
        rows.append(("", [page.text(nice(e.row)), page.text(nice(e.warp)), *map(page.error_number, numbers),
                          page.grouped(e.samples), page.text(ellipsoids.row_notes[e.row]),
                          f"<span class=bits>{page.text(e.worst_input)}</span>"]))
    head = ["case", "warp", "mean ε", "p99.9 ε", "max ε", "plain: mean ε", "p99.9 ε", "max ε", "samples", "inputs",
            "worst input"]
    return page.table(head, rows, words=2)


def rejection_table(ellipsoids: Ellipsoids) -> str:
    rows = []
    for setting, shares in ellipsoids.rejections:
        angles = ", ".join(f"{angle:g}" for angle in setting.theta) if any(setting.theta) else "0"
        rows.append(("", [page.text(setting.name), f"{setting.alpha[0]:g}, {setting.alpha[1]:g}", angles,
                          f"{setting.degrees:g}°, {setting.phi:g}°", *(f"{100 * share:.1f} %" for share in shares)]))
    head = ["", "α", "θ of x, y, z", "view: θ, φ", "version 1", "version 2", "version 3"]
    return page.table(head, rows)


# --- Figures -------------------------------------------------------------------------------------------------------


def error_figure(ellipsoids: Ellipsoids) -> str:
    """The ellipsoid's line of a warp, and the plain one beside it."""
    series = []
    for index, warp in enumerate(unique(e.warp for e in ellipsoids.errors)):
        rows = {kind: [e for e in ellipsoids.errors if (e.implementation, e.warp) == (kind, warp)]
                for kind in ("ellipsoid", "plain")}
        series.append((rows["ellipsoid"], f"ellipsoid, {nice(warp)}", f"cat{index}"))
        series.append((rows["plain"], "" if index else "plain GGX, the same warp", "soft"))
    cases = unique(e.row for e in ellipsoids.errors)
    return case_figure(cases, series, "Error of the ellipsoid NDF beside plain GGX")


def view_of(setting: Setting) -> np.ndarray:
    theta, phi = math.radians(setting.degrees), math.radians(setting.phi)
    return np.array([math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)])


def draw_density(axes: Axes, setting: Setting, pdf: np.ndarray, norm: PowerNorm) -> Any:
    # Drawn where there are visible normals; "none" keeps the pixels as they are, for the reader's own scale.
    image = axes.imshow(np.ma.masked_where(~(pdf > 0), pdf), origin="lower", extent=(-1, 1, -1, 1), cmap="viridis",
                        norm=norm, interpolation="none")
    turn = np.linspace(0, 2 * math.pi, 181)
    axes.plot(np.cos(turn), np.sin(turn), color=theme.color("soft"), lw=1)
    theta, phi = math.radians(setting.degrees), math.radians(setting.phi)
    # The half of the circle of normals perpendicular to the view that is above the horizon.
    half = turn[:91]
    level, steep = np.cos(half), np.sin(half) * math.cos(theta)
    axes.plot(-level * math.sin(phi) - steep * math.cos(phi), level * math.cos(phi) - steep * math.sin(phi),
              color=theme.color("soft"), lw=1.2, ls=(0, (3, 2)))
    x, y, _ = view_of(setting)
    for at, word, shift in (((0, 0), "n", (6, -9)), ((x, y), "view", (0, 9) if x > y else (24, 0))):
        axes.plot(*at, "o", ms=5, mfc=theme.color("panel"), mec=theme.color("ink"), mew=1.1)
        axes.annotate(word, at, xytext=shift, textcoords="offset points", ha="right" if word == "view" else "left",
                      va="center_baseline", fontsize=8.5, gid=theme.HALO)
    alpha = " / ".join(f"{a:g}" for a in setting.alpha)
    lean = f"θ = ({', '.join(f'{t:g}' for t in setting.theta)})" if any(setting.theta) else "upright: θ = 0"
    axes.set_title(f"α {alpha}, view φ = {setting.phi:g}°", fontsize=9, loc="center", pad=18)
    axes.text(0.5, 1.03, lean, transform=axes.transAxes, ha="center", va="bottom", fontsize=8,
              color=theme.color("soft"))
    axes.set_xlim(-1.04, 1.04)
    axes.set_ylim(-1.04, 1.04)
    axes.set_axis_off()
    return image


def density_figure(ellipsoids: Ellipsoids) -> Optional[str]:
    if not ellipsoids.densities:
        return None
    count = len(ellipsoids.densities)
    figure, panels = plt.subplots(1, count, figsize=(9, 3.35), squeeze=False)
    largest = max(np.nanmax(pdf) for _, pdf in ellipsoids.densities)
    norm = PowerNorm(0.5, vmin=0, vmax=largest)
    for axes, (setting, pdf) in zip(panels[0], ellipsoids.densities):
        image = draw_density(axes, setting, pdf, norm)
    figure.subplots_adjust(left=0.01, right=0.925, top=0.84, bottom=0.02, wspace=0.06)
    scale = figure.add_axes((0.94, 0.08, 0.014, 0.7))
    bar = figure.colorbar(image, cax=scale)
    bar.outline.set_visible(False)
    scale.yaxis.set_major_locator(FixedLocator([tick for tick in (0, 0.1, 0.5, 1, 2, 4, 6, 8, 12, 16) if tick <= largest]))
    scale.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    scale.minorticks_off()
    scale.set_title("density", fontsize=8, fontweight="normal", loc="center", pad=6)
    return theme.to_svg(figure, "Density of visible normals over the hemisphere for three ellipsoids")


# --- The section ---------------------------------------------------------------------------------------------------


def section(ellipsoids: Ellipsoids, found: list[Cost], source: str, count: int) -> str:
    kinds = ("With <i>five constants</i> one ellipsoid serves the whole batch; with <i>θz per lane</i> each sample brings its own "
             "roughness and the turn of its axes, as from a texture of brushed metal; with <i>five columns</i> each has an ellipsoid "
             "of its own, whose matrix is worked out on the spot.")
    return f"""
<h2>The ellipsoid NDF</h2>
<p>GGX is the distribution of the normals of an ellipsoid that stands upright: two roughnesses α stretch it along x and y.
Walter et al. 2015 let it turn about the surface normal (θz) and lean (θx, θy), for brushed metal whose scratches run anywhere and
for surfaces with one slope steeper than the other. With all angles 0 it is plain GGX.</p>
{page.figure(density_figure(ellipsoids), "How likely each normal is to be seen, per unit solid angle, for a view "
             f"{ellipsoids.densities[0][0].degrees:g}° from the surface normal n; the hemisphere of normals as seen from "
             "above, x to the right. The white dots are n, in the middle, and the view, near the rim. Left and middle, the "
             "same rough surface from two sides: where the view goes along x, the direction of the small roughness, the normals stay near "
             "n; where it goes along y, they are drawn out towards the view. Right, an ellipsoid that leans and is turned: the crest "
             "no longer passes through n. Beyond the dashed line normals face away from the viewer. One colour scale for all, by the "
             "square root of the density, so that tails show.") if ellipsoids.densities else ""}
<h3>What it costs</h3>
<p>Speed beside plain GGX of the same warp and instruction set, {page.text(source)} input, {page.grouped(count)} samples a call; “× time” is
the time per sample in units of plain GGX's, so less than 1 is faster. {kinds} Plain GGX reads two columns of roughness, so that constants
save it memory traffic, too. Reflection with ellipsoids masks and shadows separately, as Walter et al. do; plain GGX here does it
height-correlated, its default.</p>
{cost_table(found)}

<h3>What it costs in digits</h3>
{page.figure(error_figure(ellipsoids), "Errors of the ellipsoid's normals against Walter's formulas in quadruple precision, and, in "
             "grey, of plain GGX on the same views, roughnesses and random numbers with all angles 0, against its own. Line from "
             "the mean, tick at the 99.9th percentile, dot at the largest, in ε = 2⁻²⁴. The ellipsoids lean by up to half a radian in "
             "θx and θy, in the rows named “any angle” by up to half a turn. Where an ellipsoid leans away from the view, sums "
             "cancel that plain GGX does not have.")}
<details><summary>Errors in numbers</summary>{error_table(ellipsoids)}</details>

<h3>Why nothing is rejected</h3>
<p>Walter et al. give three ways to draw a visible normal. Version 1 shoots rays at the ellipsoid from a sphere around it and
version 2 from the ellipsoid's own outline; both try again when the point they find is not visible. Version 3, which this library
computes, draws points of the visible part alone. The table shows how many tries the first two throw away, counted by running them: in a SIMD
register a single rejected lane makes all others wait, and each sample would use up an unknown number of random numbers.</p>
{rejection_table(ellipsoids)}
"""

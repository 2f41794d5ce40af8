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
from results import ELLIPSOIDS, ErrorRow, Measurements, error_row, or_worst, plain_of, unique

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import PowerNorm
from matplotlib.patches import Circle, PathPatch
from matplotlib.path import Path as Outline
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
        rows.append(("", [page.text(setting.name), f"{setting.alpha[0]:g}, {setting.alpha[1]:g}", angles(setting),
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
    largest = 30 * max(or_worst(e.max_eps) for e in ellipsoids.errors)
    return case_figure(cases, series, "Error of the ellipsoid NDF beside plain GGX", largest)


def view_from_above(setting: Setting) -> tuple[float, float]:
    sin, phi = math.sin(math.radians(setting.degrees)), math.radians(setting.phi)
    return sin * math.cos(phi), sin * math.sin(phi)


def angles(setting: Setting) -> str:
    return "(" + ", ".join(f"{angle:g}".replace("-", "−") for angle in setting.theta) + ")" if any(setting.theta) else "0"


def outline(degrees: float, phi: float) -> tuple[np.ndarray, np.ndarray]:
    """Where normals cease to be visible, from above: perpendicular to the view, and the horizon on the view's side."""
    theta, azimuth = math.radians(degrees), math.radians(phi)
    t = np.linspace(0, math.pi, 121)
    level, steep = np.cos(t), -np.sin(t) * math.cos(theta)
    across = np.array([level * -math.sin(azimuth) + steep * math.cos(azimuth),
                       level * math.cos(azimuth) + steep * math.sin(azimuth)])
    return across, np.array([np.cos(t + azimuth - math.pi / 2), np.sin(t + azimuth - math.pi / 2)])


def draw_density(axes: Axes, setting: Setting, pdf: np.ndarray, norm: PowerNorm) -> Any:
    # "none" keeps the pixels as they are, for the scale at which they are read.
    image = axes.imshow(np.nan_to_num(pdf), origin="lower", extent=(-1, 1, -1, 1), cmap="viridis", norm=norm,
                        interpolation="none")
    across, horizon = outline(setting.degrees, setting.phi)
    visible = np.concatenate([across, horizon], axis=1)
    image.set_clip_path(PathPatch(Outline(visible.T, closed=False), transform=axes.transData))
    axes.add_patch(Circle((0, 0), 1, fc="none", ec=theme.color("soft"), lw=1))
    axes.plot(*across, color=theme.color("peer"), lw=1.3, ls=(0, (4, 2)))
    for at, word, shift in (((0, 0), "n", (6, -9)), (view_from_above(setting), "view", (-7, -9))):
        axes.plot(*at, "o", ms=5, mfc=theme.color("panel"), mec=theme.color("ink"), mew=1.1)
        axes.annotate(word, at, xytext=shift, textcoords="offset points", ha="right" if word == "view" else "left",
                      va="center_baseline", fontsize=8.5, gid=theme.HALO)
    alpha = " / ".join(f"{a:g}" for a in setting.alpha)
    axes.set_title(f"α {alpha}, view φ = {setting.phi:g}°", fontsize=9, loc="center", pad=18)
    axes.text(0.5, 1.03, f"θ = {angles(setting)}", transform=axes.transAxes, ha="center", va="bottom",
              fontsize=8, color=theme.color("soft"))
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


DENSITY_CAPTION = (
    "How likely each normal is among those that the viewer sees, per unit solid angle: the hemisphere of normals from "
    "above, x to the right and y up, with the surface normal n in the middle and the view 75° from it, near the rim. "
    "Beyond the dashed line normals face away from the viewer. On the left and in the middle the surface is the same, "
    "smoother along x than along y: seen along x, the bright spot lies across the line of sight; seen along y, it "
    "stretches towards the view. On the right the ellipsoid leans and is turned, and the brightest normals lie far "
    "from n. One colour scale for all, by the square root of the density, so that faint parts show."
)
ERROR_CAPTION = (
    "Distances of the ellipsoid's normals from Walter's formulas in quadruple precision, and, in grey below each, "
    "those of plain GGX for the same views, roughnesses and random numbers from its own exact normals. Ellipsoids "
    "lean by up to half a radian in θx and in θy, in the rows named “any angle” by up to half a turn, and turn by any "
    "θz; the rows named “turned” have θz alone."
)


def section(ellipsoids: Ellipsoids, found: list[Cost], source: str, count: int) -> str:
    """The HTML of it, for readers who do not know the paper."""
    return f"""
<h2>The ellipsoid NDF</h2>
<p>The normals of plain GGX are those of an ellipsoid that stands upright; the two roughnesses α make it longer or
shorter along x and y. Walter et al. 2015 let it turn about the surface normal by θz, as for brushed metal whose
scratches run anywhere, and lean by θx and θy, as for shingles, whose slopes are steeper on one side. With all angles
0 it is plain GGX.</p>
{page.figure(density_figure(ellipsoids), DENSITY_CAPTION)}
<h3>What it costs</h3>
<p>Speed beside plain GGX of the same warp and instruction set, {page.text(source)} input, {page.grouped(count)}
samples a call. “× time” is the time of a sample in units of plain GGX's: below 1 is faster. With <i>five
constants</i> one ellipsoid serves the whole batch; with <i>θz per lane</i> every sample brings roughness and the turn
of its axes, as from a texture; with <i>five columns</i> every sample has an ellipsoid of its own, whose matrix is
worked out on the spot. Reflection with ellipsoids takes masking and shadowing as independent, as Walter et al. do;
plain GGX here takes them as height-correlated, its default.</p>
{cost_table(found)}
<h3>What it costs in digits</h3>
{page.figure(error_figure(ellipsoids), ERROR_CAPTION)}
<details><summary>Errors in numbers</summary>{error_table(ellipsoids)}</details>

<h3>Why nothing is rejected</h3>
<p>Walter et al. give three ways to draw a visible normal. Version 1 shoots rays at the ellipsoid out of a sphere
around it, version 2 takes points of the ellipsoid's own outline; both try again when what they hit is not visible.
Version 3, which this library computes, draws points of the visible part alone. The table tells the share of tries
that each throws away, counted by running the first two. In a SIMD register one lane that has to try again makes all
others wait, and every try uses up random numbers that were chosen to be well spread: hence version 3.</p>
{rejection_table(ellipsoids)}
"""

"""The figures of the ellipsoid NDF."""

import math

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import PowerNorm
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Circle, PathPatch
from matplotlib.path import Path
from matplotlib.ticker import FixedLocator, NullLocator, StrMethodFormatter

from plots import DASHES, OF_WARPS, PEER, dots, error_per_case, legend_above, style
from tables import ELLIPSOIDS, WORST_EPS
from words import angles, nice


def costs(table: pd.DataFrame) -> Figure:
    """Times in units of plain GGX's, a panel for each kind of ellipsoid."""
    height = 1.3 + 0.26 * table.group.nunique()
    figure, panels = plt.subplots(1, len(ELLIPSOIDS), figsize=(9, height), sharex=True, sharey=True)
    for axes, (kind, words) in zip(panels, ELLIPSOIDS.items()):
        dots(axes, table, kind + "_ratio")
        axes.axvline(1, color=style("axes.labelcolor"), lw=1, ls=DASHES, zorder=1)
        axes.xaxis.set_major_locator(FixedLocator([0.5, 1, 2, 5, 10, 20]))
        axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}×"))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.set_title(words, loc="center", fontsize=9)
    panels[1].set_xlabel("time of a sample in units of plain GGX's (left is better)")
    legend_above(figure, panels[0])
    figure.subplots_adjust(top=1 - 0.6 / height, wspace=0.06)
    return figure


def errors(table: pd.DataFrame) -> Figure:
    """The ellipsoid's line of each warp, and below it that of plain GGX."""
    series = []
    for color, (warp, rows) in zip(OF_WARPS, table.groupby("warp", sort=False)):
        series.append((rows[rows.operation == "ellipsoid"], f"ellipsoid, {nice(warp)}", color))
        legend = "" if len(series) > 1 else "plain GGX, the same warp"
        series.append((rows[rows.operation == "plain"], legend, "soft"))
    return error_per_case(series, 30 * table.max_eps.clip(upper=WORST_EPS).max())


def outline(degrees: float, phi: float) -> tuple[np.ndarray, np.ndarray]:
    """Where normals cease to be visible, from above: across the view, and the horizon on its side."""
    theta, azimuth = math.radians(degrees), math.radians(phi)
    t = np.linspace(0, math.pi, 121)
    level, steep = np.cos(t), -np.sin(t) * math.cos(theta)
    across = np.array(
        [
            level * -math.sin(azimuth) + steep * math.cos(azimuth),
            level * math.cos(azimuth) + steep * math.sin(azimuth),
        ]
    )
    return across, np.array([np.cos(t + azimuth - math.pi / 2), np.sin(t + azimuth - math.pi / 2)])


def draw_density(axes: Axes, setting: pd.Series, norm: PowerNorm) -> AxesImage:
    # "none" keeps the pixels as they are, for the scale at which they are read.
    image = axes.imshow(
        np.nan_to_num(setting.pdf), origin="lower", extent=(-1, 1, -1, 1), norm=norm, interpolation="none"
    )
    across, horizon = outline(setting.degrees, setting.phi)
    visible = Path(np.concatenate([across, horizon], axis=1).T)
    image.set_clip_path(PathPatch(visible, transform=axes.transData))
    axes.add_patch(Circle((0, 0), 1, fc="none", ec=style("axes.labelcolor"), lw=1))
    axes.plot(*across, color=PEER, lw=1.3, ls=(0, (4, 2)))
    height, azimuth = math.sin(math.radians(setting.degrees)), math.radians(setting.phi)
    view = height * math.cos(azimuth), height * math.sin(azimuth)
    for at, word, shift, side in (((0, 0), "n", (6, -9), "left"), (view, "view", (-7, -9), "right")):
        axes.plot(*at, "o", ms=5, mfc=style("axes.facecolor"), mec=style("text.color"), mew=1.1)
        axes.annotate(
            word,
            at,
            xytext=shift,
            textcoords="offset points",
            ha=side,
            va="center",
            fontsize=8.5,
            bbox={"boxstyle": "round,pad=0.15", "fc": style("axes.facecolor"), "ec": "none", "alpha": 0.75},
        )
    axes.set_title(
        f"α {setting.alpha[0]:g} / {setting.alpha[1]:g}, view φ = {setting.phi:g}°",
        fontsize=9,
        loc="center",
        pad=18,
    )
    axes.text(
        0.5,
        1.03,
        f"θ = {angles(setting.theta)}",
        transform=axes.transAxes,
        ha="center",
        va="bottom",
        fontsize=8,
        color=style("axes.labelcolor"),
    )
    axes.set(xlim=(-1.04, 1.04), ylim=(-1.04, 1.04))
    axes.set_axis_off()
    return image


def densities(settings: pd.DataFrame) -> Figure:
    """The density of visible normals over the hemisphere, seen from above."""
    figure, panels = plt.subplots(1, len(settings), figsize=(9, 3.35), squeeze=False)
    largest = max(np.nanmax(pdf) for pdf in settings.pdf)
    norm = PowerNorm(0.5, vmin=0, vmax=largest)
    for axes, (_, setting) in zip(panels[0], settings.iterrows()):
        image = draw_density(axes, setting, norm)
    figure.subplots_adjust(left=0.01, right=0.925, top=0.84, bottom=0.02, wspace=0.06)
    scale = figure.add_axes((0.94, 0.08, 0.014, 0.7))
    bar = figure.colorbar(
        image, cax=scale, ticks=[tick for tick in (0, 0.1, 0.5, 1, 2, 4, 6, 8, 12, 16) if tick <= largest]
    )
    bar.outline.set_visible(False)
    scale.minorticks_off()
    scale.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    scale.set_title("density", fontsize=8, fontweight="normal", loc="center", pad=6)
    return figure

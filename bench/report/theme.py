"""Colours for light and dark, and matplotlib figures as small SVG that follows them.

Figures are drawn in marker colours, one per role. On export each becomes a CSS variable with the light colour before it,
for viewers without variables, so that one picture serves both modes, inside the page and as a file of its own.
"""

from __future__ import annotations

import io
import re

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

# role: (light, dark)
PALETTE = {
    "ink": ("#1f2328", "#e6edf3"),
    "soft": ("#656d76", "#9198a1"),
    "line": ("#d1d9e0", "#3d444d"),
    "panel": ("#ffffff", "#151b23"),
    "page": ("#fbfbfa", "#0d1117"),
    "accent": ("#0b62d6", "#6cb2ff"),
    "peer": ("#bc4c00", "#f0985a"),
    "front": ("#1a7f37", "#56d364"),
    # A sequence for instruction sets, slowest first.
    "seq0": ("#8c959f", "#7d8590"),
    "seq1": ("#1b8a8f", "#4cc9c4"),
    "seq2": ("#0b62d6", "#6cb2ff"),
    "seq3": ("#8250df", "#c297ff"),
    "seq4": ("#bf3989", "#f778ba"),
    "seq5": ("#bc4c00", "#f0985a"),
    # Categories for warps.
    "cat0": ("#0b62d6", "#6cb2ff"),
    "cat1": ("#8250df", "#c297ff"),
    "cat2": ("#1a7f37", "#56d364"),
    "cat3": ("#9a6700", "#e3b341"),
    "cat4": ("#bf3989", "#f778ba"),
}
MARK = {role: f"#f0f1{index:02x}" for index, role in enumerate(PALETTE)}
# Gives a text a rim of the ground's colour, so that lines behind it do not strike it out.
HALO = "halo"
FONT_STACK = "system-ui, -apple-system, 'Segoe UI', 'Helvetica Neue', Arial, sans-serif"


def color(role: str) -> str:
    """The colour to give matplotlib for a role."""
    return MARK[role]


def css_variables() -> str:
    """The palette as custom properties, dark where the reader asks for dark."""
    light = "".join(f"--{role}:{pair[0]};" for role, pair in PALETTE.items())
    dark = "".join(f"--{role}:{pair[1]};" for role, pair in PALETTE.items())
    return f":root{{{light}}}@media(prefers-color-scheme:dark){{:root{{{dark}}}}}"


def use() -> None:
    """Sets matplotlib's defaults for every figure of the report."""
    plt.rcParams.update(
        {
            # Real text, in the reader's own font; measured here with DejaVu Sans, which is wider than most.
            "svg.fonttype": "none",
            "svg.hashsalt": "vndf",
            "font.family": "DejaVu Sans",
            "font.size": 9,
            "axes.titlesize": 10,
            "axes.titleweight": "bold",
            "axes.titlelocation": "left",
            "axes.labelsize": 9,
            "axes.edgecolor": color("line"),
            "axes.labelcolor": color("soft"),
            "axes.facecolor": "none",
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.grid": True,
            "axes.axisbelow": True,
            "grid.color": color("line"),
            "grid.linewidth": 0.5,
            "xtick.color": color("line"),
            "ytick.color": color("line"),
            "xtick.labelcolor": color("soft"),
            "ytick.labelcolor": color("soft"),
            "text.color": color("ink"),
            "figure.facecolor": "none",
            "savefig.facecolor": "none",
            "legend.frameon": False,
            "path.simplify": False,
        }
    )


def to_svg(figure: Figure, label: str) -> str:
    """The figure as an <svg> element without prolog, metadata or fixed size, described by label."""
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    plt.close(figure)
    text = buffer.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.S)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r' id="(?!m|p|C)[a-zA-Z]+[A-Za-z0-9]*_\d+"', "", text)
    text = re.sub(r"'DejaVu Sans'[^;\"]*", FONT_STACK, text)
    text = re.sub(r"(\d+\.\d\d)\d+", r"\1", text)
    ground = PALETTE["panel"][0]
    rim = f"paint-order:stroke;stroke:{ground};stroke:var(--panel);stroke-width:3px;stroke-linejoin:round"
    text = text.replace(f'<g id="{HALO}">', f'<g style="{rim}">')
    for role, mark in MARK.items():
        light = PALETTE[role][0]
        text = re.sub(rf"(fill|stroke): ?{mark}", rf"\1:{light};\1:var(--{role})", text)
    text = re.sub(r"\n\s*\n+", "\n", text)
    head = re.search(r'viewBox="[^"]*"', text)
    body = text[text.index(">") + 1 :]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
        f'{head.group(0) if head else ""} role="img" aria-label="{label}">{body}'
    )


def standalone(svg: str) -> str:
    """The same picture as a file: it brings its colours and a ground of its own, so that it reads on any page."""
    box = re.search(r'viewBox="([^"]*)"', svg)
    width, height = box.group(1).split()[2:] if box else ("100%", "100%")
    light = PALETTE["panel"][0]
    start = svg.index(">") + 1
    ground = (
        f"<style>{css_variables()}</style>"
        f'<rect width="{width}" height="{height}" rx="8" style="fill:{light};fill:var(--panel)"/>'
    )
    return svg[:start] + ground + svg[start:]

"""The page: page.html.j2 filled in."""

import base64
from pathlib import Path
from typing import Any

import jinja2
import pandas as pd

import tables
import wavefront_plots
import words
from pictures import SAMPLED, colors
from words import nice, number, times


def key_figures(headline: pd.DataFrame) -> list[tuple[str, str]]:
    """The four numbers that a reader takes home, each with what it is."""
    ours = headline[headline.operation == SAMPLED]
    listing = headline[headline.operation == "paper_listing"].iloc[0]
    fastest, closest = ours.loc[ours.msamples.idxmax()], ours.loc[ours.max_eps.idxmin()]
    return [
        (
            f"{number(fastest.msamples)} M/s",
            f"samples on one core, {nice(fastest.warp)}, {nice(fastest.isa)}",
        ),
        (times(fastest.vs_listing), "the speed of the paper's listing"),
        (
            f"{number(closest.max_eps)} ε",
            f"largest error in any hard case, {nice(closest.warp)} ({nice(closest.worst_row)})",
        ),
        (
            f"{number(listing.shared_max_eps)} ε",
            f"largest error of the paper's listing, in its own domain ({nice(listing.shared_worst_row)})",
        ),
    ]


def data_uri(svg: str) -> str:
    return "data:image/svg+xml;base64," + base64.b64encode(svg.encode()).decode()


def render(
    results: pd.DataFrame,
    headline: pd.DataFrame,
    errors: pd.DataFrame,
    ellipsoid: dict[str, pd.DataFrame],
    figures: dict[str, Any],
    facts: dict[str, Any],
) -> str:
    loader = jinja2.FileSystemLoader(Path(__file__).parent)
    templates = jinja2.Environment(loader=loader, autoescape=True, trim_blocks=True, lstrip_blocks=True)
    templates.globals |= {name: write for name, write in vars(words).items() if callable(write)}
    templates.globals |= {"str": str, "data_uri": data_uri, "papers": words.PAPERS, "colors": colors()}
    templates.globals |= {"in_order": wavefront_plots.in_order}
    # Ellipsoids have a section of their own.
    plain = results[results["shape"] == "plain"]
    return templates.get_template("page.html.j2").render(
        facts,
        errors=errors,
        ellipsoid=ellipsoid,
        figures=figures,
        key_figures=key_figures(headline),
        input=headline.input.iloc[0],
        count=headline["count"].iloc[0],
        batches=list(plain.groupby(["input", "count", "threads"])),
        both_states=tables.alone_and_busy(plain),
        listed_peers=headline.operation[headline.kind == "peer"].unique(),
    )

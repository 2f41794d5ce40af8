"""The page: one HTML file with everything in it."""

from __future__ import annotations

import html
import math
from typing import Any, Iterable, Optional

import theme
from plots import Figures, grouped, nice
from results import LISTING, ROOFLINE, ErrorRow, Measurements, Result, plain_of, unique

STYLE = """
*{box-sizing:border-box}
html{color-scheme:light dark;-webkit-text-size-adjust:100%}
body{margin:0;background:var(--page);color:var(--ink);font:17px/1.6 FONTS}
main{max-width:1020px;margin:0 auto;padding:48px 24px 96px}
h1{font-size:2.1rem;line-height:1.15;letter-spacing:-.02em;margin:0 0 .4em}
h2{font-size:1.4rem;line-height:1.25;letter-spacing:-.01em;margin:3.2em 0 .5em}
h3{font-size:1.05rem;margin:2em 0 .4em}
p{max-width:46em;margin:.6em 0}
.lead{font-size:1.15rem;color:var(--soft)}
code,.bits{font:.88em ui-monospace,'SF Mono',Menlo,Consolas,monospace}
figure{margin:1.4em 0}
figure svg{display:block;width:100%;height:auto;background:var(--panel);border:1px solid var(--line);border-radius:8px}
figcaption{max-width:46em;margin-top:.8em}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.2em 1.4em;font-size:.92rem;margin:1.6em 0}
dt{color:var(--soft)}
dd{margin:0;overflow-wrap:anywhere}
.wide{overflow-x:auto;margin:1.2em calc(50% - min(50vw - 14px,620px))}
table{border-collapse:collapse;font-size:.84rem;line-height:1.45;font-variant-numeric:tabular-nums;min-width:100%}
th,td{padding:.28em .55em;text-align:right;white-space:nowrap;border-bottom:1px solid var(--line)}
th{color:var(--soft);font-weight:600;vertical-align:bottom}
th:first-child,td:first-child,.text{text-align:left}
tr.ours td:first-child{color:var(--accent);font-weight:600}
tr.break td{border-top:2px solid var(--line)}
details{margin:.35em 0}
summary{cursor:pointer;color:var(--accent)}
.key{display:grid;grid-template-columns:repeat(auto-fit,minmax(190px,1fr));gap:14px;margin:2em 0}
.key div{background:var(--panel);border:1px solid var(--line);border-radius:8px;padding:14px 16px}
.key b{display:block;font-size:1.7rem;line-height:1.2;letter-spacing:-.02em}
.key span{color:var(--soft);font-size:.88rem;line-height:1.4;display:block}
@media(max-width:640px){body{font-size:16px}main{padding:28px 14px 64px}dl{grid-template-columns:1fr}dt{margin-top:.5em}}
""".replace("FONTS", theme.FONT_STACK)

# What a peer is, for those who have not read its paper.
PEERS = {
    "paper_listing": "Heitz 2018, Listing 1, in plain float, as printed",
    "paper_listing_fast": "the same as a loop that compilers vectorise, with -ffast-math",
    "spherical_cap_listing": "Dupuy and Benyoub 2023, as published, in plain float",
    "heitz_2017": "Heitz 2017, the older parameterisation by two half disks; views above the horizon only",
    "heitz_deon_2014": "Heitz and d'Eon 2014, slope space with a fitted curve; views above the horizon only",
    "heitz_deon_2014_roots": "the same routine with square roots in place of the angle's sine and cosine",
    "ndf_walter_2007": "Walter et al. 2007: all normals, visible or not",
    "ispc_listing": "Heitz 2018, Listing 1, in ISPC, with its approximate reciprocal square root",
    "ispc_caps": "Dupuy and Benyoub 2023 in ISPC, with its approximate reciprocal square root",
}


def text(value: object) -> str:
    return html.escape(str(value))


def number(value: Optional[float], missing: str = "–") -> str:
    """Three significant digits, thousands apart, millions as M."""
    if value is None or math.isnan(value):
        return missing
    if abs(value) >= 1e6:
        return f"{number(value / 1e6)}\u202fM"
    if 0 < abs(value) < 1e-3:
        return f"{value:.1e}"
    digits = 0 if value == 0 else max(0, 2 - math.floor(math.log10(abs(value))))
    return f"{value:,.{min(digits, 3)}f}".replace(",", "\u202f")


def error_number(value: Optional[float]) -> str:
    return number(value, missing="NaN")


def share(value: Optional[float]) -> str:
    return "–" if value is None else f"{100 * value:.0f} %"


def ratio(value: Optional[float]) -> str:
    return "–" if value is None else f"{number(value)}×"


def table(head: list[str], rows: Iterable[tuple[str, list[str]]], words: int = 1) -> str:
    """Rows of (CSS class, cells that are HTML); the first `words` columns are words, the last one too if it says so."""
    def cell(tag: str, index: int, content: str) -> str:
        as_text = index < words or head[index].startswith(("worst", "inputs"))
        return f'<{tag}{" class=text" if as_text else ""}>{content}</{tag}>'

    top = "".join(cell("th", index, text(title)) for index, title in enumerate(head))
    body = "".join(
        f'<tr class="{kind}">' + "".join(cell("td", index, content) for index, content in enumerate(cells)) + "</tr>\n"
        for kind, cells in rows
    )
    return f'<div class=wide><table><thead><tr>{top}</tr></thead><tbody>\n{body}</tbody></table></div>\n'


def ratio_number(value: Optional[float]) -> str:
    return "–" if value is None else f"{value:.2f}"


def result_cells(result: Result) -> list[str]:
    speed, error = result.speed, result.error
    errors = [error_number(error.mean_eps), error_number(error.p999_eps), error_number(error.max_eps),
              text(nice(error.worst_row)), error_number(error.shared_max_eps),
              text(nice(error.shared_worst_row)), ratio_number(error.ratio)] if error else ["–"] * 7
    return [number(speed.ns), number(speed.msamples), ratio(result.vs_listing), share(result.roofline_share), *errors]


RESULT_HEAD = ["ns", "M/s", "× listing", "of copy", "mean ε", "p99.9 ε", "max ε", "worst hard case",
               "max ε, shared", "worst of these", "ratio"]


def result_table(data: Measurements, results: list[Result]) -> str:
    rows = []
    previous = None
    for result in results:
        speed = result.speed
        group = (speed.operation, speed.warp)
        kind = "ours" if data.is_ours(speed.operation) else ""
        rows.append((kind + (" break" if previous not in (None, group) else ""),
                     [text(nice(speed.operation)), text(nice(speed.warp)), text(nice(speed.isa)), *result_cells(result)]))
        previous = group
    return table(["", "warp", "set", *RESULT_HEAD], rows, words=3)


def in_groups(data: Measurements, results: Iterable[Result]) -> list[Result]:
    """Ours first, then the peers, then the copy; each operation and warp together."""
    order = unique((r.speed.operation, r.speed.warp) for r in results)

    def rank(result: Result) -> tuple[int, int]:
        operation = result.speed.operation
        kind = 0 if data.is_ours(operation) else 2 if operation == ROOFLINE else 1
        return kind, order.index((operation, result.speed.warp))

    return sorted(results, key=rank)


def main_table(data: Measurements, source: str, count: int) -> str:
    """All but the ellipsoids, which have a section of their own."""
    chosen = [r for r in data.results if r.speed.input == source and r.speed.count == count
              and not plain_of(r.speed.operation)]
    return result_table(data, in_groups(data, chosen))


def input_words(source: str) -> str:
    name, _, threads = source.replace("_", " ").partition("/threads:")
    return f"{name}, {threads} threads" if threads else name


def all_tables(data: Measurements, source: str, count: int) -> str:
    """Every other input and count, folded away."""
    parts = []
    for other in unique((r.speed.input, r.speed.count) for r in data.results):
        if other != (source, count):
            title = f"{input_words(other[0])}, {grouped(other[1])} samples a call"
            parts.append(f"<details><summary>{text(title)}</summary>{main_table(data, *other)}</details>\n")
    return "".join(parts)


def error_cells(row: ErrorRow) -> list[str]:
    distances = ["–"] * 3 if row.undefined else [error_number(v) for v in (row.mean_eps, row.p999_eps, row.max_eps)]
    slope = "–" if row.slope_error is None else f"{row.slope_error:.1e}"
    return [*distances, ratio_number(row.ratio), error_number(row.norm_eps), slope, grouped(row.samples),
            f"<span class=bits>{text(row.worst_input)}</span>"]


def error_tables(data: Measurements) -> str:
    parts = []
    for key in unique((e.implementation, e.warp, e.isa) for e in data.errors):
        rows = [e for e in data.errors if (e.implementation, e.warp, e.isa) == key]
        body = [("", [f'<span title="{text(data.row_notes.get(e.row, ""))}">{text(nice(e.row))}</span>', *error_cells(e)])
                for e in rows]
        head = ["hard case", "mean ε", "p99.9 ε", "max ε", "ratio", "norm ε", "slope", "samples", "worst input"]
        title = ", ".join(nice(word) for word in key if word not in ("any", "own"))
        parts.append(f"<details><summary>{text(title)}</summary>{table(head, body)}</details>\n")
    return "".join(parts)


def case_list(data: Measurements) -> str:
    rows = [("", [text(nice(name)), text(note)]) for name, note in data.row_notes.items()]
    return f"<details><summary>What the hard cases are</summary>{table(['hard case', 'inputs'], rows, words=2)}</details>"


def peer_list(data: Measurements) -> str:
    present = unique(s.operation for s in data.speeds if data.is_peer(s.operation))
    rows = [("", [text(nice(name)), text(PEERS.get(name, ""))]) for name in present]
    return f"<details><summary>Who the peers are</summary>{table(['peer', 'what it is'], rows, words=2)}</details>"


def key_figures(data: Measurements, source: str, count: int) -> str:
    """The four numbers that a reader takes home."""
    mine = [r for r in data.results if r.speed.operation == data.peer_operation and r.speed.input == source
            and r.speed.count == count]
    if not mine:
        return ""
    fastest = max(mine, key=lambda r: r.speed.msamples)
    closest = min((r for r in mine if r.error and r.error.max_eps is not None), 
                  key=lambda r: (r.error.max_eps, r.speed.ns), default=None)
    listing = next((r for r in data.results if (r.speed.operation, r.speed.warp, r.speed.isa) == LISTING and r.error), None)
    cards = [(f"{number(fastest.speed.msamples)} M/s",
              f"samples on one core, {nice(fastest.speed.warp)}, {nice(fastest.speed.isa)}, {source} input")]
    if fastest.vs_listing:
        cards.append((ratio(fastest.vs_listing), "the speed of the paper's listing"))
    if closest:
        cards.append((f"{number(closest.error.max_eps)} ε",
                      f"largest error in any hard case, {nice(closest.speed.warp)} ({nice(closest.error.worst_row)})"))
    if listing:
        cards.append((f"{error_number(listing.error.shared_max_eps)} ε",
                      f"largest error of the paper's listing, in its own domain ({nice(listing.error.shared_worst_row)})"))
    return "<div class=key>" + "".join(f"<div><b>{text(a)}</b><span>{text(b)}</span></div>" for a, b in cards) + "</div>"


def figure(svg: Optional[str], caption: str) -> str:
    return f"<figure>{svg}<figcaption>{caption}</figcaption></figure>\n" if svg else ""


def machine_list(machine: dict[str, Any]) -> str:
    return "<dl>" + "".join(f"<dt>{text(key)}</dt><dd>{text(value)}</dd>" for key, value in machine.items()) + "</dl>"


def fit_note(data: Measurements) -> str:
    fit = data.facts.get("fit_error")
    if not fit:
        return ""
    return (f" Heitz and d'Eon's curve is a fit: apart from all rounding it is off by up to {number(fit['max_normal'])} "
            f"in the normal ({number(fit['mean_normal'])} on average), which its point here leaves out.")


def sample_note(data: Measurements) -> str:
    mine = max((e.samples for e in data.errors if data.is_ours(e.implementation)), default=0)
    theirs = max((e.samples for e in data.errors if data.is_peer(e.implementation)), default=0)
    isa = data.facts.get("measured_isa", "")
    return (f"{grouped(mine)} samples per hard case for the library and {grouped(theirs)} for each peer"
            + (f", the library's taken on {nice(isa)}: the other sets give the same bits, as the tests verify." if isa else "."))


def render(data: Measurements, figures: Figures, machine: dict[str, Any], source: str, count: int,
           ellipsoids: str) -> str:
    """The whole page; the section about ellipsoids comes ready."""
    speed_figures = "".join(
        figure(svg, f"Each point is one implementation on the {text(source)} input, {grouped(count)} samples a call. Up is "
                    "faster, left is closer to the exact normal. Both axes are logarithmic: one decade to the left is ten "
                    "times closer. A point stands at the largest error over the hard cases that every peer promises to "
                    "accept (unit views above the horizon, alpha at most 1); the tick left of it is the largest error over "
                    "the typical case alone. The library has the same error on every instruction set, because it has the "
                    "same bits, so each of its warps is one vertical line. What lies below and to the right of the green line is "
                    "beaten in both. A hollow cross samples another distribution and is shown for its speed."
                    + fit_note(data))
        for svg in figures.speed_against_error
    )
    throughput = figure("".join(figures.throughput),
                        "A batch grows from 16 samples to millions. Left, the cost of a call shows; in the middle, all columns "
                        "fit in cache; right, memory sets the pace, and no kernel can pass the dashed copy, which reads and "
                        "writes the same columns and computes nothing.") if figures.throughput else ""
    errors = "".join(
        figure(svg, "Each line runs from the mean error to the largest, the tick on it marks the 99.9th percentile, and the "
                    "dot is the worst sample. An ε is 2⁻²⁴, half a unit in the last place of 1: nothing stored in a float "
                    "does much better than 1. A short line at the left says that this case is not hard any more; a dot "
                    "near ten million says that a normal points anywhere. A hollow dot stands for results that are not "
                    "numbers. The view exactly from below is left out: no normal is visible there, any unit one is right. "
                    "The ratio in the tables is the error over what the exact normal moves by when each input moves by "
                    "half a unit of its last place: it tells a steep problem from a bad formula.")
        for svg in figures.error_per_case
    )
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>vndf: speed against error</title>
<style>{theme.css_variables()}{STYLE}</style>
</head>
<body><main>
<h1>Speed against error</h1>
<p class=lead>How fast <code>vndf</code> samples GGX visible normals, how far they are from the exact ones, and how others
compare. Everything here was measured in one run on one machine.</p>
{key_figures(data, source, count)}
{machine_list(machine)}

<h2>Who is fast and close</h2>
{speed_figures}
{peer_list(data)}

<h2>The numbers</h2>
<p>{text(source.capitalize())} input, {grouped(count)} samples a call, columns aligned to 64 bytes, one core; medians of interleaved
repetitions. Nanoseconds
are per sample, M/s are million samples per second. “× listing” is the speed in units of the paper's listing on the same data, “of copy” the share of the
speed at which the same columns are merely copied. Errors are distances from the exact normal of the same float inputs in
ε = 2⁻²⁴, over all hard cases: the mean of their means, the largest 99.9th percentile, the largest of all. “Shared” are
the hard cases that every peer promises to accept: unit views above the horizon, alpha at most 1. NaN: some result was not
a finite number.
{sample_note(data)}</p>
{main_table(data, source, count)}
{all_tables(data, source, count)}

<h2>How large a batch has to be</h2>
{throughput}

<h2>Where others lose their digits</h2>
{errors}
{case_list(data)}
<h3>Every implementation</h3>
{error_tables(data)}
{ellipsoids}
<h2>What the maps do to a square</h2>
{figure(figures.checker, "A checkerboard on the unit square of random numbers, carried to the slopes of the normals "
        "(−x/z, −y/z) of a surface of roughness 1, seen from more and more grazing views. All maps give the same density, "
        "so equal cells have equal probability everywhere; they differ in the shape of the cells. Compact cells keep "
        "well spread random numbers well spread; long thin ones waste them. Cross-hairs mark slope 0.")}
{figure(figures.points, "The same with 512 points of an evenly spread sequence. The density is the same in every "
        "row of a column; rows of points and gaps between them are the map's doing.")}
</main></body>
</html>
"""

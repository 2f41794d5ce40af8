"""What the measuring programs wrote, as tables, and speed joined with error."""

import math
from typing import Any

import pandas as pd

EPS = 2.0**-24
# The largest distance of two unit vectors: in plots it stands for that of results that are not finite.
WORST_EPS = 2 / EPS
IMPLEMENTATION = ["operation", "warp", "isa"]
# Suffixes of the operations that take an ellipsoid, with what is given of it.
ELLIPSOIDS = {"one_shape": "five constants", "turned": "θz per lane", "tilted": "five columns"}
# The input's name, alone and where all other hardware threads were busy.
BUSY_INPUT = ("camera", "camera_busy")
NAME = (
    r"(?P<operation>[^/]+)/(?P<warp>[^/]+)/(?P<isa>[^/]+)/(?P<input>[^/]+)/(?P<count>\d+)"
    r"(?:/real_time)?(?:/threads:(?P<threads>\d+))?$"
)


def split_names(names: pd.Series) -> pd.DataFrame:
    """Benchmarks' names as columns; of an operation with an ellipsoid also its shape and the plain name."""
    table = names.str.extract(NAME).fillna({"threads": 1}).astype({"count": int, "threads": int})
    suffix = f"_({'|'.join(ELLIPSOIDS)})$"
    table["shape"] = table.operation.str.extract(suffix, expand=False).fillna("plain")
    table["plain_operation"] = table.operation.str.replace(suffix, "", regex=True)
    return table


def read_speeds(runs: list[dict[str, Any]]) -> pd.DataFrame:
    """Medians of Google Benchmark's runs, or the runs themselves where there are no aggregates."""
    table = pd.DataFrame(runs).dropna(subset="items_per_second")
    if "aggregate_name" in table:
        table = table[table.aggregate_name == "median"]
    table = table.drop_duplicates("run_name")
    speeds = split_names(table.run_name)
    speeds["ns"] = 1e9 / table.items_per_second
    speeds["msamples"] = table.items_per_second / 1e6
    speeds["bytes"] = table.bytes_per_second / table.items_per_second
    # Time of the reference kernel beside these, in units of its shortest: above 1.1 the core was busy.
    speeds["pace"] = table.get("pace", 1.0)
    return speeds.reset_index(drop=True)


def isas(context: dict[str, str]) -> dict[str, bool]:
    """The library's instruction sets, slowest first, and whether the machine has them; vndf_bench tells."""
    measured, missing = context.get("isas", "").split(), context.get("missing_isas", "").split()
    return {**dict.fromkeys(measured, True), **dict.fromkeys(missing, False)}


def read_errors(rows: list[dict[str, Any]]) -> pd.DataFrame:
    """One line per implementation and hard case. Errors are infinite where a result was not finite, for which
    JSON has no word; NaN where there is no single right answer, or nothing was measured."""
    errors = pd.DataFrame(rows).rename(columns={"implementation": "operation"})
    distances = ["mean_eps", "p999_eps", "max_eps"]
    errors[[*distances, "norm_eps"]] = errors[[*distances, "norm_eps"]].astype(float).fillna(math.inf)
    if "undefined" in errors:
        errors.loc[errors.undefined, distances] = math.nan
        errors = errors.astype({"slope_error": float, "ratio": float})
        errors.loc[errors.operation == "sample_disk", "norm_eps"] = math.nan  # its points are no unit vectors
    return errors


def summarise(rows: pd.DataFrame) -> pd.Series:
    """Over the hard cases of one implementation: the mean of means, the largest of the rest, and its case."""
    shared = rows[rows.shared_domain] if rows.shared_domain.any() else rows
    return pd.Series(
        {
            "mean_eps": rows.mean_eps.mean(),
            "p999_eps": rows.p999_eps.max(),
            "max_eps": rows.max_eps.max(),
            "worst_row": rows.row[rows.max_eps.idxmax()],
            "shared_max_eps": shared.max_eps.max(),
            "shared_worst_row": shared.row[shared.max_eps.idxmax()],
            "typical_max_eps": rows.max_eps.iloc[0],  # of the first case, which is not hard
            "ratio": rows.ratio.max(),
        }
    )


def ispc_ns(speeds: pd.DataFrame, results: pd.DataFrame, peers: dict[str, str]) -> pd.Series:
    """Of the same work in ISPC on the same set; of the polar map where it has no concentric one."""
    keys = ["does", "warp", "isa", "input", "count"]
    theirs = speeds[speeds.operation.str.startswith("ispc_")]
    theirs = theirs.assign(does=theirs.operation.map(peers)).set_index(keys).ns.astype(float)
    ours = results.assign(does=results.operation)[keys]
    same = theirs.reindex(pd.MultiIndex.from_frame(ours)).to_numpy()
    polar = theirs.reindex(
        pd.MultiIndex.from_frame(ours.replace({"warp": {"concentric": "polar"}}))
    ).to_numpy()
    return pd.Series(same, results.index).fillna(pd.Series(polar, results.index))


def join(speeds: pd.DataFrame, errors: pd.DataFrame, peers: dict[str, str]) -> pd.DataFrame:
    """Each speed with its ratios and its errors: ours first, then the peers, then the copy."""
    summaries = errors[~errors.undefined].groupby(IMPLEMENTATION, sort=False).apply(summarise).reset_index()
    # Errors that hold for any instruction set hold for each: the bits are the same.
    sets = speeds.isa.unique()
    summaries["isa"] = summaries.isa.map(lambda isa: sets if isa == "any" else [isa])
    results = speeds.merge(summaries.explode("isa"), how="left", on=IMPLEMENTATION)

    single = speeds[speeds.threads == 1]
    listing = (
        single[single.operation == "paper_listing"].set_index(["input", "count"]).ns.rename("listing_ns")
    )
    results = results.join(listing, on=["input", "count"])
    results["vs_listing"] = results.listing_ns / results.ns
    results["vs_ispc"] = ispc_ns(single, results, peers) / results.ns
    # The roofline: the best copy of as many bytes.
    copies = single[single.operation == "copy"]
    ns_per_byte = (copies.ns / copies.bytes).groupby(copies["count"]).min()
    results["roof_ns"] = results["count"].map(ns_per_byte) * results.bytes
    results["roofline_share"] = results.roof_ns / results.ns

    kind = {"copy": "copy", **dict.fromkeys(peers, "peer")}
    results["kind"] = pd.Categorical(results.operation.map(kind).fillna("ours"), ["ours", "peer", "copy"])
    results["does"] = results.operation.map(peers).fillna(results.operation)
    results["group"] = results.groupby(["operation", "warp"], sort=False).ngroup()
    return results.sort_values(["kind", "group"], kind="stable")


def alone_and_busy(results: pd.DataFrame) -> pd.DataFrame:
    """What was measured in both states of a core, a line each; empty where only one was."""
    alone, busy = (results[results.input == name] for name in BUSY_INPUT)
    same = [*IMPLEMENTATION, "count", "threads"]
    both = alone.merge(busy[[*same, "msamples", "vs_ispc"]], on=same, suffixes=("", "_busy"))
    return both.assign(kept=both.msamples_busy / both.msamples)


def ellipsoid_costs(speeds: pd.DataFrame) -> pd.DataFrame:
    """Nanoseconds of every operation that was measured with plain GGX and with each kind of ellipsoid."""
    index = ["plain_operation", "warp", "isa"]
    costs = speeds.pivot_table(index=index, columns="shape", values="ns", sort=False)
    costs = costs.reindex(columns=["plain", *ELLIPSOIDS]).dropna().reset_index()
    for kind in ELLIPSOIDS:
        costs[kind + "_ratio"] = costs[kind] / costs.plain
    costs["group"] = costs.groupby(index[:2], sort=False).ngroup()
    return costs.rename(columns={"plain_operation": "operation"}).sort_values("group", kind="stable")

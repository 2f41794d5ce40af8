"""Names and numbers as people write them."""

import math

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
    "ispc_disk": "ISPC disk",
    "ispc_reflection": "ISPC reflection",
    "ispc_evaluation": "ISPC evaluation",
    "ispc_pdf": "ISPC pdf",
    "ispc_dielectric": "ISPC dielectric",
    "ispc_dielectric_evaluation": "ISPC dielectric evaluation",
    "spherical_cap_listing": "caps listing",
    "paper_listing_fast": "fast listing",
    "plus_z": "exactly +z",
    "minus_z": "exactly −z",
    "near_plus_z": "near +z",
    "near_minus_z": "near −z",
}
# What a peer is, for those who have not read its paper.
PAPERS = {
    "paper_listing": "Heitz 2018, Listing 1, in plain float, as printed",
    "paper_listing_fast": "the same as a loop that compilers vectorise, with -ffast-math",
    "spherical_cap_listing": "Dupuy and Benyoub 2023, as published, in plain float",
    "heitz_2017": "Heitz 2017, the older parameterisation by two half disks; views above the horizon only",
    "heitz_deon_2014": "Heitz and d'Eon 2014, slope space with a fitted curve; views above the horizon only",
    "heitz_deon_2014_roots": "the same routine with square roots in place of the angle's sine and cosine",
    "ndf_walter_2007": "Walter et al. 2007: all normals, visible or not",
    "ispc_listing": "Heitz 2018, Listing 1, in ISPC, with its approximate reciprocal square root",
    "ispc_caps": "Dupuy and Benyoub 2023 in ISPC, with its approximate reciprocal square root",
    "ispc_disk": "the two maps of the disk in ISPC",
    "ispc_reflection": "the step of a rough mirror in ISPC: a normal as above, direction, density, weight",
    "ispc_evaluation": "the mirror's BRDF and density for a given light, textbook formulas in ISPC",
    "ispc_pdf": "the density of visible normals, textbook formula in ISPC",
    "ispc_dielectric": "the step of rough glass in ISPC, eta 1.5 known to the compiler",
    "ispc_dielectric_evaluation": "its evaluation for a given light, Walter et al. 2007 in ISPC",
}


def nice(word: str | float) -> str:
    """A name; a dash for one that is missing."""
    return NICE.get(word, word.replace("_", " ")) if isinstance(word, str) else "–"


def number(value: float) -> str:
    """Three significant digits, thousands apart, millions as M; NaN for an error of what is not finite."""
    if math.isnan(value):
        return "–"
    if math.isinf(value):
        return "NaN"
    if abs(value) >= 1e6:
        return f"{number(value / 1e6)}\u202fM"
    if 0 < abs(value) < 1e-3:
        return f"{value:.1e}"
    digits = 0 if value == 0 else max(0, 2 - math.floor(math.log10(abs(value))))
    return grouped(value, min(digits, 3))


def grouped(value: float, digits: int = 0) -> str:
    """Thousands apart by narrow spaces."""
    return f"{value:,.{digits}f}".replace(",", "\u202f")


def times(value: float) -> str:
    return "–" if math.isnan(value) else f"{number(value)}×"


def percent(share: float) -> str:
    return "–" if math.isnan(share) else f"{number(100 * share)} %"


def angles(theta: list[float]) -> str:
    return "(" + ", ".join(f"{angle:g}".replace("-", "−") for angle in theta) + ")" if any(theta) else "0"

#!/usr/bin/env python3
"""Estimates cycles per sample of the kernels, and of ISPC's, on processors not at hand, with llvm-mca.

Takes the loops out of the objects of a build: of every function and warp for plain GGX the one over several
vectors, and what is the same in ISPC, where its peers were built. Prints a Markdown table for each
instruction set. Caches are taken as warm, branches as predicted, optional outputs as absent.
"""

import argparse
import heapq
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

WIDTH = {"sse42": 4, "avx2": 8, "avx512": 16}
CPUS = ["znver4", "skylake-avx512", "icelake-server", "sapphirerapids"]
# Those that have AVX-512, among what llvm-mca knows.
HAVE_AVX512 = re.compile(r"znver[4-9]|.*(avx512|server|rapids)")
# Columns that a sample writes: so many stores tell how many samples an iteration takes.
OUTPUTS = {
    "sample_normals": 3,
    "sample_disk": 2,
    "sample_reflection": 5,
    "evaluate_reflection": 2,
    "pdf_normals": 1,
    "sample_dielectric": 6,
    "evaluate_dielectric": 2,
}
ISPC = {
    "normals": {"listing": ("sample_normals", "polar"), "caps": ("sample_normals", "spherical cap")},
    "disk": {"disk_polar": ("sample_disk", "polar"), "disk_concentric": ("sample_disk", "concentric")},
    "reflection": {
        "reflection": ("sample_reflection", "polar"),
        "reflection_caps": ("sample_reflection", "spherical cap"),
        "evaluation": ("evaluate_reflection", ""),
        "pdf": ("pdf_normals", ""),
    },
    "dielectric": {
        "dielectric": ("sample_dielectric", "polar"),
        "dielectric_caps": ("sample_dielectric", "spherical cap"),
        "dielectric_evaluation": ("evaluate_dielectric", ""),
    },
}
ROOT = re.compile(r"v?(r?sqrt|rcp|div)\w*[ps][sd]\b")
STACK = re.compile(r"\(%r[sb]p[,)]")


def fail(text: str) -> None:
    print(f"mca.py: {text}", file=sys.stderr)
    sys.exit(2)


class Instruction(NamedTuple):
    address: int
    text: str
    constant: str  # what it reads beside its code

    def target(self) -> int | None:
        found = re.match(r"j\w+\s+([0-9a-f]+)\b", self.text)
        return int(found[1], 16) if found else None


class Loop(NamedTuple):
    function: str
    label: str
    body: list[Instruction]

    def count(self, pattern: re.Pattern[str]) -> int:
        return sum(bool(pattern.match(at.text)) for at in self.body)

    def moves(self, stack: bool, store: bool) -> list[str]:
        """Operands in memory, of the stack or of columns."""
        found = []
        for at in self.body:
            operands = re.findall(r"-?\w*\([^)]*\)", at.text)
            stored = bool(re.match(r"v?mov(ap|up|dq|nt|s[sd])", at.text)) and at.text.endswith(")")
            if operands and "%rip" not in operands[0] and bool(STACK.search(operands[0])) == stack:
                found += [operands[0]] if stored == store and not at.text.startswith("lea") else []
        return found

    def samples(self, width: int) -> float:
        return len(self.moves(stack=False, store=True)) * width / OUTPUTS[self.function]

    def footprint(self, width: int) -> int:
        """Bytes of the stack and of constants."""
        spilled = set(self.moves(stack=True, store=True) + self.moves(stack=True, store=False))
        return (len(spilled) + len({at.constant for at in self.body if at.constant})) * 4 * width


def functions(objdump: str, path: Path) -> Iterator[tuple[str, list[Instruction]]]:
    command = [objdump, "-d", "-r", "-C", "--no-show-raw-insn", path]
    listed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    name, body = "", []
    for line in listed.splitlines():
        if head := re.match(r"[0-9a-f]+ <(.*)>:$", line):
            if body:
                yield name, body
            name, body = head[1], []
        elif code := re.match(r"\s+([0-9a-f]+):\t([a-z].*)", line):
            body.append(Instruction(int(code[1], 16), re.sub(r"\s*(<.*|#.*)?$", "", code[2]), ""))
        elif (constant := re.match(r"\s+[0-9a-f]+: R_X86_64_\w+\s+(\S+)", line)) and body:
            body[-1] = body[-1]._replace(constant=constant[1])
    if body:
        yield name, body


def shortest_way(
    code: list[Instruction], at: dict[int, int], head: int, tail: int
) -> list[Instruction] | None:
    """From head to tail, past what is optional."""
    seen: set[int] = set()
    queue: list[tuple[int, int, tuple[int, ...]]] = [(0, head, ())]
    while queue:
        length, i, way = heapq.heappop(queue)
        if i in seen:
            continue
        seen.add(i)
        way = (*way, i)
        while i != tail and code[i].target() is None and i < tail:
            i += 1
            length += 1
            way = (*way, i)
        if i == tail:
            return [code[k] for k in way]
        to = code[i].target()
        for target in [at.get(to), None if code[i].text.startswith("jmp") else i + 1]:
            if target is not None and head <= target <= tail:
                heapq.heappush(queue, (length + 1, target, way))
    return None


def hottest_loop(code: list[Instruction]) -> list[Instruction]:
    """Of the innermost, that with most roots and divisions: over several vectors, not over what is left."""
    at = {instruction.address: i for i, instruction in enumerate(code)}
    back = [
        (at[to], tail) for tail, to in enumerate(one.target() for one in code) if to in at and at[to] < tail
    ]
    inner = [(head, tail) for head, tail in back if not any(head < h and t < tail for h, t in back)]
    ways: dict[int, list[Instruction]] = {}
    for head, tail in inner:
        way = shortest_way(code, at, head, tail)
        if way and (head not in ways or len(way) < len(ways[head])):
            ways[head] = way
    return max(
        ways.values(), key=lambda way: (sum(bool(ROOT.match(at.text)) for at in way), -len(way)), default=[]
    )


def loops(objdump: str, build: Path, isa: str) -> Iterator[Loop]:
    ours = build / f"CMakeFiles/vndf_{isa}.dir/generated"
    for function in OUTPUTS:
        for name, code in functions(objdump, ours / f"{function}_{isa}.cpp.o"):
            # Plain GGX, height-correlated where there is a choice. The disk has no surface.
            plain = re.search(r"::Alpha(>|, (?!.*Masking\)1))", name)
            disk = function == "sample_disk" and "sample<" in name
            if not (plain or disk) or not (body := hottest_loop(code)):
                continue
            warp = re.search(r"::(Polar|Concentric|SphericalCap)\b", name)
            bounded = "bounded " if re.search("Bounded<|, true>", name) else ""
            words = re.sub(r"(?<=l)(?=C)", " ", warp[1]).lower() if warp else ""
            yield Loop(function, bounded + words, body)
    for source, kernels in ISPC.items():
        path = build / f"bench/peers/ispc_{source}_{isa}.o"
        for name, code in functions(objdump, path) if path.exists() else ():
            of = kernels.get(name.removeprefix("ispc_").removesuffix(f"_{isa}"))
            if of and (body := hottest_loop(code)):
                yield Loop(of[0], f"{of[1]} in ISPC".strip(), body)


class Estimate(NamedTuple):
    cycles: float
    ports: float
    divider: float


def estimate(mca: str, loop: Loop, cpu: str) -> Estimate:
    iterations = 50
    text = "\n".join(at.text for at in loop.body if at.target() is None) + "\n"
    command = [mca, "-mtriple=x86_64", f"-mcpu={cpu}", f"-iterations={iterations}"]
    run = subprocess.run(command, input=text, capture_output=True, text=True, check=True)
    total = re.search(r"Total Cycles:\s+(\d+)", run.stdout)
    ports = re.search(r"Block RThroughput:\s+([\d.]+)", run.stdout)
    names = re.findall(r"^\[([\d.]+)\]\s+- (\w+)", run.stdout, re.MULTILINE)
    pressure = re.search(r"Resource pressure per iteration:\n.*\n(.*)", run.stdout)
    used = [0.0 if one == "-" else float(one) for one in pressure[1].split()]
    divider = max((load for (_, name), load in zip(names, used) if "FPDivider" in name), default=0.0)
    return Estimate(int(total[1]) / iterations, float(ports[1]), divider)


def knows(mca: str, cpu: str) -> bool:
    """llvm-mca warns of a processor that it does not know, and takes another."""
    run = subprocess.run(
        [mca, "-mtriple=x86_64", f"-mcpu={cpu}"], input="nop\n", capture_output=True, text=True
    )
    return run.returncode == 0 and "not a recognized processor" not in run.stderr


def newest(program: str) -> str | None:
    """Debian's names carry the version."""
    versions = sorted(
        (int(version[1]), entry)
        for folder in os.get_exec_path()
        if Path(folder).is_dir()
        for entry in os.listdir(folder)
        if (version := re.fullmatch(rf"{program}-(\d+)", entry))
    )
    return versions[-1][1] if versions else shutil.which(program)


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    argument = parser.add_argument
    argument("build", type=Path, help="directory of a build of the library for x86, e.g. build/report")
    argument("--cpu", action="append", help=f"as llvm-mca calls it, repeatable (default: {' '.join(CPUS)})")
    argument("--llvm-mca", default=newest("llvm-mca"), help="the program (default: the newest one found)")
    argument("--objdump", default="objdump", help="that of binutils (default: objdump)")
    return parser.parse_args()


def main() -> None:
    arguments = parse_arguments()
    cpus = arguments.cpu or CPUS
    for program in (arguments.llvm_mca or "llvm-mca", arguments.objdump):
        if not shutil.which(program):
            fail(f"{program} was not found; Debian has llvm-mca in llvm-19 and objdump in binutils")
    for cpu in cpus:
        if not knows(arguments.llvm_mca, cpu):
            fail(f"{arguments.llvm_mca} does not know the processor {cpu}")
    isas = [isa for isa in WIDTH if (arguments.build / f"CMakeFiles/vndf_{isa}.dir/generated").is_dir()]
    if not isas:
        fail(f"{arguments.build} holds no kernels for SSE4.2, AVX2 or AVX-512; build the preset report first")
    for isa in isas:
        width = WIDTH[isa]
        able = [cpu for cpu in cpus if isa != "avx512" or HAVE_AVX512.match(cpu)]
        found = list(loops(arguments.objdump, arguments.build, isa))
        found.sort(key=lambda loop: list(OUTPUTS).index(loop.function))
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            pairs = [(loop, cpu) for loop in found for cpu in able]
            estimates = list(pool.map(lambda pair: estimate(arguments.llvm_mca, *pair), pairs))
        print(f"\n| {isa} | instructions | loads | stores | bytes | {' | '.join(able)} |")
        print("|---|" + "---:|" * (4 + len(able)))
        for k, loop in enumerate(found):
            samples = loop.samples(width)
            vectors = samples / width
            cells = [
                f"{len(loop.body) / vectors:.0f}",
                f"{len(loop.moves(stack=True, store=False)) / vectors:.0f}",
                f"{len(loop.moves(stack=True, store=True)) / vectors:.0f}",
                f"{loop.footprint(width)}",
            ]
            for one in estimates[k * len(able) : (k + 1) * len(able)]:
                bounds = [one.ports, one.divider] if one.divider else [one.ports]
                bounds = ", ".join(f"{bound / samples:.2f}" for bound in bounds)
                cells.append(f"{one.cycles / samples:.2f} ({bounds})")
            print(f"| {' '.join([loop.function, loop.label]).strip()} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()

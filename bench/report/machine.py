"""What the numbers were measured on."""

from __future__ import annotations

import datetime
import os
import platform
import re
import subprocess
from pathlib import Path


def output_of(*command: str) -> str:
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def cpu_field(name: str) -> str:
    try:
        match = re.search(rf"^{re.escape(name)}\s*:\s*(.*)$", Path("/proc/cpuinfo").read_text(), re.M)
    except OSError:
        return ""
    return match.group(1).strip() if match else ""


def cpu() -> str:
    model = cpu_field("model name") or platform.processor() or platform.machine()
    family, number = cpu_field("cpu family"), cpu_field("model")
    return f"{model} (family {family}, model {number})" if family and number else model


def readable(size: int) -> str:
    return f"{size >> 20} MiB" if size >= 1 << 20 else f"{size >> 10} KiB"


def caches() -> str:
    """The data caches: from lscpu with the number of each, else from the C library."""
    found = re.findall(r"^(L1d|L2|L3)(?: cache)?:\s*(.*)$", output_of("lscpu"), re.M)
    if not found:
        names = {"L1d": "LEVEL1_DCACHE_SIZE", "L2": "LEVEL2_CACHE_SIZE", "L3": "LEVEL3_CACHE_SIZE"}
        sizes = {level: output_of("getconf", name) for level, name in names.items()}
        found = [(level, readable(int(size))) for level, size in sizes.items() if size.isdigit() and int(size)]
    return ", ".join(f"{level} {size}" for level, size in found) or cpu_field("cache size") or "unknown"


def system() -> str:
    try:
        release = Path("/etc/os-release").read_text()
    except OSError:
        return platform.platform()
    name = re.search(r'^PRETTY_NAME="?([^"\n]*)', release, re.M)
    return f"{name.group(1) if name else platform.system()}, Linux {platform.release()}"


def revision(source: Path) -> str:
    """The short hash, with a plus sign where tracked files were changed since."""
    git = ("git", "-C", str(source))
    commit = output_of(*git, "rev-parse", "--short=12", "HEAD")
    if not commit:
        return "not a git checkout"
    return commit + ("+" if output_of(*git, "status", "--porcelain", "--untracked-files=no") else "")


def describe(source: Path, compiler: str, flags: str) -> dict[str, object]:
    return {
        "cpu": cpu(),
        "cores": os.cpu_count(),
        "caches": caches(),
        "system": system(),
        "compiler": compiler,
        "flags": flags,
        "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC"),
        "revision": revision(source),
    }

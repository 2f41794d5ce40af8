"""What the numbers were measured on."""

import json
import os
import platform
import subprocess
from pathlib import Path


def output_of(*command: str) -> str:
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def cpu() -> tuple[str, str]:
    """Its name and its data caches."""
    listed = json.loads(output_of("lscpu", "--json") or '{"lscpu": []}')["lscpu"]
    fields = {entry["field"].rstrip(":"): entry["data"] for entry in listed}
    name = fields.get("Model name", platform.machine())
    if "CPU family" in fields:
        name += f" (family {fields['CPU family']}, model {fields['Model']})"
    caches = [
        f"{level} {fields[level + ' cache']}" for level in ("L1d", "L2", "L3") if level + " cache" in fields
    ]
    return name, ", ".join(caches) or "unknown"


def system() -> str:
    try:
        return f"{platform.freedesktop_os_release()['PRETTY_NAME']}, Linux {platform.release()}"
    except OSError:
        return platform.platform()


def revision(source: Path) -> str:
    """The short hash, with a plus sign where tracked files were changed since."""
    return output_of(
        "git", "-C", str(source), "describe", "--always", "--exclude=*", "--abbrev=12", "--dirty=+"
    )


def describe(source: Path, compiler: str, flags: str, date: str) -> dict[str, object]:
    name, caches = cpu()
    return {
        "cpu": name,
        "cores": os.cpu_count(),
        "caches": caches,
        "system": system(),
        "compiler": compiler,
        "flags": flags,
        "date": date,
        "revision": revision(source) or "not a git checkout",
    }

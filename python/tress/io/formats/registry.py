"""The list of formats: a new one is its file and its line here."""

from pathlib import Path

from tress.base.errors import InputError
from tress.io.format import Format
from tress.io.formats import glb, hair, npz, obj, ply, usd

FORMATS: tuple[Format, ...] = (usd.FORMAT, glb.FORMAT, hair.FORMAT, ply.FORMAT, obj.FORMAT, npz.FORMAT)


def format_of(path: Path) -> Format:
    """The format that a file's suffix names. Raises `InputError` for others.

    >>> format_of(Path("out/hair.glb")).name
    'glb'
    """
    suffix = path.suffix.lower()
    found = next((form for form in FORMATS if suffix in form.suffixes), None)
    if found is None:
        known = ", ".join(suffix for form in FORMATS for suffix in form.suffixes)
        raise InputError(f"{path.name} has suffix {path.suffix!r}; one of {known} was expected.")
    return found

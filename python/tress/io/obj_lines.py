"""The lines of an OBJ file in runs of one kind, and the numbers of such a run all at once.

Almost all of a large file are long runs of `v` or `l` lines, which NumPy reads ten times faster than line by line. What
looks unusual in any way is left to the caller, to be read line by line with an error that names the line.
"""

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]

_LONGEST_RUN = 65_536  # lines; so that the numbers of a run stay in the cache
_FLOATS, _WHOLES = b"0123456789.+-eE \t\n", b"0123456789 \t\n"


@dataclass(frozen=True)
class Run:
    """Successive lines that begin with the same word of one letter; `kind` is empty where they do not.

    `first_line` counts from 1; `text` are the lines as they stand, each with its newline.
    """

    kind: str
    first_line: int
    text: bytes

    def numbers(self) -> tuple[Array, Array] | None:
        """The numbers after the first word, and how many of them each line has; None where something is unusual.

        Floats for `v`; for other kinds whole numbers without a sign.
        """
        letter, floats = self.kind.encode(), self.kind == "v"
        if not letter or self.text.translate(None, letter + (_FLOATS if floats else _WHOLES)):
            return None
        counts = _words_per_line(self.text) - 1
        if self.text.count(letter) != len(counts):
            return None
        values = _parsed(self.text.translate(None, letter), np.dtype(np.float64 if floats else np.int64))
        return None if values is None or len(values) != counts.sum() else (values, counts)


def runs(data: bytes) -> Iterator[Run]:
    """The lines of a file in runs, in their order."""
    text = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    text += b"" if text.endswith(b"\n") else b"\n"
    letters = np.frombuffer(text + b"\n", np.uint8)
    starts = np.concatenate([[0], np.flatnonzero(letters[:-1] == ord("\n")) + 1])
    kinds = np.where(letters[starts[:-1] + 1] == ord(" "), letters[starts[:-1]], 0)
    begins = np.concatenate([[0], np.flatnonzero(np.diff(kinds)) + 1, [len(kinds)]])
    for begin, end in zip(begins[:-1].tolist(), begins[1:].tolist(), strict=True):
        for first in range(begin, end, _LONGEST_RUN):
            last = min(first + _LONGEST_RUN, end)
            kind = chr(kinds[first]) if chr(kinds[first]).isalpha() else ""
            yield Run(kind, first + 1, text[starts[first] : starts[last]])


def _words_per_line(text: bytes) -> Array:
    """How many words each line has."""
    letters = np.frombuffer(b"\n" + text, np.uint8)
    inside = letters > ord(" ")
    ends = np.flatnonzero(letters[1:] == ord("\n"))
    words_before = np.searchsorted(np.flatnonzero(inside[1:] > inside[:-1]), ends)
    return np.diff(words_before, prepend=0)


def _parsed(text: bytes, dtype: np.dtype[Any]) -> Array | None:
    """All numbers of a text, or None where it is not made of numbers alone."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return np.fromstring(text, dtype, sep=" ")
        except (ValueError, DeprecationWarning):
            return None

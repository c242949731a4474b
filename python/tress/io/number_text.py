"""Numbers as text, many at a time: rows of words that NumPy looks up in tables.

Formatting number by number costs half a microsecond each. Here every number becomes a few words of four bytes, taken
from tables of up to four digits; bytes that a number does not need are zero, and are dropped when the rows become one
text. That is ten times faster. The numbers that the tables cannot hold are formatted one by one.
"""

from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]

_BIG = 2.0**-6  # from here on 9 decimals tell neighbouring float32 apart
_SMALL = 2.0**-13  # from here on 11 do
_END = 100.0
_ROWS_AT_ONCE = 16_384  # so many rows stay in the processor's cache


def text_of_rows(*columns: "Array | str") -> bytes:
    """The text of rows, one after the other: (N, W) words of the functions below, and texts that every row has.

    >>> text_of_rows("v", decimals(np.float32([[0.25, -1, 3e-7]])), "\\n")
    b'v 0.250000000 -1.000000000 3.00000011e-07\\n'
    """
    count = next(len(column) for column in columns if not isinstance(column, str))
    parts = [np.tile(_words(column), (count, 1)) if isinstance(column, str) else column for column in columns]
    return np.hstack(parts).tobytes().translate(None, b"\0")


def batches(count: int) -> list[slice]:
    """The rows 0 to `count` in parts of a size that is fast to format."""
    return [slice(start, min(start + _ROWS_AT_ONCE, count)) for start in range(0, count, _ROWS_AT_ONCE)]


def decimals(values: Array) -> Array:
    """Words of (N, K) float32, a space before each, that give back the same float32 when they are read.

    9 decimals for numbers from 1/64 to 100, 11 for those from 1/8192, 9 digits and an exponent for the others.
    """
    flat = values.reshape(-1).astype(np.float64)
    size = np.abs(flat)
    usual = ((size >= _SMALL) & (size < _END - 1e-6)) | (size == 0)
    size[~usual] = 0  # for now
    short = (size >= _BIG) | (size == 0)
    units = np.where(short, np.rint(size * 1e9) * 100, np.rint(size * 1e11)).astype(np.int64)
    high = units // 10**8  # whole part and three decimals
    low = (units - high * 10**8).astype(np.int32)  # eight more
    whole = high // 1000
    words = np.empty((flat.size, 4), np.uint32)
    words[:, 0] = _SIGNED[whole + 100 * (flat < 0)]
    words[:, 1] = _POINT[high - whole * 1000]
    middle = low // 10_000
    words[:, 2] = _DIGITS[middle]
    words[:, 3] = _ENDS[low - middle * 10_000 + 10_000 * short]
    for index in np.flatnonzero(~usual):
        words[index] = _table([f" {flat[index]:.9g}"], words=4)
    return words.reshape(len(values), -1)


def shares(values: Array) -> Array:
    """Words of (N, K) numbers in [0, 1], a space before each, to four decimals.

    >>> text_of_rows(shares(np.array([[0, 0.25, 1]])))
    b' 0.0000 0.2500 1.0000'
    """
    return _SHARES[np.rint(values.reshape(-1) * 10_000).astype(np.int32)].reshape(len(values), -1)


def whole_numbers(values: Array) -> Array:
    """Words of (N,) whole numbers from 0, nothing before them.

    >>> text_of_rows(whole_numbers(np.array([0, 10_000])), "\\n")
    b'0\\n10000\\n'
    """
    rest = values.astype(np.int64)
    groups = []
    while not groups or rest.any():
        above = rest // 10_000
        groups.append(np.where(above > 0, _DIGITS[rest - above * 10_000], _PLAIN[rest - above * 10_000]))
        if len(groups) > 1:  # a group that is zero and leads is no digit at all
            groups[-1][rest == 0] = 0
        rest = above
    return np.stack(groups[::-1], axis=1)


def flagged(flags: Array, text: str) -> Array:
    """Words that hold `text` in the rows where `flags` (N,) is true, nothing in the others."""
    return np.where(flags[:, None], _words(text), np.uint32(0))


def _words(text: str) -> Array:
    """A text as words of four bytes, zeros at the end."""
    data = text.encode()
    return np.frombuffer(data + b"\0" * (-len(data) % 4), np.uint32)


def _table(texts: list[str], *, words: int = 1) -> Array:
    """One row of words for each text."""
    rows = np.frombuffer(b"".join(text.encode().ljust(4 * words, b"\0") for text in texts), np.uint32)
    return rows if words == 1 else rows.reshape(-1, words)


_SIGNED = _table([f" {number}" for number in range(100)] + [f" -{number}" for number in range(100)])
_POINT = _table([f".{number:03d}" for number in range(1000)])
_DIGITS = _table([f"{number:04d}" for number in range(10_000)])
_PLAIN = _table([str(number) for number in range(10_000)])
_ENDS = np.concatenate([_DIGITS, _table([f"{number // 100:02d}" for number in range(10_000)])])
_SHARES = _table([f" {number / 10_000:.4f}" for number in range(10_001)], words=2)

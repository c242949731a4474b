"""Independent parts of a computation, side by side on the processor's cores.

For parts that spend their time in NumPy, OpenCV or the kernels, which let other threads run. Every part computes what
it would alone, and results keep the order of the parts: the bits do not depend on the number of cores.
"""

from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

import numpy as np

Array = np.ndarray[Any, Any]
First = TypeVar("First")
Second = TypeVar("Second")

_BAND_ROWS = 48
"""Rows of a picture that one thread works on: its planes fit into a core's cache."""


def each(function: Callable[[First], Second], items: Iterable[First]) -> list[Second]:
    """`function` of every one of `items`, in their order.

    >>> each(abs, [-1, 2, -3])
    [1, 2, 3]
    """
    with ThreadPoolExecutor() as pool:
        return list(pool.map(function, items))


def together(first: Callable[[], First], second: Callable[[], Second]) -> tuple[First, Second]:
    """The results of two functions that run at the same time.

    >>> together(lambda: 1, lambda: "b")
    (1, 'b')
    """
    with ThreadPoolExecutor(1) as pool:
        begun = pool.submit(first)
        found = second()
        return begun.result(), found


def in_bands(function: Callable[..., tuple[Array, ...]], *pictures: Array) -> tuple[Array, ...]:
    """What `function` makes of `pictures` (H, …), where its answer for a row depends on that row of each alone.

    It is asked for bands of rows, and its answers (H, …) are put together.

    >>> in_bands(lambda a, b: (a + b, a - b), np.array([3, 4]), np.array([1, 2]))
    (array([4, 6]), array([2, 2]))
    """
    height = len(pictures[0])
    starts = range(0, max(height, 1), _BAND_ROWS)
    bands = each(lambda start: function(*(picture[start : start + _BAND_ROWS] for picture in pictures)), starts)
    return tuple(np.concatenate(parts) for parts in zip(*bands, strict=True))

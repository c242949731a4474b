"""How many cores the work may use."""

import os

_VARIABLES = ("RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENCV_FOR_THREADS_NUM")


def limit_threads(count: int | None) -> None:
    """At most `count` threads in every library, all cores for None. To be called before the libraries are loaded."""
    if count is not None:
        os.environ.update(dict.fromkeys(_VARIABLES, str(count)))

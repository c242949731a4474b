"""Readers that do what a damaged file can make a library do."""

import os
import time
from pathlib import Path

import numpy as np


def crash(path: Path) -> None:
    """Ends the process."""
    os.abort()


def take_memory(path: Path) -> int:
    """Asks for 16 GiB."""
    return len(np.ones(2**31))


def never_end(path: Path) -> None:
    """Takes a minute."""
    time.sleep(60)


def say(path: Path) -> str:
    """Prints, and gives the file's text."""
    print("noise")
    return path.read_text()

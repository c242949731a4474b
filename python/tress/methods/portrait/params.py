"""The parameters of all stages in one record."""

from dataclasses import dataclass


@dataclass(frozen=True)
class PortraitParams:
    """Parameters of a reconstruction: one field a stage, named like the stage, and the seed of all that is random."""

    seed: int = 0

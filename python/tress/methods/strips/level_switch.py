"""Which level to show at a distance."""

from collections.abc import Sequence

HYSTERESIS = 0.1


def level_for(
    distance_m: float, previous: int | None = None, *, takeover_m: Sequence[float], hysteresis: float = HYSTERESIS
) -> int:
    """The level at `distance_m` after the level `previous`, or None for the first time; its only state is its argument.

    Level k takes over at `takeover_m[k - 1]` (rising). On the way out it comes at that distance times (1 + hysteresis),
    on the way back it goes at that times (1 - hysteresis), so that nothing flickers at the border.

    >>> [level_for(2.05, before, takeover_m=[2.0, 4.0]) for before in (None, 0, 1, 2)]
    [1, 0, 1, 1]
    """
    least = sum(distance_m >= border * (1 + hysteresis) for border in takeover_m)
    most = sum(distance_m >= border * (1 - hysteresis) for border in takeover_m)
    wanted = sum(distance_m >= border for border in takeover_m) if previous is None else previous
    return min(max(wanted, least), most)

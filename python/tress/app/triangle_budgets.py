"""Budgets of triangles as words."""

from tress.base.errors import InputError


def triangle_budgets(words: str) -> tuple[int, ...]:
    """The numbers in "20000,8000,2000". Raises `InputError` for anything else.

    >>> triangle_budgets("20000, 8000")
    (20000, 8000)
    """
    try:
        return tuple(int(part) for part in words.split(","))
    except ValueError:
        raise InputError(
            f"--lod {words}: whole numbers with commas between were expected, as 20000,8000,2000."
        ) from None

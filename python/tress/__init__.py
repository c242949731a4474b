"""Tress makes hair: strands, strips and clumps, from a photograph, a picture, surfaces or a few numbers."""

__version__ = "0.1.0"

"""Textures of strands for strips: cards of hair baked into an atlas, and its mip chain."""

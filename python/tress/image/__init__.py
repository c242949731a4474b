"""From pixels to layers, mattes, orientations and traced strands: arrays in, arrays out."""

"""Hair in strips: presets made of edits, levels of detail, motion."""

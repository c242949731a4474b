"""A bob from its preset, trimmed and saved: `python examples/strips_bob.py OUT.usdc`."""

import sys
from pathlib import Path

import numpy as np

from tress.base.report import Report
from tress.edit.clearances import clearances
from tress.edit.displace import displace
from tress.io.formats.usd import save_document
from tress.methods.strips.edited import edited
from tress.methods.strips.hairdo import covered, hairdo
from tress.methods.strips.params import StripsParams
from tress.model.strip import Strip
from tress.model.strips import strip_names
from tress.render.textures.params import TextureParams
from tress.render.textures.strand_atlas import strand_atlas

report = Report()
document = hairdo("bob", params=StripsParams(strips=240, length=1.1, seed=3), report=report)

# What a preset made is strips like any others: here the tips of the fringe go 5 mm to the side.
fringe = strip_names(document, ["fringe"])
tips = {
    name: np.argwhere(np.arange(8)[:, None] >= [6, 6, 6, 6])
    for name in fringe
    if isinstance(document.records[name], Strip)
}
document = edited(document, displace, points=tips, by=(0.005, 0, 0), falloff_m=0.02)

document = covered(document, strand_atlas(TextureParams(resolution=512), report=report))
least = clearances(document, names=["hair"], surface="head")
print(f"{len(least)} strips, the nearest {1000 * min(least.values()):.1f} mm off the head")
save_document(document, Path(sys.argv[1]))

"""Pictures of cartoon hair: Table 1 of the paper, and the presets."""

import math
from pathlib import Path
from typing import Any

import numpy as np

from tools.pictures.sheets import rows, save, side_by_side
from tress.app.cartoon_job import COPPER, clump_style
from tress.kernel import nurbs
from tress.methods.cartoon.clump import swept
from tress.methods.cartoon.hairdo import hairdo
from tress.methods.cartoon.key_hairs import key_hairs
from tress.methods.cartoon.params import ClumpParams, KeyHairParams
from tress.methods.cartoon.presets.registry import PRESETS
from tress.methods.strips.appearance import for_style, strips_scene, view
from tress.model.evaluate import Scene
from tress.model.mesh import Mesh
from tress.model.strip import Strip
from tress.model.strip_grid import strip_grid
from tress.render.flat_scene import flat_scene
from tress.render.occlusion import prepared
from tress.render.styles.gouraud import GouraudStyle
from tress.render.views import framed

TABLE_1 = {
    "A": (1.0, 16, 0.1, 1.0, 0.0),
    "B": (1.0, 16, 1.0, 1.0, 1.0),
    "C": (1.0, 16, 1.0, 2.0, 0.2),
    "D": (1.0, 30, 1.0, 1.0, 0.2),
    "E": (0.4, 8, 1.0, 1.0, 0.2),
}
"""hairLength, numHairPoints, vertRadius, horizRadius, pointiness."""
VIEWS = (0.0, 45.0, 90.0, 180.0)


def cartoon_hair(_: Path) -> None:
    """The five columns of Table 1 side by side, and the presets from four sides."""
    save(table_sheet(), "cartoon_table_1")
    save(rows([_preset(preset.name) for preset in PRESETS]), "cartoon_presets")


def table_sheet() -> Any:
    """Clumps of one key hair with the settings of Table 1."""
    u = np.linspace(0, 1, 8)
    line = np.stack([1.2 * np.sin(5 * u), 10 * (1 - u), 0 * u], axis=-1)
    sheet = nurbs.patch(np.stack([line, line + [0, 0, -9.0]], axis=1), degree_v=1)
    meshes = {}
    for index, (name, (length, points, vertical, horizontal, pointiness)) in enumerate(TABLE_1.items()):
        hairs = key_hairs(sheet, params=KeyHairParams(hairs=2, points=points, length=length))
        params = ClumpParams(vertical_radius=vertical, horizontal_radius=horizontal, pointiness=pointiness)
        made = swept(hairs, params=params)
        strip = Strip(points=made.points[0], weights=made.weights, knots_u=made.knots_u, knots_v=made.knots_v)
        grid = strip_grid([strip], pieces=(4, 6))
        positions = 0.03 * (grid.points(made.points[0].reshape(-1, 3)) + [5.0 * index, 0, 0])
        color = np.broadcast_to(np.asarray(COPPER, np.float32), positions.shape)
        meshes[name] = Mesh(positions=positions, triangles=grid.triangles, vertex_attributes={"color": color})
    scene = prepared(flat_scene(Scene(meshes=meshes)))
    picture = view(scene, framed(scene, width=900, height=480), style=GouraudStyle(), azimuth_rad=math.radians(20))
    return side_by_side([picture], ["A to E of Table 1"])


def _preset(name: str) -> Any:
    style = clump_style("toon")
    scene = prepared(strips_scene(hairdo(name), color=COPPER, **for_style(style)))
    camera = framed(scene, width=320, height=400)
    pictures = [view(scene, camera, style=style, azimuth_rad=math.radians(angle)) for angle in VIEWS]
    return side_by_side(pictures, [name, "", "", ""])

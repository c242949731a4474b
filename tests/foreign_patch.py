"""A file with a patch as another program writes it, whole or damaged."""

import numpy as np
from pxr import Gf, Usd, UsdGeom


def foreign(path, *, up="Z", metres=0.01, samples=False, **changes):
    """A patch as Maya or Houdini would write it: under a transform, centimetres, Z up, u running fastest."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.SetStageMetersPerUnit(stage, metres)
    stage.SetTimeCodesPerSecond(30)
    UsdGeom.Xform.Define(stage, "/groom").AddTranslateOp().Set(Gf.Vec3d(0, 0, 10))
    patch = UsdGeom.NurbsPatch.Define(stage, "/groom/lock")
    net = np.stack([*np.meshgrid(np.arange(4.0), np.arange(3.0), indexing="ij"), np.zeros((4, 3))], axis=-1)
    points = net.transpose(1, 0, 2).reshape(-1, 3).astype(np.float32)
    values = {
        "uVertexCount": 4,
        "vVertexCount": 3,
        "uOrder": 4,
        "vOrder": 3,
        "uKnots": [0, 0, 0, 0, 1, 1, 1, 1],
        "vKnots": [0, 0, 0, 1, 1, 1],
        "points": points,
    } | changes
    for name, value in values.items():
        if value is not None:
            patch.GetPrim().GetAttribute(name).Set(value)
    if samples:
        for code in (0, 15, 30):
            patch.GetPointsAttr().Set(points + np.float32([0, 0, code]), code)
    stage.Save()
    return net

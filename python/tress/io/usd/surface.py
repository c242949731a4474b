"""A mesh as `UsdGeomMesh` without subdivision, with its picture in a `UsdPreviewSurface` material.

Texture coordinates are the primvar `st`, one per corner; the picture lies beside the file as PNG, which loses nothing.
"""

import numpy as np

from tress.base.errors import FormatError
from tress.io.mesh_normals import vertex_colors, vertex_normals
from tress.io.usd.extent import extent
from tress.io.usd.prim import Attribute, Picture, Prim
from tress.io.usd.primvars import attributes_of, primvars
from tress.io.usd.typing import exact_values
from tress.model.mesh import Mesh
from tress.model.texture import Texture


def mesh_prim(name: str, mesh: Mesh, *, normals: bool = True) -> Prim:
    """The prim of a mesh. Programs that know USD alone also see its attribute `color`, and `normals`."""
    attributes = {
        "points": Attribute("point3f[]", mesh.positions),
        "faceVertexCounts": Attribute("int[]", np.full(len(mesh.triangles), 3, np.int32)),
        "faceVertexIndices": Attribute("int[]", mesh.triangles.reshape(-1)),
        "subdivisionScheme": Attribute("token", "none", uniform=True),
        "extent": extent(mesh.positions),
    } | primvars(mesh.vertex_attributes, interpolation="vertex")
    if normals:
        attributes["normals"] = Attribute("normal3f[]", vertex_normals(mesh), "vertex")
    if (painted := vertex_colors(mesh)) is not None:
        attributes["primvars:displayColor"] = Attribute("color3f[]", painted, "vertex")
    if mesh.corner_uv is not None:
        attributes["primvars:st"] = Attribute("texCoord2f[]", mesh.corner_uv.reshape(-1, 2), "faceVarying")
    data = {"record": "Mesh"}
    if mesh.texture is None:
        return Prim(name, "Mesh", attributes, data=data)
    return Prim(
        name,
        "Mesh",
        attributes,
        relationships={"material:binding": "./material"},
        children=(_material(mesh.texture),),
        api_schemas=("MaterialBindingAPI",),
        data=data,
    )


def mesh_of(prim: Prim) -> Mesh:
    """The mesh of a prim. Raises `FormatError` where it has other faces than triangles."""
    points, counts, indices = (
        prim.attributes.get(name) for name in ("points", "faceVertexCounts", "faceVertexIndices")
    )
    if points is None or counts is None or indices is None:
        raise FormatError(f"Mesh {prim.name!r} has no points or no faces.")
    if np.any(exact_values(counts) != 3) or len(exact_values(indices)) != 3 * len(exact_values(counts)):
        raise FormatError(f"Mesh {prim.name!r} has other faces than triangles.")
    st = prim.attributes.get("primvars:st")
    return Mesh(
        positions=exact_values(points),
        triangles=exact_values(indices).reshape(-1, 3),
        corner_uv=None if st is None else exact_values(st).reshape(-1, 3, 2),
        vertex_attributes=attributes_of(prim, interpolation="vertex"),
        texture=_texture(prim),
    )


def _material(texture: Texture) -> Prim:
    inputs = {"inputs:diffuseColor": Attribute("color3f", connection="../picture.outputs:rgb")}
    outputs = {"outputs:rgb": Attribute("float3")}
    if texture.pixels.shape[2] == 4:
        inputs["inputs:opacity"] = Attribute("float", connection="../picture.outputs:a")
        outputs["outputs:a"] = Attribute("float")
    shader = Prim(
        "surface",
        "Shader",
        {
            "info:id": Attribute("token", "UsdPreviewSurface", uniform=True),
            **inputs,
            "inputs:roughness": Attribute("float", 0.9),
            "outputs:surface": Attribute("token"),
        },
    )
    picture = Prim(
        "picture",
        "Shader",
        {
            "info:id": Attribute("token", "UsdUVTexture", uniform=True),
            "inputs:file": Attribute("asset", Picture(texture.pixels)),
            "inputs:sourceColorSpace": Attribute("token", "sRGB"),
            "inputs:wrapS": Attribute("token", "clamp"),
            "inputs:wrapT": Attribute("token", "clamp"),
            "inputs:st": Attribute("float2", connection="../coordinates.outputs:result"),
            **outputs,
        },
    )
    coordinates = Prim(
        "coordinates",
        "Shader",
        {
            "info:id": Attribute("token", "UsdPrimvarReader_float2", uniform=True),
            "inputs:varname": Attribute("string", "st"),
            "outputs:result": Attribute("float2"),
        },
    )
    output = {"outputs:surface": Attribute("token", connection="./surface.outputs:surface")}
    return Prim("material", "Material", output, children=(shader, picture, coordinates))


def _texture(prim: Prim) -> Texture | None:
    material = prim.child("material")
    picture = material.child("picture") if material else None
    file = picture.attributes.get("inputs:file") if picture else None
    if file is None or not isinstance(file.value, Picture):
        return None
    return Texture(pixels=file.value.pixels)

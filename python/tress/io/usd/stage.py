"""Prims to and from USD files: the only module that knows `pxr`.

Layers are written through `Sdf`, which takes arrays by their memory and composes nothing: 50,000 strands take a
fraction of a second. Pictures lie in a folder `textures` beside the file, named by their content, so that replacing
the file is what makes a new state visible, and a crash before leaves the old file with its old pictures.
"""

# pyright: reportAttributeAccessIssue=false
# `pxr` comes without type stubs.

import hashlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Tf, Usd, UsdValidation, Vt

from tress.base.errors import FormatError, OutputError
from tress.io.atomic import atomic_path, write_bytes
from tress.io.file_bytes import read_bytes
from tress.io.png import decode_png, encode_png
from tress.io.usd.prim import Attribute, Picture, Prim

ROOT = "tress"
TEXTURES = "textures"
SUFFIXES = (".usdc", ".usda", ".usd")


def write_stage(prims: list[Prim], path: Path, *, data: Mapping[str, Any]) -> None:
    """Writes prims under one root, Y up and in metres, with `data` as metadata of the file.

    The file appears whole or not at all. Raises `OutputError`.
    """
    layer = Sdf.Layer.CreateAnonymous(path.suffix)
    pictures = _Pictures(path)
    with Sdf.ChangeBlock():
        root = Sdf.PrimSpec(layer, ROOT, Sdf.SpecifierDef, "Xform")
        root.SetInfo("kind", "component")
        layer.defaultPrim = ROOT
        layer.pseudoRoot.SetInfo("upAxis", "Y")
        layer.pseudoRoot.SetInfo("metersPerUnit", 1.0)
        layer.customLayerData = {"tress": dict(data)}
        for prim in prims:
            _write_prim(root, prim, pictures)
    pictures.write()
    with atomic_path(path) as temporary:
        _export(layer, temporary)
    pictures.remove_others()


def read_stage(path: Path) -> tuple[list[Prim], dict[str, Any]]:
    """The prims under the root, and the metadata of the file. Raises `FormatError` where Tress did not write it."""
    if not path.is_file():
        raise FormatError(f"{path} is no file; a USD file was expected.")
    try:
        layer = Sdf.Layer.OpenAsAnonymous(str(path))
        root = layer.GetPrimAtPath(f"/{ROOT}") if layer else None
        data = layer.customLayerData.get("tress") if layer else None
    except Tf.ErrorException as error:
        raise FormatError(f"{path} is no USD file, or it is damaged.") from error
    if root is None or not isinstance(data, dict):
        raise FormatError(f"{path} holds no document of Tress.")
    try:
        return [_read_prim(child, path.parent) for child in root.nameChildren], data
    except Tf.ErrorException as error:
        raise FormatError(f"{path} is damaged.") from error


def validation_errors(path: Path) -> list[str]:
    """What USD's own validators say against a file: empty if nothing."""
    stage = Usd.Stage.Open(str(path))
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    found = UsdValidation.ValidationContext(validators).Validate(stage)
    return [f"{error.GetIdentifier()}: {error.GetMessage()}" for error in found]


class _Pictures:
    """The pictures of one file: collected while prims are written, then saved beside it."""

    def __init__(self, path: Path) -> None:
        self._folder = path.parent / TEXTURES
        self._file = path.name
        self._encoded: dict[str, bytes] = {}

    def add(self, picture: Picture) -> str:
        """Keeps a picture to be written, and returns its path relative to the file."""
        digest = hashlib.sha256(repr(picture.pixels.shape).encode() + picture.pixels.tobytes()).hexdigest()[:16]
        name = f"{self._file}.{digest}.png"
        if name not in self._encoded:
            self._encoded[name] = encode_png(picture.pixels)
        return f"./{TEXTURES}/{name}"

    def write(self) -> None:
        """Writes those that are not there yet."""
        if self._encoded:
            try:
                self._folder.mkdir(exist_ok=True, parents=True)
            except OSError as error:
                raise OutputError(f"{self._folder} could not be made: {error.strerror}.") from error
        for name, data in self._encoded.items():
            write_bytes(self._folder / name, data)

    def remove_others(self) -> None:
        """Removes pictures of earlier versions of the file."""
        for file in self._folder.glob(f"{_escaped(self._file)}.{'[0-9a-f]' * 16}.png"):
            if file.name not in self._encoded:
                file.unlink(missing_ok=True)


def _export(layer: Sdf.Layer, path: Path) -> None:
    try:
        done = layer.Export(str(path))
    except Tf.ErrorException as error:
        raise OutputError(f"{path.parent} could not be written, or the disk is full; nothing was changed.") from error
    if not done:
        raise OutputError(f"{path.parent} could not be written; nothing was changed.")


def _write_prim(parent: Sdf.PrimSpec, prim: Prim, pictures: _Pictures) -> None:
    spec = Sdf.PrimSpec(parent, prim.name, Sdf.SpecifierDef, prim.type)
    if prim.data:
        spec.customData = {"tress": dict(prim.data)}
    if prim.api_schemas:
        spec.SetInfo("apiSchemas", Sdf.TokenListOp.Create(prependedItems=list(prim.api_schemas)))
    for name, attribute in prim.attributes.items():
        _write_attribute(spec, name, attribute, pictures)
    for name, target in prim.relationships.items():
        Sdf.RelationshipSpec(spec, name, custom=False).targetPathList.explicitItems = [_absolute(spec, target)]
    for child in prim.children:
        _write_prim(spec, child, pictures)


def _write_attribute(prim: Sdf.PrimSpec, name: str, attribute: Attribute, pictures: _Pictures) -> None:
    kind = Sdf.ValueTypeNames.Find(attribute.type)
    variability = Sdf.VariabilityUniform if attribute.uniform else Sdf.VariabilityVarying
    custom = name.startswith("tress:")
    spec = Sdf.AttributeSpec(prim, name, kind, variability, custom)
    if attribute.value is not None:
        spec.default = _usd_value(kind, attribute.value, pictures)
    if attribute.interpolation:
        spec.SetInfo("interpolation", attribute.interpolation)
    if attribute.element_size != 1:
        spec.SetInfo("elementSize", attribute.element_size)
    if attribute.shape:
        spec.customData = {"tress": {"shape": Vt.IntArray(list(attribute.shape))}}
    if attribute.connection:
        spec.connectionPathList.explicitItems = [_absolute(prim, attribute.connection)]


def _absolute(prim: Sdf.PrimSpec, path: str) -> Sdf.Path:
    return Sdf.Path(path.removeprefix("./")).MakeAbsolutePath(prim.path)


def _usd_value(kind: Sdf.ValueTypeName, value: Any, pictures: _Pictures) -> Any:
    if isinstance(value, Picture):
        return Sdf.AssetPath(pictures.add(value))
    if isinstance(value, tuple):
        return Vt.TokenArray(list(value))
    if not isinstance(value, np.ndarray):
        return value
    if kind.isArray:
        return type(kind.defaultValue).FromNumpy(value)
    return Gf.Matrix4d(value.tolist()) if kind == Sdf.ValueTypeNames.Matrix4d else Gf.Vec2f(*value.tolist())


def _read_prim(spec: Sdf.PrimSpec, folder: Path) -> Prim:
    data = spec.customData.get("tress", {})
    return Prim(
        spec.name,
        spec.typeName,
        dict(_read_attributes(spec, folder)),
        children=tuple(_read_prim(child, folder) for child in spec.nameChildren),
        data=data if isinstance(data, dict) else {},
    )


def _read_attributes(spec: Sdf.PrimSpec, folder: Path) -> Iterator[tuple[str, Attribute]]:
    for attribute in spec.attributes:
        shape = attribute.customData.get("tress", {}).get("shape", ()) if attribute.customData else ()
        yield (
            attribute.name,
            Attribute(
                str(attribute.typeName),
                _plain_value(attribute.typeName, attribute.default, folder),
                interpolation=str(attribute.GetInfo("interpolation")) if attribute.HasInfo("interpolation") else "",
                shape=tuple(int(size) for size in shape),
            ),
        )


def _plain_value(kind: Sdf.ValueTypeName, value: Any, folder: Path) -> Any:
    if isinstance(value, Sdf.AssetPath):
        return _read_picture(folder, value.path)
    if isinstance(value, Sdf.ValueBlock):
        return None
    if kind.isArray and value is not None:
        return tuple(value) if isinstance(value, Vt.TokenArray | Vt.StringArray) else np.array(value)
    return value


def _read_picture(folder: Path, name: str) -> Picture:
    path = (folder / name).resolve()
    if not path.is_relative_to(folder.resolve()):
        raise FormatError(f"Picture {name!r} lies outside the folder of the file.")
    return Picture(decode_png(read_bytes(path), name=name))


def _escaped(name: str) -> str:
    return "".join(f"[{letter}]" if letter in "*?[" else letter for letter in name)

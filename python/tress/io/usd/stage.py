"""Prims to and from USD files: the only module that knows `pxr`.

Layers are written through `Sdf`, which takes arrays by their memory and composes nothing: 50,000 strands take a
fraction of a second. Pictures lie in a folder `textures` beside the file, named by their content, so that replacing
the file is what makes a new state visible, and a crash before leaves the old file with its old pictures.
"""

# pyright: reportAttributeAccessIssue=false
# `pxr` comes without type stubs.

import hashlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Tf, Usd, UsdGeom, UsdValidation, Vt

from tress.base.errors import FormatError, OutputError
from tress.io.atomic import atomic_path, write_bytes
from tress.io.file_bytes import read_bytes
from tress.io.png import decode_png, encode_png
from tress.io.usd.prim import Attribute, Picture, Prim

ROOT = "tress"
TEXTURES = "textures"
SUFFIXES = (".usdc", ".usda", ".usd")
FRAMES_PER_SECOND = 24.0


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
        _write_time_range(layer, prims)
    pictures.write()
    with atomic_path(path) as temporary:
        _export(layer, temporary)
    pictures.remove_others()


def read_stage(path: Path) -> tuple[list[Prim], dict[str, Any]]:
    """The prims under the root, and the metadata of the file. Raises `FormatError` where Tress did not write it."""
    _expect_file(path)
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


def pictures_of(path: Path) -> list[Path]:
    """The pictures that were written beside a file for it, those of its earlier versions too."""
    return sorted((path.parent / TEXTURES).glob(f"{_escaped(path.name)}.{'[0-9a-f]' * 16}.png"))


@dataclass(frozen=True)
class ForeignPrim:
    """A prim of another program's file; `world_from_prim` (4, 4) leads to metres, Y up."""

    prim: Prim
    world_from_prim: np.ndarray[Any, Any]


def read_foreign(path: Path, *, type_name: str) -> list[ForeignPrim]:
    """All prims of one type in a file that any program wrote, composed, with time samples in seconds.

    Prims that move as a whole are where they are at rest. Raises `FormatError` where it is no USD file.
    """
    try:
        stage = Usd.Stage.Open(str(path))
        scale, z_up = UsdGeom.GetStageMetersPerUnit(stage), UsdGeom.GetStageUpAxis(stage) == "Z"
        found = [prim for prim in stage.Traverse() if prim.GetTypeName() == type_name]
        return [ForeignPrim(_composed(prim), _axes(scale, z_up) @ _world_from_prim(prim)) for prim in found]
    except Tf.ErrorException as error:
        raise FormatError(f"{path} is no USD file, or it is damaged.") from error


def _axes(scale: float, z_up: bool) -> np.ndarray[Any, Any]:
    """Metres and Y up from a stage's units and axes."""
    turn = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]) if z_up else np.eye(3)
    matrix = np.eye(4)
    matrix[:3, :3] = scale * turn
    return matrix


def _world_from_prim(prim: Usd.Prim) -> np.ndarray[Any, Any]:
    # USD multiplies row vectors.
    return np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(Usd.TimeCode.Default())).T


def _composed(prim: Usd.Prim) -> Prim:
    rate = prim.GetStage().GetTimeCodesPerSecond()
    attributes = {}
    for attribute in prim.GetAuthoredAttributes():
        kind = attribute.GetTypeName()
        samples = {time / rate: _plain(kind, attribute.Get(time)) for time in attribute.GetTimeSamples()}
        attributes[attribute.GetName()] = Attribute(str(kind), _plain(kind, attribute.Get()), samples=samples)
    return Prim(prim.GetName(), prim.GetTypeName(), attributes)


def _plain(kind: Sdf.ValueTypeName, value: Any) -> Any:
    return None if isinstance(value, Sdf.AssetPath) else _plain_value(kind, value, Path())


def validation_errors(path: Path) -> list[str]:
    """What USD's own validators say against a file: empty if nothing."""
    stage = Usd.Stage.Open(str(path))
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    found = UsdValidation.ValidationContext(validators).Validate(stage)
    return [f"{error.GetIdentifier()}: {error.GetMessage()}" for error in found]


def written_by_tress(path: Path) -> bool:
    """Whether a file holds a document of Tress. Raises `FormatError` where it is no USD file."""
    _expect_file(path)
    try:
        layer = Sdf.Layer.OpenAsAnonymous(str(path), metadataOnly=True)
        return isinstance(layer.customLayerData.get("tress") if layer else None, dict)
    except Tf.ErrorException as error:
        raise FormatError(f"{path} is no USD file, or it is damaged.") from error


def _expect_file(path: Path) -> None:
    if not path.is_file():
        raise FormatError(f"{path} is no file; a USD file was expected.")


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
        for file in pictures_of(self._folder.parent / self._file):
            if file.name not in self._encoded:
                file.unlink(missing_ok=True)


def _export(layer: Sdf.Layer, path: Path) -> None:
    try:
        done = layer.Export(str(path))
    except Tf.ErrorException as error:
        raise OutputError(f"{path.parent} could not be written, or the disk is full; nothing was changed.") from error
    if not done:
        raise OutputError(f"{path.parent} could not be written; nothing was changed.")


def _write_time_range(layer: Sdf.Layer, prims: Iterable[Prim]) -> None:
    times = sorted(set(_times(prims)))
    if times:
        layer.pseudoRoot.SetInfo("timeCodesPerSecond", FRAMES_PER_SECOND)
        layer.pseudoRoot.SetInfo("framesPerSecond", FRAMES_PER_SECOND)
        layer.pseudoRoot.SetInfo("startTimeCode", times[0] * FRAMES_PER_SECOND)
        layer.pseudoRoot.SetInfo("endTimeCode", times[-1] * FRAMES_PER_SECOND)


def _times(prims: Iterable[Prim]) -> Iterator[float]:
    for prim in prims:
        for attribute in prim.attributes.values():
            yield from attribute.samples
        yield from _times(prim.children)


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
    for time, value in attribute.samples.items():
        prim.layer.SetTimeSample(spec.path, time * FRAMES_PER_SECOND, _usd_value(kind, value, pictures))
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
    if kind == Sdf.ValueTypeNames.Matrix4d:
        return Gf.Matrix4d(value.tolist())
    return (Gf.Vec2d if kind == Sdf.ValueTypeNames.Double2 else Gf.Vec2f)(*value.tolist())


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
    return np.array(value) if type(value).__module__.startswith("pxr.") else value


def _read_picture(folder: Path, name: str) -> Picture:
    path = (folder / name).resolve()
    if not path.is_relative_to(folder.resolve()):
        raise FormatError(f"Picture {name!r} lies outside the folder of the file.")
    if not path.is_file():
        raise FormatError(
            f"{path} is missing; the folder {path.parent.name} belongs beside the file and moves with it."
        )
    return Picture(decode_png(read_bytes(path), name=name))


def _escaped(name: str) -> str:
    return "".join(f"[{letter}]" if letter in "*?[" else letter for letter in name)

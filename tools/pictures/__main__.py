"""Makes every picture of README and documentation anew: `make pictures`.

Pictures of portraits that are not there are left as they are, and named. `python -m tools.pictures stages_and_preview`
makes only those of one function, or of several.
"""

import json
import sys
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from tools.pictures.cartoon import cartoon_hair
from tools.pictures.corrections import DEPTHS, LANDMARKS, STROKES
from tools.pictures.photos import ASTRONAUT, photo
from tools.pictures.presets import strips_presets
from tools.pictures.runs import Run, first_run
from tools.pictures.sheets import rows, save, side_by_side, with_points, with_strokes
from tools.pictures.strips import keyframes_wind, levels_of_detail
from tools.pictures.toon import toon_shading
from tress.methods.portrait.pipeline import STAGES

PREVIEWS: Mapping[str, str] = {"preview_bob": "001", "preview_long": "031"}
LIMITS: Mapping[str, str] = {"limit_updo": "041", "limit_profile": "008", "limit_short": "022", "limit_hands": "036"}
FIRST_ROW, SECOND_ROW = ("head", "layers", "orientation"), ("trace", "depth", "strands")
CAPTIONS: Mapping[str, tuple[str, ...]] = {
    "matte": ("03 matte: alpha", "the hair's own colour"),
    "color": ("09 color: photo", "rendered"),
}


def main() -> None:
    """Runs what is named, or everything; some minutes."""
    portraits = (stages_and_preview, previews, correct_layers, correct_landmarks, correct_depth)
    everything = (*portraits, cartoon_hair, strips_presets, keyframes_wind, levels_of_detail, toon_shading)
    wanted = sys.argv[1:] or [make.__name__ for make in everything]
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for make in everything:
            if make.__name__ in wanted:
                make(folder)


def stages_and_preview(folder: Path) -> None:
    """The astronaut: preview, a picture for each stage, and all of them together."""
    run = _run(ASTRONAUT, folder)
    assert run is not None
    save(run.picture("preview.png"), "preview_astronaut")
    box = run.head_box()
    sheets = {}
    for number, stage in enumerate(STAGES, 1):
        panels = run.stage_panels(stage.name, box=box)
        captions = CAPTIONS.get(stage.name, (f"{number:02d} {stage.name}",))
        sheets[stage.name] = side_by_side(panels, captions[: len(panels)])
        save(sheets[stage.name], f"stage_{stage.name}")
    first = [side_by_side([_pixels(run.photo)[box]], ["photo"]), *(sheets[name] for name in FIRST_ROW)]
    rendered = side_by_side([run.stage_panels("color", box=box)[-1]], ["09 color"])
    second = [*(sheets[name] for name in SECOND_ROW), rendered]
    save(rows([np.concatenate(first, axis=1), np.concatenate(second, axis=1)]), "stages")


def previews(folder: Path) -> None:
    """The preview of other portraits, good ones and bad ones."""
    for name, number in {**PREVIEWS, **LIMITS}.items():
        run = _run(number, folder)
        if run is not None:
            save(run.picture("preview.png"), name)


def correct_layers(folder: Path) -> None:
    """Strokes that mend the layers, before and after."""
    _before_and_after(
        STROKES,
        folder,
        name="correct_layers",
        option="--strokes",
        stage="layers",
        drawn=lambda pixels, content: with_strokes(pixels, content["strokes"]),
        looks=("layers", "preview"),
    )


def correct_landmarks(folder: Path) -> None:
    """Named points that place the head, before and after."""
    _before_and_after(
        LANDMARKS,
        folder,
        name="correct_landmarks",
        option="--landmarks",
        stage="head",
        drawn=with_points,
        looks=("head",),
    )


def correct_depth(folder: Path) -> None:
    """Marks of known depth, before and after."""
    _before_and_after(
        DEPTHS,
        folder,
        name="correct_depth",
        option="--depth-strokes",
        stage="depth",
        drawn=lambda pixels, content: with_strokes(pixels, content["strokes"]),
        looks=("depth", "preview"),
    )


def _before_and_after(
    correction: tuple[str, Any],
    folder: Path,
    *,
    name: str,
    option: str,
    stage: str,
    drawn: Callable[[Any, Any], Any],
    looks: tuple[str, ...],
) -> None:
    """The correction over the photo, and what is seen of the stages `looks` without and with it."""
    number, content = correction
    run = _run(number, folder)
    if run is None:
        return
    box = run.head_box()
    before = [_look(run, look, box) for look in looks]
    file = folder / f"{name}.json"
    file.write_text(json.dumps(content))
    run.again(option, file, "--from-stage", stage)
    after = [_look(run, look, box) for look in looks]
    pictures, captions = [drawn(_pixels(run.photo), content)[box]], [option]
    for look, old, new in zip(looks, before, after, strict=True):
        pictures += [old, new]
        shown = "+30 degrees" if look == "preview" else look
        captions += [f"{shown}, before", f"{shown}, after"]
    save(side_by_side(pictures, captions), name)


def _look(run: Run, stage: str, box: tuple[slice, slice]) -> Any:
    """The last panel of a stage; of the preview, the view from +30 degrees."""
    if stage == "preview":
        return _turned(run.picture("preview.png"))
    return run.stage_panels(stage, box=box)[-1]


def _turned(preview: Any) -> Any:
    """The fourth of the preview's pictures: the last but one."""
    width = round(0.8 * 640)
    end = preview.shape[1] - width - 2 * 8
    return preview[8 : 8 + 640, end - width : end]


def _run(number: str, folder: Path) -> Run | None:
    path = photo(number, folder)
    if path is None:
        print(f"portrait {number} is absent; its pictures stay as they are", flush=True)
        return None
    return first_run(path, folder)


def _pixels(path: Path) -> Any:
    return np.asarray(Image.open(path).convert("RGB"))


if __name__ == "__main__":
    main()

"""A GLB file as headless Chromium with three.js shows it; skipped where either is not installed."""

import base64
import io
import json
import queue
import shutil
import subprocess
from dataclasses import dataclass
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread

import numpy as np
import pytest
from PIL import Image

WEB = Path(__file__).parent / "web"
BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
FLAGS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--no-first-run",
    "--disable-background-networking",
)
LIMIT_SECS = 90


@dataclass(frozen=True)
class Shown:
    """Names of the meshes in the scene, clips as (name, seconds), pictures (H, W, 3) uint8, the affine camera (3, 4)
    that took them, to pixels, and complaints.

    The background is blue, the head green, both without light.
    """

    meshes: list[str]
    clips: list[tuple[str, float]]
    pictures: list[np.ndarray]
    xy_from_world: np.ndarray
    errors: list[str]

    def hair(self, number):
        """(H, W) float32 in [0, 1]: how much of each pixel of a picture is hair, neither blue nor green."""
        picture = self.pictures[number].astype(np.float32) / 255
        return 1 - np.clip(picture[..., 1] + picture[..., 2] - 2 * picture[..., 0], 0, 1)


def shown_by_three(path, tmp_path):
    """What three.js shows of a GLB file at 0 and at 0.5 seconds of its clip."""
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        pytest.skip("no Chromium is installed; on Debian `apt-get install chromium` does it")
    if not (WEB / "node_modules" / "three").exists():
        pytest.skip("three is not installed; `make setup` does it")
    results = queue.Queue()
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(_Handler, results, Path(path), directory=str(WEB)))
    Thread(target=server.serve_forever, daemon=True).start()
    address = f"http://127.0.0.1:{server.server_port}/view_glb.html"
    command = [browser, *FLAGS, f"--user-data-dir={tmp_path / 'browser'}", address]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        found = json.loads(results.get(timeout=LIMIT_SECS))
    finally:
        process.terminate()
        process.wait(timeout=20)
        server.shutdown()
        server.server_close()
    pictures = [_pixels(url) for url in found.get("pictures", [])]
    return Shown(
        meshes=found.get("meshes", []),
        clips=[(clip["name"], clip["seconds"]) for clip in found.get("clips", [])],
        pictures=pictures,
        xy_from_world=_xy_from_world(found["clipFromWorld"], pictures[0].shape) if pictures else np.zeros((3, 4)),
        errors=found["errors"],
    )


def _xy_from_world(clip_from_world, shape):
    clip = np.array(clip_from_world).reshape(4, 4)
    height, width = shape[:2]
    across = (clip[0] + clip[3]) * width / 2
    down = (clip[3] - clip[1]) * height / 2
    return np.stack([across, down, clip[3]])


def _pixels(url):
    data = base64.b64decode(url.split(",", 1)[1])
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGB"))


class _Handler(SimpleHTTPRequestHandler):
    """The page, three.js and the model; takes the result."""

    def __init__(self, results, model, *arguments, **options):
        self._results, self._model = results, model
        super().__init__(*arguments, **options)

    def do_GET(self):
        if self.path != "/model.glb":
            super().do_GET()
            return
        data = self._model.read_bytes()
        self.send_response(200)
        self.send_header("Content-Type", "model/gltf-binary")
        self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        self.wfile.write(data)

    def do_POST(self):
        self._results.put(self.rfile.read(int(self.headers["Content-Length"])))
        self.send_response(204)
        self.end_headers()

    def log_message(self, *_arguments):
        pass

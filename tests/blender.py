"""What Blender reads of a file, by the module `bpy` in an environment of its own; skipped where there is none.

`bpy` is large and under the GPL, so it is a tool of the tests and no dependency: `TRESS_BPY_PYTHON` names a Python that
has it, else the Python of the tests is tried.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parent / "blender_import.py"


def blender_report(path):
    """Meshes of the file by name: vertices, shape keys, and how far a vertex moves within a second (metres)."""
    python = os.environ.get("TRESS_BPY_PYTHON", sys.executable)
    found = subprocess.run([python, "-c", "import bpy"], capture_output=True, timeout=120, check=False)
    if found.returncode:
        pytest.skip("no bpy; `pip install bpy` into an environment of its own, and name its Python in TRESS_BPY_PYTHON")
    done = subprocess.run([python, str(SCRIPT), str(path)], capture_output=True, text=True, timeout=180, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout.strip().splitlines()[-1])

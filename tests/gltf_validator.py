"""The Khronos glTF validator, run by Node; `make setup` installs it."""

import json
import subprocess
from pathlib import Path

import pytest

WEB = Path(__file__).parent / "web"


def validator_report(path):
    """What the validator says of a GLB file; the test is skipped where the validator is not installed."""
    if not (WEB / "node_modules" / "gltf-validator").exists():
        pytest.skip("gltf-validator is not installed; `make setup` does it")
    done = subprocess.run(
        ["node", str(WEB / "validate_glb.mjs"), str(path)], capture_output=True, text=True, timeout=60, check=True
    )
    return json.loads(done.stdout)

"""The program under test, and a place for its files."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture(scope="session")
def program() -> Path:
    """The command line, built if it is not there or not new."""
    subprocess.run(["cargo", "build", "--quiet"], cwd=ROOT, check=True)
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    return target / "debug" / "vtu2contour"


@pytest.fixture
def contour(program, tmp_path):
    """Contours a file: ``contour(input, *options)`` gives the path of the lines."""

    def run(source: Path, *options: str, name: str = "lines.vtp") -> Path:
        output = tmp_path / name
        command = [program, source, "-o", output, *options]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return output

    return run

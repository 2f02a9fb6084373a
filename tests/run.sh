#!/usr/bin/env bash
# Builds the project and passes every test. Needs Rust, a C compiler and Python >= 3.9
# with venv; the rest is installed here: Python packages into .venv, and, as root on Debian,
# the X and GL libraries that gmsh links, and ParaView with a display and MPI. Elsewhere the
# tests in ParaView are left out where it is missing, and pytest says so.
set -euo pipefail
cd "$(dirname "$0")/.."

step() { printf '\n== %s\n' "$*"; }

step "Python packages"
if ! cmp -s <(cat tests/requirements.txt samples/requirements.txt) .venv/installed 2>/dev/null; then
    python3 -m venv .venv
    .venv/bin/python -m pip install --quiet --disable-pip-version-check -r tests/requirements.txt
    cat tests/requirements.txt samples/requirements.txt > .venv/installed
fi
if ! .venv/bin/python -c 'import gmsh' 2>/dev/null; then
    libraries="libglu1-mesa libgl1 libxrender1 libxcursor1 libxft2 libxinerama1 libgomp1"
    if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
        apt-get update -qq
        DEBIAN_FRONTEND=noninteractive apt-get install -qq --no-install-recommends $libraries
    else
        echo "gmsh cannot be loaded; install its libraries, on Debian: apt-get install $libraries" >&2
        exit 1
    fi
fi

if ! command -v pvpython >/dev/null && [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
    step "ParaView"
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -qq --no-install-recommends \
        paraview python3-paraview xvfb xauth openmpi-bin >/dev/null
fi

step "Format and lints"
cargo fmt --all --check
cargo clippy --quiet --workspace --all-targets -- -D warnings
.venv/bin/ruff check .
.venv/bin/ruff format --check .

step "Rust tests"
cargo test --quiet

step "Documentation"
RUSTDOCFLAGS="-D warnings" cargo doc --quiet --no-deps

step "Python module"
# as the tests' other programs: built sooner, and slower, than for use
MATURIN_PEP517_ARGS="--profile dev" .venv/bin/python -m pip install --quiet \
    --disable-pip-version-check --no-deps --force-reinstall .

step "Python tests"
.venv/bin/python -m pytest -rs

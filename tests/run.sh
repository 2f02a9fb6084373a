#!/usr/bin/env bash
# Builds the project and passes every test. Needs Rust, a C compiler and Python >= 3.9
# with venv; the rest is installed here: Python packages into .venv, and, where gmsh
# cannot load them, the X and GL libraries it links (Debian packages, as root).
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

step "Format and lints"
cargo fmt --check
cargo clippy --quiet --all-targets -- -D warnings
.venv/bin/ruff check .
.venv/bin/ruff format --check .

step "Rust tests"
cargo test --quiet

step "Documentation"
RUSTDOCFLAGS="-D warnings" cargo doc --quiet --no-deps

step "Python tests"
.venv/bin/python -m pytest

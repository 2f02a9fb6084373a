#!/usr/bin/env bash
# Contours, ours beside VTK's, ParaView's and matplotlib's: prints a Markdown table of medians and
# ratios. Does its own set-up, in folders of its own: Python packages in target/benches, the module
# and the program built for use. ParaView's case needs pvpython (tests/run.sh installs it).
#
#   bash benches/run.sh [--rounds N] [--threads N] [--size CELLS] [--only CASE,...]
set -euo pipefail
cd "$(dirname "$0")/.."

venv=target/benches/venv
if ! cmp -s tests/requirements.txt "$venv/installed" 2>/dev/null; then
    python3 -m venv "$venv"
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check -r tests/requirements.txt
    cp tests/requirements.txt "$venv/installed"
fi
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps \
    --force-reinstall . >&2
cargo build --quiet --release >&2

exec "$venv/bin/python" benches/contours.py --program target/release/vtu2contour "$@"

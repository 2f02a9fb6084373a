#!/usr/bin/env bash
# Installs the Python module and the plugin for ParaView, and checks that ParaView has both.
#
#     bash paraview/install.sh [FOLDER]       default: ~/.local/share/vtu2contour
#
# FOLDER/python holds the module and belongs on PYTHONPATH; FOLDER/plugins holds the plugin and
# belongs on PV_PLUGIN_PATH. Needs Rust and a Python (>= 3.9) with pip, or what PYTHON names: the
# module serves any version of Python, so it need not be ParaView's. PVPYTHON names ParaView's
# pvpython, if it is not on the PATH.
set -euo pipefail
sources=$(cd "$(dirname "$0")/.." && pwd)
folder=${1:-$HOME/.local/share/vtu2contour}
python=${PYTHON:-python3}
pvpython=${PVPYTHON:-pvpython}

fail() { echo "install.sh: $*" >&2; exit 1; }

"$python" -m pip --version >/dev/null 2>&1 || fail "$python has no pip; name one that has by PYTHON=..."
command -v cargo >/dev/null || fail "Rust is missing: see https://rustup.rs"
command -v "$pvpython" >/dev/null || fail "no pvpython; name ParaView's by PVPYTHON=/.../bin/pvpython"

mkdir -p "$folder/python" "$folder/plugins"
# without NumPy, which ParaView has: another beside its own could not be loaded
"$python" -m pip install --quiet --disable-pip-version-check --no-deps --upgrade \
    --target "$folder/python" "$sources"
cp "$sources/paraview/vtu2contour_plugin.py" "$folder/plugins/"

# ParaView before 5.12 cannot load any Python plugin with Python 3.11 and later, for it looks for
# a function that this Python has no more
version=$("$pvpython" --version 2>&1 | grep -oE '[0-9]+\.[0-9]+' | head -1)
if [ "$(printf '%s\n5.12\n' "$version" | sort -V | head -1)" != 5.12 ]; then
    cp "$sources/paraview/sitecustomize.py" "$folder/python/"
fi

found=$(PYTHONPATH="$folder/python" "$pvpython" "$sources/paraview/check.py" \
    "$folder/plugins/vtu2contour_plugin.py" 2>&1) || true
case $found in
*"DEI Contour works"*) ;;
*) printf '%s\n' "$found" >&2; fail "ParaView $version does not have the filter" ;;
esac
cat <<DONE
DEI Contour works in ParaView $version. Start it with

    PYTHONPATH=$folder/python PV_PLUGIN_PATH=$folder/plugins paraview
DONE

#!/bin/sh
# `make demo`: the demo in the bpy module where there is a Python 3.11, else in the Blender on the PATH.
set -e
cd "$(dirname "$0")/.."

if python=$(sh tools/find_python.sh 2>.python-missing); then
    rm -f .python-missing
    "$python" tools/environments.py bpy-4.5
    exec .venv-bpy-4.5/bin/python -m risorius demo --out out "$@"
fi

missing=$(cat .python-missing)
rm -f .python-missing
if command -v blender >/dev/null 2>&1; then
    echo "No Python 3.11 here; using $(command -v blender)."
    exec blender --background --factory-startup --python-exit-code 1 --python tools/in_blender.py -- demo --out out "$@"
fi
echo "$missing" >&2
exit 1

#!/bin/sh
# `make demo`: the demo in the bpy module where there is a Python that has one, else in the Blender on the PATH.
set -e
cd "$(dirname "$0")/.."

if python=$(sh tools/find_python.sh 3.11 3.13 2>.python-missing); then
    rm -f .python-missing
    case $("$python" -c 'import sys; print(sys.version_info[1])') in
        11) blender=bpy-4.5 ;;
        *) blender=bpy-5.3 ;;
    esac
    "$python" tools/environments.py "$blender"
    exec ".venv-$blender/bin/python" -m risorius demo --out out "$@"
fi

missing=$(cat .python-missing)
rm -f .python-missing
if command -v blender >/dev/null 2>&1; then
    echo "No Python here that has a bpy module; using $(command -v blender)."
    exec blender --background --factory-startup --python-exit-code 1 --python tools/in_blender.py -- demo --out out "$@"
fi
echo "$missing" >&2
exit 1

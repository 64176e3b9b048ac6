#!/bin/sh
# find_python.sh [VERSION ...]: print the path of a Python of one of these versions, the first of them that is here.
# Without versions, any that Risorius runs on. Looks on the PATH, in pyenv and in uv, then lets uv fetch the first
# version, then looks inside a Blender on the PATH. Without one, says what is missing and exits 1.
# PYTHON=/path/to/python goes before all others.

# Blender 4.2 to 5.0 have Python 3.11, later ones 3.13: with these there is a bpy module to test on.
known="3.11 3.13 3.12 3.14"
versions=${*:-$known}

version_of() {
    "$1" -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null
}

is_one_of() {  # PYTHON VERSION ...
    found=$(version_of "$1") || return 1
    shift
    for version in "$@"; do [ "$found" = "$version" ] && return 0; done
    return 1
}

if [ -n "$PYTHON" ]; then
    if is_one_of "$PYTHON" $versions; then command -v "$PYTHON"; exit 0; fi
    if [ $# -eq 0 ]; then
        echo "PYTHON=$PYTHON is no Python 3.11 to 3.14." >&2
        exit 1
    fi
fi

for version in $versions; do
    # A command of pyenv stands on the PATH, and runs, only for the versions that pyenv is told to use.
    for name in "python$version" python3 python; do
        if command -v "$name" >/dev/null 2>&1 && is_one_of "$name" "$version"; then command -v "$name"; exit 0; fi
    done
    if command -v pyenv >/dev/null 2>&1; then
        installed=$(pyenv whence "python$version" 2>/dev/null | tail -n 1)
        if [ -n "$installed" ] && PYENV_VERSION=$installed pyenv which "python$version" 2>/dev/null; then exit 0; fi
    fi
    if command -v uv >/dev/null 2>&1 && uv python find --no-project --system "$version" 2>/dev/null; then exit 0; fi
done

notes=""
first=${versions%% *}
if command -v uv >/dev/null 2>&1; then
    echo "Fetching Python $first with uv ..." >&2
    uv python install "$first" >&2 && uv python find --no-project --system "$first" && exit 0
    notes=" uv could not fetch one (its message is above)."
fi

if command -v blender >/dev/null 2>&1; then
    inner=$(blender --background --factory-startup --python-expr \
        'import sys; print("risorius-python", sys.executable)' 2>/dev/null | sed -n 's/^risorius-python //p')
    if [ -n "$inner" ] && is_one_of "$inner" $versions; then echo "$inner"; exit 0; fi
    notes="$notes The Blender on the PATH brings another Python."
fi

several=$(echo "$versions" | sed 's/ \([^ ]*\)$/_or_\1/; s/ /, /g; s/_/ /g')
cat >&2 <<MESSAGE
Found no Python $several.$notes One of these will do:
  - Python $first on the PATH as python$first (or PYTHON=/path/to/python$first make ...);
  - uv on the PATH, which fetches Python $first by itself;
  - for 'make demo' alone: Blender 4.2 or later on the PATH as blender.
MESSAGE
exit 1

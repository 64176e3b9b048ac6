#!/bin/sh
# Print the path of a Python 3.11: on the PATH, from uv, or inside a Blender (4.2 to 5.0 bring it).
# Without one, say what is missing and exit 1.

is_311() {
    [ "$("$1" -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null)" = "3.11" ]
}

if [ -n "$PYTHON" ]; then
    if is_311 "$PYTHON"; then command -v "$PYTHON"; exit 0; fi
    echo "PYTHON=$PYTHON is not a Python 3.11." >&2
    exit 1
fi

notes=""
for name in python3.11 python3 python; do
    if command -v "$name" >/dev/null 2>&1 && is_311 "$name"; then command -v "$name"; exit 0; fi
done

if command -v uv >/dev/null 2>&1; then
    uv python find --no-project --system 3.11 2>/dev/null && exit 0
    echo "Fetching Python 3.11 with uv ..." >&2
    uv python install 3.11 >&2 && uv python find --no-project --system 3.11 && exit 0
    notes=" uv could not fetch one (its message is above)."
fi

if command -v blender >/dev/null 2>&1; then
    inner=$(blender --background --factory-startup --python-expr \
        'import sys; print("risorius-python", sys.executable)' 2>/dev/null | sed -n 's/^risorius-python //p')
    if [ -n "$inner" ] && is_311 "$inner"; then echo "$inner"; exit 0; fi
    notes="$notes The Blender on the PATH brings another Python."
fi

cat >&2 <<MESSAGE
Found no Python 3.11.$notes One of these will do:
  - Python 3.11 on the PATH as python3.11 (or PYTHON=/path/to/python3.11 make ...);
  - uv on the PATH, which fetches Python 3.11 by itself;
  - for 'make demo' alone: Blender 4.2 or later on the PATH as blender.
MESSAGE
exit 1

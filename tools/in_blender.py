"""Run the command line of this checkout inside a Blender:

    blender --background --python-exit-code 1 --python tools/in_blender.py -- VERB ...

Fetches SciPy for Blender's Python into .cache/ where that Python has none.
"""

from __future__ import annotations

import importlib
import subprocess
import sys
from pathlib import Path


def provide_scipy() -> None:
    """Make SciPy importable: Blender's own, or one fetched for this Python (never NumPy: Blender brings it)."""
    try:
        import scipy  # noqa: F401
    except ImportError:
        python = f"{sys.version_info.major}.{sys.version_info.minor}"
        folder = Path(__file__).resolve().parent.parent / ".cache" / f"scipy-{python}"
        sys.path.append(str(folder))
        if (folder / "scipy").is_dir():
            return
        print(f"Fetching SciPy for Blender's Python into {folder} ...", flush=True)
        newest = "scipy<1.16" if sys.version_info < (3, 13) else "scipy"
        subprocess.run([sys.executable, "-m", "ensurepip"], stdout=subprocess.DEVNULL, check=False)
        fetch = [sys.executable, "-m", "pip", "install", "--no-deps", "--only-binary=:all:", "--target", str(folder)]
        if subprocess.run([*fetch, newest], check=False).returncode:
            sys.exit("SciPy could not be fetched (pip's message is above); install it for Blender's Python")
        importlib.invalidate_caches()


def main(arguments: list[str]) -> int:
    """Run one verb of the command line."""
    import bpy

    if bpy.app.version < (4, 2, 0):
        sys.exit(f"This is Blender {bpy.app.version_string}; Risorius needs 4.2 or later")
    sys.path.insert(0, str(Path(__file__).resolve().parent))
    from environments import ensure_link

    sys.path.insert(0, str(ensure_link()))
    provide_scipy()
    command_line = importlib.import_module("risorius.cli")
    return int(command_line.main(arguments))


if __name__ == "__main__":
    sys.exit(main(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []))

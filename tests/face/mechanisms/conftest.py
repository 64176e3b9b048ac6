"""The claims about mechanisms, which test_mechanisms.py holds the faces to, are a package beside it."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

"""What moves a face, one mechanism per file, and the switch that leaves any of them out.

switch        the names of all mechanisms
"""

from .switch import ADDITIONS, EVERY, MUSCLE_GROUPS, Mechanism, named

__all__ = ["ADDITIONS", "EVERY", "MUSCLE_GROUPS", "Mechanism", "named"]

"""What each mechanism is for: figures of a posed face that are above a limit with it, and below without it.

claim      a claim; ways to move a face and see how far it goes
skin       what the skin does beyond the second paper's membrane
pulls      how muscles pull
turning    what turns as a body, and what meets
groups     groups of muscles
"""

from __future__ import annotations

from . import groups, pulls, skin, turning

CLAIMS = (*skin.CLAIMS, *pulls.CLAIMS, *turning.CLAIMS, *groups.CLAIMS)

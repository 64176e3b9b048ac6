"""The data card: what labels are, how they were made, with what, and what they are not."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from .areas import ABOUT, Area
from .tables import Table

#: What is known not to hold, for whoever trains or measures on the labels.
LIMITS = (
    "Faces are rendered models moved by a model of muscles. They tell what a method does with these, not with people.",
    "Emotion words name what was asked of the face. No person felt or named it.",
    "FAPs achieved are measured on the very mesh of the frame, before any subdivision. Contractions and planned action "
    "units drive the motion; inertia and elasticity of the skin lie between them and the frame.",
    "Explained action units are the mixture that best explains the FAPs achieved; several mixtures may explain "
    "one face.",
    "Whether a landmark is hidden is told by meshes. Hair made of curves, volumes, depth of field, motion blur and "
    "pictures in alpha (cards of hair) are not heeded. Materials that are clear as a whole are looked through.",
    "Recognised emotions are read off the FAPs achieved; the columns beside them tell what was asked for.",
    "Strengths of visemes are shares by the model of coarticulation, not measures of the mouth.",
    "Landmarks of MediaPipe and iBUG are marks on the skin that stay where they are on it. MediaPipe itself sees them "
    "3 to 6 per cent of the eyes' distance away (docs/labels.md), more on outlines.",
    "Pictures of areas, objects, depth and normals show what the middle of each pixel meets; a render is smoothed over "
    "the whole pixel.",
)

HOW = {
    "camera": "Pinhole, no distortion. Pixels from the upper left corner, x right, y down, the middle of the "
    "first pixel at (0.5, 0.5). Camera axes: x right, y down, z away from the camera. camera = R world + t; "
    "pixel = K camera / camera z.",
    "world": "The scene's own axes (Blender: z up), in metres.",
    "faps": "MPEG-4 facial animation parameters 3 to 68 in FAP units: 1/1024 of a distance on the face, or 1e-5 rad.",
    "areas": "8 bits: numbers of areas, listed in card.json.",
    "objects": "16 bits: 0 nothing, else the place of the object in the list of card.json, from 1.",
    "depth": "16 bits: distance along the camera's z axis in steps of depth_step (table frames), metres; 0: nothing.",
    "normals": "16 bits, red, green, blue: unit normal in the camera's axes: value / 65535 * 2 - 1; black: none.",
}


@dataclass(frozen=True)
class Card:
    """What is known of a folder of labels; a mapping that JSON can hold."""

    facts: Mapping[str, object]

    @classmethod
    def of(cls, **facts: object) -> Card:
        """A card with what all cards say, and the facts of one."""
        areas = {str(int(area)): f"{area.name.lower()}: {about}" for area, about in ABOUT.items() if area in Area}
        return cls({**facts, "conventions": HOW, "areas": areas, "known_limits": list(LIMITS)})

    def page(self, tables: Sequence[Table]) -> str:
        """As Markdown."""
        lines = ["# Labels of a rendered face", ""]
        for name, value in self.facts.items():
            if name in ("areas", "conventions", "known_limits"):
                continue
            lines += [f"- **{name.replace('_', ' ')}**: {_plain(value)}"]
        lines += ["", "## Tables", "", "`datapackage.json` describes every column: type, unit, meaning.", ""]
        lines += ["| table | rows | a row is |", "|---|---|---|"]
        lines += [f"| `{table.name}.csv` | {len(table)} | {table.about} |" for table in tables]
        lines += ["", "## Conventions", "", *(f"- **{name}**: {about}" for name, about in HOW.items())]
        lines += ["", "## Known limits", "", *(f"- {limit}" for limit in LIMITS)]
        return "\n".join(lines) + "\n"


def _plain(value: object) -> str:
    """A fact as text."""
    if isinstance(value, Mapping):
        return "; ".join(f"{name} {_plain(each)}" for name, each in value.items())
    if isinstance(value, list | tuple):
        return ", ".join(_plain(each) for each in value) or "none"
    return "not known" if value is None or value == "" else str(value)

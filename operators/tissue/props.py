"""The tissue chosen for a face: a bundled one by name, or figures of its own."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bpy.props import EnumProperty, FloatProperty

from ...resources import PRESETS
from ...tables import read_toml
from ..annotated import Annotated
from ..blender_classes import PropertyGroup
from ..blender_types import Context, Object
from ..changes import changed

if TYPE_CHECKING:
    from ...physics.tissue import Tissue

OWN = "OWN"
FIRST = "default"
#: The bundled tissues as they stand in their table: registration must not need SciPy, which `physics` does.
_TISSUES = {name: table.cells for name, table in read_toml(PRESETS / "tissue.toml").tables("tissues").items()}
_DEFAULT = _TISSUES[FIRST]
_loading = False

#: Blender wants a dynamic enum's strings to be held somewhere; here they never change.
_ITEMS = [
    (name, name.capitalize(), figures["description"], number) for number, (name, figures) in enumerate(_TISSUES.items())
]


def _chosen(owner: RISORIUS_PG_tissue, context: Context) -> None:
    """A bundled tissue brings its figures."""
    global _loading
    if owner.kind != OWN:
        _loading = True
        try:
            for name in FIGURES:
                setattr(owner, name, _TISSUES[owner.kind][name])
        finally:
            _loading = False
    changed(owner, context)


def _edited(owner: RISORIUS_PG_tissue, context: Context) -> None:
    """A figure that was changed makes the tissue one's own."""
    if not _loading and owner.kind != OWN:
        owner.kind = OWN


def _figure(name: str, title: str, description: str, *, least: float, most: float, precision: int = 2) -> object:
    """A figure of the tissue, in SI units."""
    return FloatProperty(
        name=title,
        description=description,
        default=_DEFAULT[name],
        min=least,
        soft_max=most,
        precision=precision,
        update=_edited,
    )


class RISORIUS_PG_tissue(PropertyGroup):
    """Tissue of one face. It shapes how the skin moves (Bake Motion); an expression that is held stays the same."""

    kind: Annotated[
        str,
        EnumProperty(
            name="Tissue",
            description="Properties of the skin: how it swings and settles in a baked motion",
            items=[*_ITEMS, (OWN, "Custom", "Use your own values, below; save them as a preset above", len(_ITEMS))],
            default=FIRST,
            update=_chosen,
        ),
    ]
    youngs_modulus: Annotated[
        float,
        _figure(
            "youngs_modulus",
            "Stiffness (Pa)",
            "Young's modulus of the skin at low strain, in pascals",
            least=1.0,
            most=1e5,
        ),
    ]
    thickness: Annotated[
        float,
        _figure(
            "thickness",
            "Thickness (m)",
            "Thickness of the layer that carries tension, in metres",
            least=1e-5,
            most=0.01,
            precision=5,
        ),
    ]
    depth: Annotated[
        float,
        _figure(
            "depth",
            "Depth (m)",
            "Depth of the soft tissue that moves with the skin, in metres",
            least=1e-4,
            most=0.05,
            precision=4,
        ),
    ]
    density: Annotated[float, _figure("density", "Density (kg/m³)", "Density of that tissue", least=1.0, most=3000.0)]
    stiffening: Annotated[
        float,
        _figure(
            "stiffening",
            "Stiffening",
            "Factor by which the skin gets stiffer beyond the threshold",
            least=1.0,
            most=20.0,
        ),
    ]
    threshold: Annotated[
        float,
        _figure("threshold", "Threshold", "Strain beyond which the skin stiffens", least=0.001, most=1.0, precision=3),
    ]
    bending_length: Annotated[
        float,
        _figure(
            "bending_length",
            "Bending Length (m)",
            "Length below which the moving skin smooths a pull, in metres. Thinner skin would buckle",
            least=0.003,
            most=0.05,
            precision=4,
        ),
    ]
    anchor_length: Annotated[
        float,
        _figure(
            "anchor_length",
            "Anchor Length (m)",
            "Length over which a pull fades along the moving skin, in metres. Longer is more loosely held",
            least=1e-3,
            most=0.05,
            precision=4,
        ),
    ]
    damping_ratio: Annotated[
        float,
        _figure(
            "damping_ratio",
            "Damping",
            "Damping where the skin is firmly held. 1 is critical: no swinging",
            least=0.0,
            most=3.0,
        ),
    ]
    loose_depth: Annotated[
        float,
        _figure(
            "loose_depth",
            "Cheek Depth (m)",
            "Depth of the soft tissue that moves with cheek and jowl, in metres",
            least=1e-4,
            most=0.06,
            precision=4,
        ),
    ]
    loose_damping_ratio: Annotated[
        float,
        _figure(
            "loose_damping_ratio", "Cheek Damping", "Damping in cheek and jowl. Below 1 they swing", least=0.0, most=3.0
        ),
    ]
    jaw_frequency: Annotated[
        float,
        _figure(
            "jaw_frequency", "Jaw Frequency (Hz)", "Frequency of the mandible in its muscles", least=0.5, most=20.0
        ),
    ]
    jaw_damping_ratio: Annotated[
        float,
        _figure("jaw_damping_ratio", "Jaw Damping", "Damping of the mandible. 1 is critical", least=0.0, most=3.0),
    ]


#: Names of the figures, as `physics.tissue.Tissue` has them.
FIGURES = tuple(name for name in RISORIUS_PG_tissue.__annotations__ if name != "kind")


def tissue_of(obj: Object) -> str | Tissue:
    """What the skin of `obj` is made of: a bundled tissue's name, or figures."""
    from ...physics.tissue import Tissue

    chosen = obj.risorius.tissue
    if chosen.kind != OWN:
        return str(chosen.kind)
    return Tissue(
        youngs_modulus=chosen.youngs_modulus,
        thickness=chosen.thickness,
        depth=chosen.depth,
        density=chosen.density,
        stiffening=chosen.stiffening,
        threshold=chosen.threshold,
        bending_length=chosen.bending_length,
        anchor_length=chosen.anchor_length,
        damping_ratio=chosen.damping_ratio,
        loose_depth=chosen.loose_depth,
        loose_damping_ratio=chosen.loose_damping_ratio,
        jaw_frequency=chosen.jaw_frequency,
        jaw_damping_ratio=chosen.jaw_damping_ratio,
    )

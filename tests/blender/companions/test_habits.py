"""How objects of characters are named by the tools that make them."""

from __future__ import annotations

import pytest
from risorius.scene.following.habits import habits, told_by_name, told_by_names, words_of
from risorius.scene.following.kinds import Follows

NAMES = {
    # MPFB
    "Human.eyelashes01": Follows.SKIN,
    "Human.eyebrow001": Follows.SKIN,
    "Human.high-poly": Follows.EYES,
    "Human.low-poly": Follows.EYES,
    "Human.teeth_base": Follows.TEETH,
    "Human.tongue01": Follows.TONGUE,
    "Human.short02_hair": Follows.SKULL,
    "Human": None,
    # Ready Player Me
    "EyeLeft": Follows.EYES,
    "Wolf3D_Teeth": Follows.TEETH,
    "Wolf3D_Hair": Follows.SKULL,
    "Wolf3D_Beard": Follows.SKIN,
    "Wolf3D_Glasses": Follows.SKULL,
    "Wolf3D_Headwear": Follows.SKULL,
    "Wolf3D_Head": None,
    "Wolf3D_Outfit_Top": None,
    # VRoid
    "Hair001 (merged)": Follows.SKULL,
    "Face": None,
    # Character Creator
    "CC_Base_Eye": Follows.EYES,
    "CC_Base_EyeOcclusion": Follows.SKIN,
    "CC_Base_TearLine": Follows.SKIN,
    "CC_Base_Teeth": Follows.TEETH,
    "CC_Base_Tongue": Follows.TONGUE,
    "CC_Base_Body": None,
    "Std_Eyelash": Follows.SKIN,
    # DAZ
    "Genesis 8 Female Eyelashes": Follows.SKIN,
    "Genesis9Eyes Mesh": Follows.EYES,
    "Genesis 9 Mouth Mesh": Follows.SEVERAL,
    "Genesis 9 Tear Mesh": Follows.SKIN,
    "Toulouse Hair Mesh": Follows.SKULL,
    # Rigify, its widgets
    "teeth.T": Follows.TEETH_UPPER,
    "DEF-teeth.B": Follows.TEETH_LOWER,
    "DEF-eye.L": Follows.EYES,
    "WGT-rig_teeth.T": Follows.NONE,
    # plain words, other languages, scripts without spaces
    "eye_brow_left": Follows.SKIN,
    "EYELASHES.001": Follows.SKIN,
    "EyeGlasses": Follows.SKULL,
    "BeardHair": Follows.SKIN,
    "teeth_upper": Follows.TEETH_UPPER,
    "Upper & Lower Teeth": Follows.TEETH,
    "eyes_teeth_tongue": Follows.SEVERAL,
    "LipRing.R": Follows.SKIN,
    "Wimpern": Follows.SKIN,
    "Zähne": Follows.TEETH,
    "髪の毛": Follows.SKULL,
    "まつげ左": Follows.SKIN,
    "Eyecatcher": None,
    "Mesh.003": None,
}


@pytest.mark.parametrize("name", NAMES)
def test_a_name_tells_how_it_follows(name: str) -> None:
    assert told_by_name(name) is NAMES[name]


def test_materials_and_groups_tell_where_they_agree() -> None:
    assert told_by_names(["Std_Upper_Teeth", "Std_Lower_Teeth"]) is Follows.TEETH
    assert told_by_names(["Std_Tongue", "Std_Upper_Teeth", "Material"]) is Follows.SEVERAL
    assert told_by_names(["Eyelash", "Hair"]) is None
    assert told_by_names(["Material.001"]) is None


def test_every_phrase_of_the_table_tells_itself() -> None:
    assert len(habits()) > 200
    for phrase, follows in habits().items():
        assert told_by_name(" ".join(phrase)) is follows, phrase


def test_words_of_a_name() -> None:
    assert words_of("CC_Base_EyeOcclusion.001") == ("cc", "base", "eye", "occlusion")
    assert words_of("HTMLBag-x2") == ("html", "bag", "x")

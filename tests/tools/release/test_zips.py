"""The extension's zips: whole, valid, reproducible, one per system and Blender range."""

from __future__ import annotations

import itertools
import tomllib
import zipfile
from pathlib import Path

import build
import pytest
from places import ROOT
from release import zips
from release.sources import VERSION, BuildError
from release.wheels import PLATFORMS, RANGES
from release.zips import build_zip, staged_manifest

MANIFEST = (ROOT / "blender_manifest.toml").read_text(encoding="utf-8")

#: Each system with each Blender range that it has.
WANTED = [(platform, blender) for platform in PLATFORMS for blender in RANGES if blender.name in platform.ranges]
#: What serves plain Python alone.
OUTSIDE_BLENDER = ("batch/cluster.py", "track/", "__main__.py", "py.typed")


def test_zip_holds_every_product_file_and_nothing_else(small_zip: Path, product: frozenset[str]) -> None:
    with zipfile.ZipFile(small_zip) as archive:
        names = set(archive.namelist())
    expected = {name for name in product if not name.startswith(OUTSIDE_BLENDER)}
    assert sorted(expected - names) == []
    assert sorted(names - expected - {"LICENSE", "README.md", "CHANGELOG.md"}) == []


def test_zip_is_the_same_when_built_again(small_zip: Path, tmp_path: Path) -> None:
    again = build_zip(tmp_path / "again.zip", [], platform=None, blender=None)
    assert again.read_bytes() == small_zip.read_bytes()


@pytest.mark.usefixtures("small_zip")
def test_what_blender_refuses_is_not_built(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    odd = staged_manifest(MANIFEST, [], platform=None, blender=None).replace('"Rigging"', '"Sorcery"')
    monkeypatch.setattr(zips, "staged_manifest", lambda *_arguments, **_options: odd)
    assert build.main(["--no-wheels", "--output", str(tmp_path)]) == 1
    assert "Sorcery" in capsys.readouterr().err
    assert not list(tmp_path.glob("*.zip"))


@pytest.mark.slow
@pytest.mark.usefixtures("small_zip")
def test_a_zip_that_the_extension_site_does_not_take_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:  # fmt: skip
    monkeypatch.setattr(zips, "LARGEST", 500_000)
    with pytest.raises(BuildError, match="less than"):
        build_zip(tmp_path / "large.zip", [], platform=None, blender=None)


def test_version_has_one_place() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert tomllib.loads(MANIFEST)["version"] == VERSION
    assert "version" not in project
    assert project["authors"] == [{"name": tomllib.loads(MANIFEST)["maintainer"]}]


def test_manifest_keeps_blenders_rules() -> None:
    manifest = tomllib.loads(MANIFEST)
    texts = [manifest["tagline"], *manifest["permissions"].values()]
    assert all(len(text) <= 64 for text in texts)
    assert all(text[-1].isalnum() or text[-1] == ")" for text in texts)
    assert {".*", "__pycache__/", "/*.zip"} <= set(manifest["build"]["paths_exclude_pattern"])


def test_staged_manifest_names_its_wheels_and_range() -> None:
    for platform, blender in WANTED:
        names = [Path(f"scipy-1.0-cp{python.replace('.', '')}-x.whl") for python in blender.pythons]
        staged = tomllib.loads(staged_manifest(MANIFEST, names, platform=platform, blender=blender))
        assert staged["wheels"] == [f"./wheels/{name}" for name in names]
        assert staged["platforms"] == [platform.name]
        assert staged["blender_version_min"] == blender.first
        assert staged.get("blender_version_max") == blender.end
        assert staged["build"] == tomllib.loads(MANIFEST)["build"]


def test_every_system_and_range_has_a_zip_of_its_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:  # fmt: skip
    made: list[tuple[str, object, object]] = []

    def note(target: Path, _wheels: list[Path], *, platform: object, blender: object) -> Path:
        made.append((target.name, platform, blender))
        target.touch()
        return target

    monkeypatch.setattr(build, "fetch", lambda *_arguments: [])
    monkeypatch.setattr(build, "build_zip", note)
    monkeypatch.setattr(build, "build_python_package", lambda _folder: ())
    assert build.main(["--output", str(tmp_path)]) == 0
    assert len({name for name, *_ in made}) == len(made)
    assert {(platform, blender) for _, platform, blender in made} == set(WANTED)
    assert all(VERSION in name for name, *_ in made)
    assert {f"{platform.name} {blender.name}" for platform, blender in WANTED} == {
        *("linux-x64 4.2", "windows-x64 4.2", "macos-arm64 4.2", "macos-x64 4.2"),
        *("linux-x64 5.1", "windows-x64 5.1", "macos-arm64 5.1", "windows-arm64 5.1"),
    }


def test_a_zip_that_cannot_be_is_refused_in_words(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        build.main(["--platform", "macos-x64", "--blender", "5.1", "--output", str(tmp_path)])
    assert "no SciPy for Blender 5.1 on macos-x64" in capsys.readouterr().err


def test_ranges_cover_every_blender_without_overlap() -> None:
    for one, next_one in itertools.pairwise(RANGES):
        assert one.end == next_one.first
    assert RANGES[-1].end is None
    assert RANGES[0].first == tomllib.loads(MANIFEST)["blender_version_min"]

"""Tables of jobs: what a row says, and what is said of a row that is wrong."""

from __future__ import annotations

from pathlib import Path

import pytest
from places import ROOT
from risorius.batch.columns import BY_NAME, COLUMNS, Kind, reference
from risorius.batch.jobs import name_problem
from risorius.batch.making import unheeded
from risorius.batch.table import JobTable, read_jobs
from risorius.errors import FormatError
from risorius.mpeg4 import load_timings
from risorius.physics.tissue import load_tissues


def table(folder: Path, text: str, name: str = "jobs.csv") -> JobTable:
    """A table that is read."""
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return read_jobs(path)


def problem(folder: Path, text: str) -> str:
    """The only problem of a table of one row."""
    read = table(folder, text)
    assert not read.jobs
    (found,) = read.problems
    return str(found)


def test_a_row_says_what_its_cells_say_and_defaults_say_the_rest(tmp_path: Path) -> None:
    read = table(tmp_path, "id,emotion,activation,yaw,outputs,size\na1,joy,6,-20.5,still  labels,640x480\n")
    (job,) = read.jobs
    assert job.said() == {
        "id": "a1",
        "emotion": "joy",
        "activation": 6.0,
        "yaw": -20.5,
        "outputs": ["still", "labels"],
        "size": "640x480",
    }
    assert job.values["lens"] == 85.0
    assert set(job.values) == set(BY_NAME)


def test_comments_blank_lines_and_semicolons_are_read(tmp_path: Path) -> None:
    read = table(tmp_path, "# mine\n\nid;emotion;note\n\na;joy;one, two\n;;\nb;fear;\n")
    assert [job.id for job in read.jobs] == ["a", "b"]
    assert read.jobs[0].values["note"] == "one, two"
    assert not read.problems


def test_tables_of_spreadsheets_are_read(tmp_path: Path) -> None:
    """Excel of a country with decimal commas: marks at the beginning, semicolons, lines that end as Windows ends them,
    columns and rows with nothing in them."""
    text = "\ufeffsep=;\r\nID;Emotion;Activation;Voice Pitch;Yaw;;\r\na;JOY;5,5;;-12,5;;\r\n;;;;;;\r\n"
    (job,) = table(tmp_path, text).jobs
    assert job.said() == {"id": "a", "emotion": "JOY", "activation": 5.5, "yaw": -12.5}
    tabbed = table(tmp_path, "id\temotion\tactivation\nb\tjoy\t5,5\n", "jobs.tsv")
    assert tabbed.jobs[0].values["activation"] == 5.5
    assert "must be a number from 1 to 7, but it is '5,5'" in problem(tmp_path, 'emotion,activation\njoy,"5,5"\n')


def test_tables_of_programs_are_read(tmp_path: Path) -> None:
    """A column with gaps is one of floating point for them."""
    (job,) = table(tmp_path, "emotion,seed,creases,variant\njoy,3.0,True,\n").jobs
    assert (job.values["seed"], job.values["creases"]) == (3, True)
    assert "has '0' in column 1, which has no name" in problem(tmp_path, ",emotion\n0,joy\n")


def test_a_cell_with_line_breaks_and_an_open_quotation_mark_harm_their_own_row_alone(tmp_path: Path) -> None:
    read = table(tmp_path, 'id,text\na,"one\ntwo"\nb,"open\nc,three\nd,"four ""five"""\n')
    assert [(job.id, job.values["text"]) for job in read.jobs] == [("c", "three"), ("d", 'four "five"')]
    assert [str(each).partition("jobs.csv, ")[2] for each in read.problems] == [
        "line 2: goes on to line 3 in quotation marks: write it in one line",
        "line 4: has a quotation mark that nothing closes: close or remove it",
    ]


def test_a_colour_in_the_first_column_is_no_comment(tmp_path: Path) -> None:
    text = '# a comment\n"# one, of a spreadsheet",\nbackground,emotion\n#ff0000,joy\n#00ff00,joy\n# no,row\n'
    assert [job.values["background"] for job in table(tmp_path, text).jobs] == ["#ff0000", "#00ff00"]
    assert not table(tmp_path, text).problems


def test_only_line_breaks_end_a_line(tmp_path: Path) -> None:
    (job,) = table(tmp_path, "text,note\nHello\u2028there,x\n").jobs
    assert job.values["text"] == "Hello\u2028there"


def test_a_set_keeps_the_names_of_its_own_files() -> None:
    for name in ("manifest.jsonl", "manifest.3-of-10.jsonl", "JOBS.csv"):
        assert name_problem(name) is not None


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("emotion,seed\njoy,-1\n", "column seed: must be a whole number from 0 to 2147483647, but it is '-1'"),
        ("emotion,seed\njoy,1e300\n", "column seed: must be a whole number"),
        ("emotion,still_at,outputs\njoy,99,still\n", "column still_at: must be "),
        ("emotion,tissue,outputs\njoy,aged,still\n", "column tissue: says nothing in a still alone"),
        ("emotion,note\njoy,a,b\n", "put a text with ',' into quotation marks"),
        ("emotion,yaw\njoy,900\n", "line 2, column yaw: must be a number from -180 to 180, but it is '900'"),
        ("emotion,yaw\njoy,1e400\n", "column yaw: must be a number"),
        ("emotion,yaw\njoy,nan\n", "column yaw: must be a number"),
        ("emotion,seed\njoy,1.5\n", "column seed: must be a whole number"),
        ("emotion\njoi\n", "column emotion: emotion word must be a known word (did you mean joy"),
        ("emotion,activation\njoy,8\n", "column activation: must be a number from 1 to 7"),
        ("emotion,variant\njoy,bared\n", "column variant"),
        ("emotion,angle,activation\njoy,20,3\n", "column angle: must be empty where there is an emotion"),
        ("angle\n20\n", "column angle: needs an activation"),
        ("note\nx\n", "line 2: says nothing to show: fill one of emotion, angle, fap and text"),
        ("emotion,fap\njoy,a.fap\n", "column fap: must be empty where there is emotion"),
        ("fap\nnot-there.fap\n", "column fap: names no file:"),
        ("emotion,head\njoy,not-there.obj\n", "column head: names no file:"),
        ("emotion,voice\njoy,de\n", "column voice: says nothing without text: empty it"),
        ("emotion,points\njoy,jobs.csv\n", "column points: says nothing without head"),
        ("emotion,variation\njoy,0.5\n", "column variation: says nothing without seed"),
        ("text,onset\nhello,2\n", "column onset: says nothing without emotion or angle"),
        ("text,emotion,onset\nhello,joy,2\n", "column onset: says nothing beside text"),
        ("emotion,still_at\njoy,1\n", "column still_at: says nothing without still in outputs"),
        ("emotion,onset,apex,offset\njoy,0,0,0\n", "column onset: must be more than 0 s together"),
        ("emotion,outputs\njoy,film stil\n", "column outputs: must be some of still, film, blend, glb, fap, labels"),
        ("emotion,size\njoy,511\n", "column size: must be even numbers of pixels from 16 to 8192"),
        ("emotion,skin\njoy,pink\n", "column skin: must be a colour as #rrggbb"),
        ("emotion,creases\njoy,maybe\n", "column creases: must be yes or no"),
        ("emotion,engine\njoy,POVRAY\n", "column engine: must be one of WORKBENCH, EEVEE, CYCLES"),
        ("emotion,id\njoy,../x\n", "column id: must begin with a letter or digit"),
        ("emotion,id\njoy,nul\n", "column id: must not be a name that is taken"),
        ("emotion,id\njoy\n", "line 2: has 1 cells, but the heading has 2"),
    ],
)
def test_a_bad_row_is_told_with_line_column_value_and_remedy(tmp_path: Path, text: str, told: str) -> None:
    assert told in problem(tmp_path, text)


def test_a_bad_row_is_left_out_and_all_that_is_wrong_with_it_is_told(tmp_path: Path) -> None:
    read = table(tmp_path, "id,emotion,yaw,lens\na,joy,,\nb,joy,x,y\nc,sad,,\n")
    assert [job.id for job in read.jobs] == ["a", "c"]
    assert [(each.line, each.column) for each in read.problems] == [(3, "yaw"), (3, "lens")]


def test_an_unknown_column_is_refused_with_a_near_one(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"line 1, column emotoin: is unknown: did you mean emotion\?"):
        table(tmp_path, "emotoin\njoy\n")


def test_a_column_twice_and_a_table_without_rows_are_refused(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="stands twice"):
        table(tmp_path, "emotion,emotion\njoy,joy\n")
    with pytest.raises(FormatError, match="has no rows"):
        table(tmp_path, "emotion\n")
    with pytest.raises(FormatError, match="is empty"):
        table(tmp_path, "")
    with pytest.raises(FormatError, match=r"must be a \.csv, \.tsv or \.toml"):
        table(tmp_path, "emotion\n", "jobs.xlsx")


def test_ids_are_told_apart_without_regard_to_case(tmp_path: Path) -> None:
    read = table(tmp_path, "id,emotion\na,joy\nA,fear\n")
    assert [job.id for job in read.jobs] == ["a"]
    assert "'A' is the id of line 2, too" in str(read.problems[0])


def test_a_row_without_id_is_named_after_what_it_says_wherever_it_stands(tmp_path: Path) -> None:
    first = table(tmp_path, "emotion,yaw\njoy,5\nfear,5\n").jobs
    second = table(tmp_path, "yaw,note,emotion\n5,new,fear\n9,,joy\n5,,joy\n").jobs
    assert first[0].id.startswith("joy-")
    assert {job.id for job in first} == {second[0].id, second[2].id}
    read = table(tmp_path, "emotion\njoy\njoy\n")
    assert "line 3: says what line 2 says" in str(read.problems[0])


def test_toml_says_the_same_as_csv(tmp_path: Path) -> None:
    text = """
        [defaults]
        size = 256
        outputs = ["still"]
        [[jobs]]
        id = "a"
        emotion = "joy"
        creases = true
        variant = 2
        [[jobs]]
        id = "b"
        emotion = "joy"
        yaw = 500
    """
    toml = table(tmp_path, text, "jobs.toml")
    csv = table(tmp_path, "id,emotion,size,outputs,creases,variant\na,joy,256,still,yes,2\n")
    assert dict(toml.jobs[0].values) == dict(csv.jobs[0].values)
    assert toml.jobs[0].fingerprint() == csv.jobs[0].fingerprint()
    assert "jobs.toml, line 10, key jobs.1.yaw: must be a number from -180 to 180" in str(toml.problems[0])
    wrong = table(tmp_path, '[[jobs]]\nemotoin = "joy"\n[[jobs]]\nemotion = "joy"\n', "jobs.toml")
    assert [job.place for job in wrong.jobs] == ["line 3"]
    assert "line 1, key jobs.0.emotoin: is unknown: did you mean emotion" in str(wrong.problems[0])
    with pytest.raises(FormatError, match=r"defaults\.emotoin: is unknown: did you mean emotion"):
        table(tmp_path, '[defaults]\nemotoin = "joy"\n[[jobs]]\nemotion = "joy"\n', "jobs.toml")


def test_what_a_table_says_for_all_is_for_the_jobs_in_which_it_says_something(tmp_path: Path) -> None:
    text = """
        [defaults]
        voice = "de"
        activation = 5
        label_pictures = 5
        [[jobs]]
        emotion = "joy"
        [[jobs]]
        text = "Guten Tag"
        [[jobs]]
        text = "Guten Tag"
        activation = 3
    """
    read = table(tmp_path, text, "jobs.toml")
    assert [job.said() for job in read.jobs] == [
        {"id": read.jobs[0].id, "emotion": "joy", "activation": 5.0},
        {"id": read.jobs[1].id, "text": "Guten Tag", "voice": "de"},
    ]
    assert "line 10, key jobs.2.activation: says nothing without emotion or angle" in str(read.problems[0])


def test_a_job_is_known_again_by_what_it_says_and_by_the_files_it_names(tmp_path: Path) -> None:
    (tmp_path / "a.fap").write_text("one")
    (tmp_path / "b.fap").write_text("one")
    text = "id,fap,note\nx,{},{}\n"
    first = table(tmp_path, text.format("a.fap", "")).jobs[0].fingerprint()
    assert table(tmp_path, text.format("b.fap", "mine")).jobs[0].fingerprint() == first
    (tmp_path / "a.fap").write_text("other")
    assert table(tmp_path, text.format("a.fap", "")).jobs[0].fingerprint() != first


def test_files_are_named_from_the_folder_of_the_table(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.fap").write_text("one")
    monkeypatch.chdir("/")
    assert table(tmp_path, "fap\na.fap\n").jobs[0].inputs == {"fap": tmp_path / "a.fap"}


@pytest.mark.parametrize(
    ("cells", "told"),
    [
        ("samples,outputs\n64,still", ["samples says nothing in engines other than Cycles"]),
        ("samples,outputs,engine\n64,still,cycles", []),
        ("ambient,outputs\n1,film", ["ambient says nothing in Workbench"]),
        ("ambient,outputs\n1,blend", []),
        ("yaw,outputs\n20,fap", ["yaw says nothing where nothing is pictured"]),
        ("yaw,light,outputs\n20,2,labels", ["light says nothing where nothing is drawn"]),
        ("max_keys,outputs\n5,still", ["max_keys says nothing where nothing moves"]),
        ("max_keys,size,outputs\n5,64,film", []),
    ],
)
def test_what_does_not_show_is_remarked(tmp_path: Path, cells: str, told: list[str]) -> None:
    heading, row = cells.splitlines()
    (job,) = table(tmp_path, f"emotion,{heading}\njoy,{row}\n").jobs
    assert list(unheeded(job)) == told


def test_choices_are_those_of_the_presets() -> None:
    assert set(BY_NAME["timing"].options) == set(load_timings())
    assert set(BY_NAME["tissue"].options) == set(load_tissues())


def test_every_column_is_told_in_the_manual() -> None:
    assert reference() in (ROOT / "docs" / "batch.md").read_text(encoding="utf-8")
    for column in COLUMNS:
        assert column.about
        assert column.options or column.kind not in (Kind.CHOICE, Kind.CHOICES)


@pytest.mark.parametrize("name", ["a", "A-1_b.c", "x" * 100])
def test_names_of_folders_are_taken(name: str) -> None:
    assert name_problem(name) is None


@pytest.mark.parametrize("name", ["", ".a", "a/b", "a\\b", "a b", "é", "x" * 101, "a.", "con", "COM1.txt", "~a"])
def test_names_that_are_none_everywhere_are_refused(name: str) -> None:
    assert name_problem(name) is not None

"""Files of aligners and lip-sync tools: what is read, what is assumed, what is refused."""

from __future__ import annotations

import json
import wave
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from risorius.errors import FormatError, ParameterError
from risorius.mpeg4 import FapStream, VisemeField, write_fap, write_fba
from risorius.speech.timings import read_marks
from risorius.speech.utterance import Utterance


def said(utterance: Utterance) -> str:
    """The sounds in a line."""
    return " ".join(sound.phoneme.symbol for sound in utterance.sounds)


def times(utterance: Utterance) -> list[tuple[float, float]]:
    """When sounds begin and end, to the microsecond."""
    return [(round(sound.start, 6), round(sound.end, 6)) for sound in utterance.sounds]


@pytest.fixture
def speech(shared: Path) -> Path:
    """Samples that other people made."""
    return shared / "samples" / "speech"


def test_textgrids_of_other_people(speech: Path) -> None:
    folder = speech / "textgrid"
    bobby = read_marks(folder / "bobby_phones.TextGrid")
    assert said(bobby) == "b ɑ b i ɹ ɪ p t ð ə l ɛ dʒ ɚ"
    assert bobby.assumed == ("the sounds are read as ARPAbet",)
    assert bobby.duration == pytest.approx(1.194625)
    assert bobby.sounds[0].start == pytest.approx(0.06469123)
    assert [sound.stress for sound in bobby.sounds[:4]] == [0.0, 1.0, 0.0, 0.0]
    elan = read_marks(folder / "bobby_phones_elan.TextGrid")
    assert elan.sounds == bobby.sounds
    mary = read_marks(folder / "mary.TextGrid")
    assert said(mary) == "m ə r i r o l d θ ə b œ r l"
    assert [word.text for word in mary.words] == ["mary", "rolled", "the", "barrel"]
    assert said(read_marks(folder / "damon_set_test.TextGrid")).startswith("d e ɪ m ə n f r a ɪ d ð")


def test_words_alone_are_refused_with_the_remedy(speech: Path) -> None:
    with pytest.raises(FormatError, match=r"has words but no sounds .*: align them"):
        read_marks(speech / "textgrid" / "bobby_words.TextGrid")


def test_rhubarb_of_other_people(speech: Path) -> None:
    short = read_marks(speech / "rhubarb" / "en_male_electricity-expected.json")
    assert [sound.symbol for sound in short.sounds] == list("BHCBCB")
    assert [sound.phoneme.viseme for sound in short.sounds] == [7, 8, 11, 7, 11, 7]
    assert short.duration == pytest.approx(1.06)
    assert len(read_marks(speech / "rhubarb" / "threelittlekittens_01_rountreesmith-expected.json").sounds) == 1889


def test_rhubarbs_three_formats_say_the_same(tmp_path: Path) -> None:
    cues = [(0.0, 0.2, "X"), (0.2, 0.35, "A"), (0.35, 0.8, "D"), (0.8, 1.0, "X")]
    metadata = {"soundFile": "a.wav", "duration": 1.0}
    listed = [{"start": s, "end": e, "value": v} for s, e, v in cues]
    (tmp_path / "a.json").write_text(json.dumps({"metadata": metadata, "mouthCues": listed}))
    rows = "".join(f'<mouthCue start="{s}" end="{e}">{v}</mouthCue>' for s, e, v in cues)
    head = '<?xml version="1.0" encoding="utf-8"?><rhubarbResult><metadata><duration>1.00</duration></metadata>'
    (tmp_path / "a.xml").write_text(f"{head}<mouthCues>{rows}</mouthCues></rhubarbResult>")
    (tmp_path / "a.tsv").write_text("".join(f"{s}\t{v}\n" for s, _, v in cues[:-1]) + "0.8\tX\n1.00\tX\n")
    found = [read_marks(tmp_path / f"a.{suffix}") for suffix in ("json", "xml", "tsv")]
    assert times(found[0]) == [(0.2, 0.35), (0.35, 0.8)]
    assert found[0] == found[1] == found[2]
    assert [sound.phoneme.viseme for sound in found[0].sounds] == [1, 10]


AUDACITY = "0.10\t0.20\tp\n0.20\t0.45\ta\n"
ALIGNED = "Begin,End,Label,Type,Speaker\n0.1,0.45,pa,words,anna\n0.1,0.2,p,phones,anna\n0.2,0.45,a,phones,anna\n"
ALIKE = {
    "audacity.txt": AUDACITY,
    "htk.lab": "1000000 2000000 p\n2000000 4500000 a\n",
    "timit.phn": "1600 3200 p\n3200 7200 aa\n",
    "aligner.csv": ALIGNED,
    "semicolons.csv": "start;end;phone\n0,1;0,2;p\n0,2;0,45;a\n",
    "milliseconds.csv": "start_ms,end_ms,phoneme\n100,200,p\n200,450,a\n",
    "guessed.csv": "start,end,phoneme\n100,200,p\n200,450,a\n",
    "durations.tsv": "time\tduration\tphone\n0.1\t0.1\tp\n0.2\t0.25\ta\n",
    "list.json": json.dumps([{"start": 0.1, "end": 0.2, "phoneme": "p"}, {"start": 0.2, "end": 0.45, "phoneme": "a"}]),
    "durations.json": json.dumps({"phonemes": [
        {"start": 0.1, "duration": 0.1, "phoneme": "p"}, {"start": 0.2, "duration": 0.25, "phoneme": "a"}
    ]}),
    "aligner.json": json.dumps({"start": 0, "end": 0.5, "tiers": {
        "anna - words": {"type": "interval", "entries": [[0.1, 0.45, "pa"]]},
        "anna - phones": {"type": "interval", "entries": [[0, 0.1, ""], [0.1, 0.2, "p"], [0.2, 0.45, "a"]]},
    }}),
    "gentle.json": json.dumps({"words": [{"word": "pa", "start": 0.1, "end": 0.45, "phones": [
        {"phone": "p_B", "duration": 0.1}, {"phone": "aa_E", "duration": 0.25}
    ]}]}),
    "marks.json": "\n".join(json.dumps(mark) for mark in [
        {"time": 100, "type": "word", "start": 0, "end": 2, "value": "pa"},
        {"time": 100, "type": "viseme", "value": "p"},
        {"time": 200, "type": "viseme", "value": "a"},
        {"time": 450, "type": "viseme", "value": "sil"},
    ]),
}  # fmt: skip


@pytest.mark.parametrize("name", ALIKE)
def test_what_other_tools_write_is_read_alike(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text(ALIKE[name], encoding="utf-8")
    utterance = read_marks(tmp_path / name)
    assert times(utterance) == [(0.1, 0.2), (0.2, 0.45)]
    assert [sound.phoneme.viseme for sound in utterance.sounds] == [1, 10]
    if "pa" in ALIKE[name]:
        assert [word.text for word in utterance.words] == ["pa"]


def test_an_assumed_unit_is_said(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(ALIKE["guessed.csv"])
    assert "times are read as milliseconds" in read_marks(tmp_path / "a.csv").assumed
    (tmp_path / "a.phn").write_text(ALIKE["timit.phn"])
    assert "times are read as samples at 16,000 per second" in read_marks(tmp_path / "a.phn").assumed


def test_visemes_by_number_are_those_of_the_standard(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("start,end,viseme\n0.0,0.1,1\n0.1,0.3,10\n0.3,0.4,0\n")
    assert [sound.phoneme.viseme for sound in read_marks(tmp_path / "a.csv").sounds] == [1, 10, 0]


def test_what_stands_in_and_what_is_unknown_is_said(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("0.0 0.1 ɲ\n0.1 0.2 a\n0.2 0.3 spn\n0.3 0.4 ю\n")
    utterance = read_marks(tmp_path / "a.txt")
    assert utterance.assumed == (
        "the sounds are read as IPA",
        "not known, the mouth passes over them: spn, ю",
        "shown as the nearest sound: ɲ as ŋ",
    )
    assert [sound.phoneme.own for sound in utterance.sounds] == [True, True, False, False]


def test_a_diphthong_has_two_sounds_the_first_longer(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("0.0 0.5 AY1\n")
    assert times(read_marks(tmp_path / "a.txt")) == [(0.0, 0.3), (0.3, 0.5)]


def textgrid(*tiers: tuple[str, list[tuple[float, float, str]]]) -> str:
    """A short TextGrid."""
    lines = ['File type = "ooTextFile"', 'Object class = "TextGrid"', "", "0", "1", "<exists>", str(len(tiers))]
    for name, entries in tiers:
        lines += ['"IntervalTier"', f'"{name}"', "0", "1", str(len(entries))]
        for start, end, text in entries:
            lines += [str(start), str(end), f'"{text}"']
    return "\n".join(lines) + "\n"


PHONES = [(0.0, 0.1, "p"), (0.1, 0.3, "a"), (0.3, 1.0, "")]


def test_a_tier_of_any_name_is_found_and_said(tmp_path: Path) -> None:
    (tmp_path / "a.TextGrid").write_text(
        textgrid(("Äußerung", [(0.0, 1.0, "pa")]), ("Anna", PHONES)), encoding="utf-16"
    )
    utterance = read_marks(tmp_path / "a.TextGrid")
    assert times(utterance) == [(0.0, 0.1), (0.1, 0.3)]
    assert "tier 'Anna' is read as the sounds" in utterance.assumed


def test_one_of_several_speakers_is_chosen(tmp_path: Path) -> None:
    path = tmp_path / "a.TextGrid"
    words = [(0.0, 1.0, "tu")]
    other = ("bea - phones", [(0.0, 0.5, "t"), (0.5, 1.0, "u")])
    path.write_text(textgrid(("anna - phones", PHONES), ("bea - words", words), other))
    with pytest.raises(FormatError, match="has 2 tiers of sounds: choose one of anna - phones, bea - phones"):
        read_marks(path)
    chosen = read_marks(path, tier="bea - phones")
    assert said(chosen) == "t u"
    assert [word.text for word in chosen.words] == ["tu"]
    with pytest.raises(FormatError, match="has no tier 'carl': choose one of"):
        read_marks(path, tier="carl")


POINTS = """File type = "ooTextFile"
Object class = "TextGrid"

0
1
<exists>
1
"TextTier"
"bells"
0
1
1
0.5
"dong"
"""

BAD = {
    "overlapping.txt": ("0.0 0.3 p\n0.1 0.4 a\n", "line 2: 'a' starts at 0.1 s, but 'p' lasts to 0.3 s: correct"),
    "reversed.txt": ("0.0 0.1 p\n0.4 0.2 a\n", "line 2: 'a' ends at 0.2 s, before it starts at 0.4 s"),
    "early.txt": ("-1.0 0.1 p\n", "line 1: times must be 0 s or later"),
    "silent.txt": ("0.0 0.1 sil\n0.1 0.2 sp\n", "says nothing"),
    "cyrillic.txt": ("0.0 0.1 к\n0.1 0.2 о\n", "has no sound that is known: 'к'"),
    "empty.csv": ("", "is empty"),
    "heading.csv": ("who,what\nanna,p\n", "must have columns start, end and phoneme or viseme, but it has who, what"),
    "words.json": ('{"words": [{"word": "pa", "start": 0.1, "end": 0.4}]}', "has words but no sounds"),
    "cut.json": ('{"mouthCues": [{"start": 0.0,', "is not valid JSON"),
    "cue.json": ('{"mouthCues": [{"start": 0.0, "end": 0.1, "value": "Q"}]}', "'Q' is no mouth shape of A to H and X"),
    "number.json": ('[{"start": "soon", "end": 0.1, "phoneme": "p"}]', r"\[0\].start: must be a number"),
    "other.xml": ("<html></html>", "is XML, but not Rhubarb's"),
    "bomb.xml": ('<!DOCTYPE a [<!ENTITY b "c">]><rhubarbResult/>', "declares a document type"),
    "cut.TextGrid": (textgrid(("phones", PHONES))[:70], "is no whole TextGrid"),
    "points.TextGrid": (POINTS, "has no tier of intervals"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_files_are_refused_with_the_place_and_the_remedy(tmp_path: Path, name: str) -> None:
    content, problem = BAD[name]
    (tmp_path / name).write_text(content, encoding="utf-8")
    with pytest.raises(FormatError, match=problem):
        read_marks(tmp_path / name)


def test_binary_files_are_refused(tmp_path: Path) -> None:
    (tmp_path / "a.bin").write_bytes(b"RUB\x04\xff\xfe\x90")
    with pytest.raises(FormatError, match="is no text: it must be a TextGrid"):
        read_marks(tmp_path / "a.bin")
    (tmp_path / "a.mp3").write_bytes(b"ID3\x04\xff\xfe\x90")
    with pytest.raises(FormatError, match="is a sound, but not WAV"):
        read_marks(tmp_path / "a.mp3")


def test_a_stream_with_visemes_says_when_they_are(tmp_path: Path) -> None:
    fields = {
        5: VisemeField(1),
        10: VisemeField(10),
        12: VisemeField(10, 14, 50),
        14: VisemeField(10, 14, 10),
        20: VisemeField(0),
    }
    stream = FapStream(np.full((25, 68), np.nan), fps=25.0, visemes=fields)
    write_fap(tmp_path / "a.fap", stream)
    write_fba(tmp_path / "a.fba", stream)
    for name in ("a.fap", "a.fba"):
        utterance = read_marks(tmp_path / name)
        assert times(utterance) == [(0.2, 0.4), (0.4, 0.56), (0.56, 0.8)]
        assert [sound.phoneme.viseme for sound in utterance.sounds] == [1, 10, 14]
        assert utterance.duration == 1.0
    write_fap(tmp_path / "b.fap", FapStream(np.zeros((5, 68))))
    with pytest.raises(FormatError, match=r"states no viseme \(FAP 1\)"):
        read_marks(tmp_path / "b.fap")


def write_wav(path: Path, samples: np.ndarray, rate: int = 8000) -> None:
    """Samples of 16 bits as WAV."""
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(rate)
        file.writeframes(samples.astype("<i2").tobytes())


def test_a_sound_alone_opens_the_mouth_as_loud_as_it_is_and_says_so(tmp_path: Path) -> None:
    seconds = np.arange(16000) / 8000.0
    loud = sum(
        height * np.exp(-(((seconds - at) / 0.06) ** 2)) for at, height in ((0.4, 8000), (0.9, 16000), (1.5, 4000))
    )
    write_wav(tmp_path / "a.wav", loud * np.sin(1000.0 * seconds))
    utterance = read_marks(tmp_path / "a.wav")
    np.testing.assert_allclose([sound.middle for sound in utterance.sounds], [0.4, 0.9, 1.5], atol=0.02)
    jaws = [sound.phoneme.jaw for sound in utterance.sounds]
    assert jaws[1] > jaws[0] > jaws[2]
    assert "the mouth follows loudness alone" in utterance.assumed[0]
    write_wav(tmp_path / "b.wav", np.zeros(8000))
    with pytest.raises(FormatError, match="is silent"):
        read_marks(tmp_path / "b.wav")
    (tmp_path / "c.wav").write_bytes((tmp_path / "a.wav").read_bytes()[:30])
    with pytest.raises(FormatError, match="is no WAV file of whole samples"):
        read_marks(tmp_path / "c.wav")


def test_speech_of_people_has_a_syllable_about_where_its_vowels_are(speech: Path) -> None:
    heard = read_marks(speech / "textgrid" / "bobby.wav")
    vowels = [s.middle for s in read_marks(speech / "textgrid" / "bobby_phones.TextGrid").sounds if s.phoneme.vowel]
    nearest = [min(abs(sound.middle - vowel) for sound in heard.sounds) for vowel in vowels]
    assert len(heard.sounds) <= len(vowels) + 2
    assert np.median(nearest) < 0.06


def test_a_wrong_alphabet_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text(AUDACITY)
    wrong: Any = "klingon"
    with pytest.raises(ParameterError, match="must be one of ipa, arpabet, xsampa"):
        read_marks(tmp_path / "a.txt", alphabet=wrong)
    assert said(read_marks(tmp_path / "a.txt", alphabet="xsampa")) == "p a"


def test_empty_tiers_other_alphabets_and_other_sounds_are_told_apart(tmp_path: Path) -> None:
    kana, ogg, empty = tmp_path / "kana.txt", tmp_path / "line.ogg", tmp_path / "empty.TextGrid"
    kana.write_text("0.0 0.2 か\n0.2 0.4 ん\n", encoding="utf-8")
    with pytest.raises(FormatError, match="is no symbol of any of IPA, ARPAbet, X-SAMPA: convert the symbols"):
        read_marks(kana)
    with pytest.raises(FormatError, match="is no symbol of IPA; choose another alphabet or tier"):
        read_marks(kana, alphabet="ipa")
    ogg.write_bytes(b"OggS\x00\x02" + bytes(40))
    with pytest.raises(FormatError, match="is a sound, but not WAV: convert it to WAV"):
        read_marks(ogg)
    head = 'File type = "ooTextFile"\nObject class = "TextGrid"\n\nxmin = 0\nxmax = 1\ntiers? <exists>\n'
    head += "size = 1\nitem []:\n"
    tier = (
        '    item [1]:\n        class = "IntervalTier"\n        name = "phones"\n        xmin = 0\n        xmax = 1\n'
    )
    marks = "        intervals: size = 1\n        intervals [1]:\n            xmin = 0\n            xmax = 1\n"
    marks += '            text = ""\n'
    empty.write_text(head + tier + marks, encoding="utf-8")
    with pytest.raises(FormatError, match="has only empty tiers"):
        read_marks(empty)

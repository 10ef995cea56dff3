"""Texts and tables to words with weights: what counts, what is refused."""

from __future__ import annotations

import io
import json
from collections import Counter
from importlib.resources import files
from pathlib import Path
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.errors import PackworkError, ReadError, RecipeError
from packwork.readers.words.items import read_word_items
from packwork.readers.words.options import WordOptions
from packwork.readers.words.plurals import without_clitics
from packwork.readers.words.source import ranked_words, read_words
from packwork.readers.words.tokens import (
    guess_language,
    segments,
    sentences,
    stop_words,
)
from packwork.recipe.refusals import validated


def counted(text: str | dict[str, float], **options) -> dict[str, float]:
    read = read_words(validated(WordOptions, {"source": text, **options}))
    return {word.text: word.weight for word in read}


def tokens(text: str) -> list[str]:
    return [word for sentence in sentences(text) for word in sentence]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("l’été d'Anna's naïve café", ["l'été", "d'Anna", "naïve", "café"]),
        ("cafe\u0301", ["café"]),
        ("МЫ любим мёд", ["МЫ", "любим", "мёд"]),
        ("نحن نحب العسل", ["نحن", "نحب", "العسل"]),
        ("می\u200cخواهم", ["می\u200cخواهم"]),
        ("हिन्दी में", ["हिन्दी", "में"]),
        ("soft\u00adhyphen well-known", ["softhyphen", "well-known"]),
        (
            "Jean\u2011Paul, E-Mail--not twenty-six -- nor",
            ["Jean-Paul", "E-Mail", "not", "twenty-six", "nor"],
        ),
        ("Ein- und Ausgang 3-4 COVID-19 2024-05-01", ["Ein", "und", "Ausgang", "COVID-19"]),
        ("B2B 2024 ½ 3rd", ["B2B", "3rd"]),
        ("'tis 'quoted'", ["tis", "quoted"]),
        ("see https://a.org/x?y=1 and a.b@c.org", ["see", "and"]),
        ("tab\tand\x00null\ud800lone", ["tab", "and", "null", "lone"]),
    ],
)
def test_words_of_any_script_are_found(text: str, expected: list[str]) -> None:
    assert tokens(text) == expected


def test_capitals_at_the_beginning_of_sentences_tell_nothing() -> None:
    text = "House prices rise. House owners, and a house. Alice ran, then Alice sat. However!"
    words = read_words(WordOptions(source=text, language="none"))
    found = {word.text: word.weight for word in words}
    assert found["house"] == 3
    assert {"Alice", "However", "prices"} <= set(found)
    assert "House" not in found


def test_texts_without_spaces_are_cut() -> None:
    assert "世界" in segments("我们的世界需要更多的爱")
    assert "文化" in segments("日本の文化が好きです")
    assert "อาหาร" in segments("ประเทศไทยมีอาหารที่อร่อยมาก")


@pytest.mark.parametrize(
    ("text", "language"),
    [
        ("the bear and the bee are in the wood with all of their honey", "en"),
        ("der Bär und die Biene sind mit dem Honig in dem Wald", "de"),
        ("el oso y la abeja están en el bosque con la miel", "es"),
        ("медведь и пчела жили в лесу, и у них было очень много мёда, потому что", "ru"),
        ("भालू और मधुमक्खी के जंगल में है और यह शहद है", "hi"),
    ],
)
def test_the_language_is_guessed_and_its_function_words_left_out(text: str, language: str) -> None:
    assert guess_language(Counter(tokens(text))) == language
    assert not set(counted(text)) & stop_words(language)


def test_titles_in_capitals_have_a_language() -> None:
    titles = "The Matrix\nThe Lion King\nA Beautiful Mind\nThe Green Mile\nThe Sixth Sense"
    assert not {"the", "a"} & {word.casefold() for word in counted(titles)}


@pytest.mark.parametrize(
    "text",
    [
        "Mia Tom Per",
        "mia, tom, per",
        "Mia Per Tom Sara Lea Ben Mia",
        "Per Mia Tom Tom Mia Per " * 3,
    ],
)
def test_names_are_no_function_words(text: str) -> None:
    assert {word.casefold() for word in counted(text)} >= {"mia", "tom", "per"}


def test_a_short_sentence_has_a_language() -> None:
    assert set(counted("The cat sat on the mat")) == {"cat", "sat", "mat"}
    assert set(counted("THE CAT SAT ON THE MAT")) == {"CAT", "SAT", "MAT"}


def test_forms_of_one_word_count_together_and_look_as_they_mostly_do() -> None:
    text = "NASA bears. Bear BEAR bear, NASA nasa nasal bears"
    assert counted(text, language="en") == {"bear": 5.0, "NASA": 3.0, "nasal": 1.0}
    assert counted(text, language="en", case="upper", count=1) == {"BEAR": 5.0}
    assert counted(text, language="en", plurals="keep")["bears"] == 2.0


@pytest.mark.parametrize(
    ("language", "text", "expected"),
    [
        ("de", "Lampe Lampen Lampen Baum Bäume Kind Kinder Kindern Jahr Jahre Jahren Jahres",
         {"Lampen": 3, "Baum": 2, "Kind": 3, "Jahr": 4}),
        ("de", "Reis Reise Arbeit Arbeiter Burg Bürger Wein weinen Not Note",
         {"Reis": 1, "Reise": 1, "Arbeit": 1, "Arbeiter": 1, "Burg": 1, "Bürger": 1, "Wein": 1,
          "weinen": 1, "Not": 1, "Note": 1}),
        ("fr", "cheval chevaux chevaux maison maisons jeu jeux fil fils",
         {"chevaux": 3, "maison": 2, "jeu": 2, "fil": 1, "fils": 1}),
        ("es", "canción canciones luz luces casa casas", {"canción": 2, "luz": 2, "casa": 2}),
        ("pt", "nação nações animal animais papel papéis flor flores",
         {"nação": 2, "animal": 2, "papel": 2, "flor": 2}),
        ("it", "libro libri casa case amica amiche luogo", {"libro": 2, "casa": 2, "amica": 2}),
        ("nl", "kat katten boom bomen huis huizen tafel tafels",
         {"kat": 2, "boom": 2, "huis": 2, "tafel": 2}),
        ("pl", "dom domy", {"dom": 1, "domy": 1}),
        ("en", "new news glass glasses", {"new": 1, "news": 1, "glass": 2}),
    ],
)  # fmt: skip
def test_plurals_count_with_singulars_that_are_there(
    language: str, text: str, expected: dict[str, float]
) -> None:
    found = counted(text, language=language)
    assert {word: n for word, n in found.items() if word != "luogo"} == expected


@pytest.mark.parametrize(
    ("language", "text"),
    [
        ("it", "casa caso; porto porta; partito partita; scale scali; chiese chiesi"),
        ("de", "Bar Bär; Pol Polen; Fall Falle; Band Bande; Grab Graben; Burger Bürger"),
        ("pt", "mão mãe mães; avó avós"),
        ("nl", "zon zoon zonen; man maan manen; kop koop kopen"),
        ("es", "cruz cruces cruce"),
    ],
)
def test_two_words_are_not_joined_through_forms(language: str, text: str) -> None:
    # Only what stands before a word's own plural is one with it.
    own = {"mães", "zonen", "manen", "kopen"}
    words = text.replace(";", "").split()
    assert set(words) - set(counted(text, language=language)) <= own


def test_forms_are_those_of_one_singular() -> None:
    text = "casa case caso casi casi"
    assert counted(text, language="it") == {"casa": 2.0, "casi": 3.0}
    assert counted(text, language="it", stopwords="caso") == {"casa": 2.0}
    german = "Bär Bären Bar Fall Fälle Fällen Falle"
    assert counted(german, language="de") == {"Bär": 2.0, "Bar": 1.0, "Fall": 3.0, "Falle": 1.0}


LONG = 20_000


@pytest.mark.parametrize(
    ("language", "long"),
    [
        ("fr", "a" + "-t" * LONG + "-x"),
        ("de", "A" + "a" * LONG + "e"),
        ("en", "a-" * LONG),
        ("en", "a@" * LONG),
        ("en", "a@" + "." * LONG),
        ("en", "a" + "\u0301\u0327" * LONG),
    ],
)
def test_a_word_as_long_as_a_text_takes_no_longer_than_one(language: str, long: str) -> None:
    # Each of these took minutes.
    assert "chat" in counted(f"chat {long * 5} chat", language=language)


def test_addresses_of_mail_are_no_words() -> None:
    assert tokens("to a.b@c.org, (x@y.co.uk) and @bear or a@b") == [
        "to",
        "and",
        "bear",
        "or",
        "a",
        "b",
    ]


GERMAN = (
    "Die Menschen leben heute in den Jahren, und der Mensch ist nicht das, was er war. "
    "Heute ist die Zeit der Menschen, und sie ist gut."
)


def test_only_function_words_are_left_out() -> None:
    found = counted(GERMAN)
    assert found["Menschen"] == 3.0
    assert {"heute", "Jahren", "Zeit", "gut"} <= set(found)
    assert not {"die", "und", "nicht"} & set(found)


@pytest.mark.parametrize("asked", ["nicht,er", ["nicht", "er"], {"Nicht", "ER"}])
def test_words_are_kept_though_they_say_little(asked: object) -> None:
    found = counted(GERMAN, keep_words=asked)
    assert found["nicht"] == 1.0
    assert found["er"] == 1.0
    assert "und" not in found
    assert "er" not in counted(GERMAN, keep_words=asked, stopwords="er")


def test_words_of_a_letter_are_kept_that_are_named() -> None:
    assert counted("R and C and the R code", keep_words="R") == {"R": 2.0, "code": 1.0}


def test_content_words_are_of_the_lists_that_they_are_taken_from() -> None:
    stopwordsiso = pytest.importorskip("stopwordsiso")
    lines = files("packwork.bundled").joinpath("words", "content.txt").read_text("utf-8")
    for code, *words in map(str.split, lines.splitlines()):
        assert set(map(str.casefold, words)) <= {w.casefold() for w in stopwordsiso.stopwords(code)}
        assert not set(words) & stop_words(code)


def test_pronouns_come_off_french_verbs() -> None:
    text = "Il est là, et elle est dans la maison, répondit-il. Oui, répondit-elle, peut-être."
    assert counted(text, language="fr")["répondit"] == 2.0


@pytest.mark.parametrize("language", ["auto", "fr"])
@pytest.mark.parametrize("apostrophe", ["'", "\u2019"])
def test_articles_come_off_french_words(language: str, apostrophe: str) -> None:
    text = (
        "L'odeur de l'hiver s'éveille, c'est une odeur d'abricots et de pain, et l'on dit "
        "qu'il est là aujourd'hui, c'est-à-dire jusqu'à la nuit ; D'Artagnan n'a pas peur."
    )
    found = counted(text.replace("'", apostrophe), language=language)
    assert found.pop("odeur") == 2.0
    kept = {"hiver", "éveille", "abricots", "pain", "nuit", "Artagnan", "peur", "aujourd'hui"}
    assert kept <= set(found)
    assert not [word for word in set(found) - {"aujourd'hui"} if "'" in word or "est" in word]


@pytest.mark.parametrize("names", ["Anna Mia Tom", "summer sun beach"])
def test_one_function_word_makes_no_language_of_a_list(names: str) -> None:
    assert set(counted("\n".join(names.split()))) == set(names.split())


@pytest.mark.parametrize("numbers", [False, True])
def test_numbers_with_an_article_are_numbers(numbers: bool) -> None:
    text = "Une armée d'80 hommes, l'80e ; d'11. Près d'80 chevaux"
    found = counted(text, language="fr", include_numbers=numbers)
    assert {"armée", "hommes", "80e", "chevaux"} <= set(found)
    assert found.get("80", 0.0) == 2.0 * numbers


def test_what_is_nothing_but_clitics_is_a_word_still() -> None:
    assert all(without_clitics(["d'-la", "l''l", "d''", "c'-ce-la"], ["fr", "ca", "it", "pt"]))


@pytest.mark.parametrize(
    ("language", "text", "expected"),
    [
        (
            "it",
            "L'acqua dell'anno, un'ora: com'è quest'isola? C'era mezz'ora",
            "acqua isola mezz'ora",
        ),
        ("ca", "L'aigua d'un poble, i veure's: banyar-se, veure'l, s'ha", "aigua poble"),
        ("pt", "um copo d'água, viu-se", "copo água"),
        ("en", "don't, it's O'Connor's, d'you", "O'Connor d'you"),
        ("de", "Er stieg aufs Pferd, fürs Rennen, ins Tal, übers Feld, zum Haus", "Pferd Tal Haus"),
    ],
)
def test_what_joins_function_words_is_left_out(language: str, text: str, expected: str) -> None:
    found = counted(text, language=language)
    assert set(expected.split()) <= set(found)
    others = set(found) - set(expected.split())
    assert not [word for word in others if "'" in word or word.endswith("s")]


def test_phrases_are_counted_and_taken_off_their_words() -> None:
    text = "The White Rabbit ran. A white rabbit! My White Rabbit? One rabbit."
    found = counted(text, phrases=2)
    assert found["White Rabbit"] == 3.0
    assert found["rabbit"] == 1.0
    assert "white" not in found


def test_names_are_phrases_once_they_stand_there_twice() -> None:
    text = "We met Ada Lovelace. It was Ada Lovelace. A quick run, a quick run."
    found = counted(text, phrases=2, language="en")
    assert found["Ada Lovelace"] == 2.0
    assert "quick run" not in found


def test_own_stop_words_and_least_counts(tmp_path: Path) -> None:
    file = tmp_path / "stop.txt"
    file.write_text("Honey\nfox, owl", encoding="utf-8")
    text = "bear bear honey honey fox fox fly"
    assert counted(text, stopwords=str(file), min_count=2) == {"bear": 2.0}
    assert counted(text, stopwords=["honey"], min_count=2) == {"bear": 2.0, "fox": 2.0}
    both = {"bear": 2.0, "fox": 2.0, "fly": 1.0}
    assert counted(text, stopwords=(str(file), "bear")) == {"fly": 1.0}
    assert counted(text, stopwords="Honey, owl") == both
    with pytest.raises(ReadError, match=r"stop2\.txt: there is no such file"):
        counted(text, stopwords=str(tmp_path / "stop2.txt"))


@pytest.mark.parametrize("stop", ["hand", "Hands", "HAND"])
def test_a_stop_word_is_left_out_with_the_forms_that_count_with_it(stop: str) -> None:
    text = "a line by a hand. Hands remember. Hands of makers, a hand in the river"
    assert counted(text, language="en")["hand"] == 4.0
    assert not {"hand", "Hands"} & set(counted(text, language="en", stopwords=stop))
    assert len(counted(text, language="en", stopwords=stop, plurals="keep")) == 5


def test_a_stop_word_that_is_a_folder_or_has_a_comma_is_a_word(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bear").mkdir()
    table = {"bear": 3.0, "TCP/IP": 2.0, "Oslo, Norway": 2.0, "fox": 1.0}
    assert counted(table, stopwords=["bear", "tcp/ip", "Oslo, Norway"]) == {"fox": 1.0}


def test_standard_input_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    stdin = SimpleNamespace(buffer=io.BytesIO("\ufeffbear bear fox".encode()))
    monkeypatch.setattr("sys.stdin", stdin)
    assert counted("-") == {"bear": 2.0, "fox": 1.0}


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.csv", "bear,2\nfox,1\n"),
        ("a.csv", "weight,kind,word\n2,animal,bear\n1,animal,fox\n"),
        ("a.tsv", "Word\tCount\nbear\t2\nfox\t1"),
        ("a.json", json.dumps({"bear": 2, "fox": 1})),
        ("a.json", json.dumps([{"text": "bear", "value": 2}, {"text": "fox", "value": 1}])),
    ],
)
def test_tables_are_read(tmp_path: Path, name: str, text: str) -> None:
    file = tmp_path / name
    file.write_text(text, encoding="utf-8")
    assert counted(str(file)) == {"bear": 2.0, "fox": 1.0}


def test_columns_that_no_name_tells_are_told(tmp_path: Path) -> None:
    (tmp_path / "t.csv").write_bytes(b"Land;Ort;Jahr;Umsatz\nW;Bonn;2020;1.234,50\nN;Kiel;2021;2\n")
    columns = "Land and Ort are taken of the columns Land, Ort, Jahr, Umsatz; "
    others = "--label-by and --size-by take others"
    with pytest.raises(ReadError) as refused:
        read_words(WordOptions(source=str(tmp_path / "t.csv")))
    assert str(refused.value).endswith(
        f"not 'Bonn'; {columns}{others}, as --label-by Land --size-by Umsatz"
    )
    (tmp_path / "u.csv").write_bytes(b"Ort;Umsatz;Land\nBonn;3;W\nKiel;2;N\n")
    told = ranked_words(WordOptions(source=str(tmp_path / "u.csv"))).told
    assert f"Ort and Umsatz are taken of the columns Ort, Umsatz, Land; {others}" in str(told[0])
    asked = WordOptions(source=str(tmp_path / "u.csv"), label_by="Ort", size_by="Umsatz")
    assert not ranked_words(asked).told


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("sites.csv", "page,visits,topic,2024\n/a,10,bees,3\n/b,7,honey,5\n"),
        (
            "sites.json",
            '[{"topic": "bees", "visits": 10, "2024": 3}, {"topic": "honey", "2024": 5}]',
        ),
    ],
)
def test_columns_of_a_table_are_chosen_by_name(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    asked = {"source": str(tmp_path / name), "label_by": "topic", "size_by": "2024"}
    read = read_words(WordOptions(**asked))
    assert [(word.text, word.weight) for word in read] == [("honey", 5.0), ("bees", 3.0)]
    with pytest.raises(
        RecipeError, match=r"size_by: the table has no column 'sales'; there are .*topic"
    ):
        read_words(WordOptions(**{**asked, "size_by": "sales"}))


@pytest.mark.parametrize("source", ["bees and honey", {"bees": 2.0}])
def test_columns_are_of_tables_alone(source: object) -> None:
    with pytest.raises(RecipeError, match="label_by: names a column; give a table"):
        read_words(WordOptions(source=source, label_by="topic"))


def test_a_long_table_is_cut_and_what_reads_the_same_is_added_up(tmp_path: Path) -> None:
    file = tmp_path / "a.csv"
    file.write_text("".join(f"w{k % 6_000},{1 + k}\n" for k in range(10_000)), encoding="utf-8")
    read = read_word_items(WordOptions(source=str(file), count=2))
    assert {one.text: one.weight for one in read.words} == {
        "w3999": 14_000.0,
        "w3998": 13_998.0,
    }
    assert read.found == 6_000


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("", "holds no words"),
        ("bear", "line 1: needs a word and a weight"),
        ("bear,0", "line 1: a weight must be a positive number, not '0'"),
        ("bear,-1\nfox,-2", "line 1: a weight must be a positive number"),
        ("bear,nan", "positive number"),
        ("word,weight\nbear,many", "line 2"),
        ('"bear,1', "is not CSV"),
    ],
)
def test_bad_tables_are_one_clear_line(tmp_path: Path, text: str, problem: str) -> None:
    file = tmp_path / "a.csv"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(ReadError, match=r"a\.csv: ") as caught:
        counted(str(file))
    assert problem in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("source", "problem"),
    [
        ("missing.txt", "there is no such file"),
        ("my missing notes.txt", "there is no such file"),
        (" ", "source: is empty"),
        ("... --- ...", "holds no words"),
        ("1 2 3", "--include-numbers"),
        ("the and of the to", "holds 4 different words, and all are stop words"),
        ({}, "holds no words"),
        ({"\ud800\x00": 1}, "holds no words"),
    ],
)
def test_sources_without_words_are_one_clear_line(source, problem: str) -> None:
    with pytest.raises(ReadError) as caught:
        read_words(WordOptions(source=source))
    assert problem in str(caught.value)


@pytest.mark.parametrize(
    ("data", "kind"),
    [
        (b"\xef\xbb\xbf <svg xmlns='http://www.w3.org/2000/svg'/>", "a drawing"),
        (b"<!-- by hand -->\n<!-- of 2026 --><svg/>", "a drawing"),
        (b"<!DOCTYPE html><html><p>honey bear</p></html>", "a web page"),
        (b"%PDF-1.4\nhoney bear", "a PDF"),
        (b"PK\x03\x04" + bytes(40), "archive"),
        (rb"{\rtf1\ansi honey bear}", "RTF"),
        (b"\x89PNG\r\n\x1a\n" + bytes(range(256)), "a picture"),
    ],
)
@pytest.mark.parametrize("name", ["a.txt", "a.csv", "a.json", "a.svg"])
def test_files_that_are_no_text_are_named_as_what_they_are(
    tmp_path: Path, name: str, data: bytes, kind: str
) -> None:
    (tmp_path / name).write_bytes(data)
    with pytest.raises(ReadError, match=rf"is .*{kind}.*, not text; save") as caught:
        counted(str(tmp_path / name))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("comment", ["<!-- made of README.Rmd -->\n", f"<!--{' note' * 2_000} -->"])
def test_a_text_may_begin_with_a_comment(tmp_path: Path, comment: str) -> None:
    (tmp_path / "README.md").write_text(f"{comment}# Honey\nA bear likes honey.", encoding="utf-8")
    assert counted(str(tmp_path / "README.md"))["honey"] == 2
    assert counted(f"{comment} Bears like honey")["honey"] == 1


def told(source: object, **options: object) -> str:
    asked = WordOptions(source=source, **options)
    return "; ".join(str(error) for error in ranked_words(asked).told)


@pytest.mark.parametrize(
    "text", ["bear,5\nfox,3\n", "w;n\nbear; 2,5", "word;n;kind\nbear;5;a\nfox;3;b"]
)
def test_a_table_that_is_read_as_a_text_is_told(tmp_path: Path, text: str) -> None:
    (tmp_path / "a.txt").write_text(text, encoding="utf-8")
    assert "looks like a table" in told(str(tmp_path / "a.txt"))
    assert "looks like a table" in told("word\tn\tkind\nbear\t5\ta\nfox\t3\tb")
    assert "looks" not in told("Anna Bear\nHoney Street, 12\nForest, 1984")
    assert "looks" not in told("In the year, 1984\nthe bears, and the bees\ncame, 12 of them")


def test_a_list_of_names_is_a_word_a_line() -> None:
    names = "Anna\nBen\n\nOma  Ilse\nJean-Luc D’Arcy\nAnna\n"
    assert counted(names) == {"Anna": 2, "Ben": 1, "Oma Ilse": 1, "Jean-Luc D’Arcy": 1}
    assert "'Oma Ilse' is one word, as every line is" in told(names)
    assert "Oma" in counted(names, regexp=r"\w+")
    for text in (
        "Let it rain\nlet the rain\nbe in me",  # verses
        "Anna\nBen\nZoë",
        "Oma Ilse is here now\nOpa Karl\nBen",
        "Oma Ilse.\nOpa Karl\nBen",
        "Oma Ilse\nBen",
    ):
        assert "is a list" not in told(text)
        assert all(" " not in word for word in counted(text))


def test_numbers_for_words_and_what_is_idle_for_a_table_are_told(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("12,5\n9,25\n", encoding="utf-8")
    assert "has numbers for words; --label-by" in told(str(tmp_path / "a.csv"))
    said = told({"bear": 2}, min_count=3, language="de", case="upper")
    assert "no running text, of which --language, --min-count would tell" in said
    assert told({"bear": 2}, stopwords=("fox",)) == ""
    assert told("A bear and a bee", stopwords="Bear,fox", keep_words=["a", "Owl"]) == (
        "A bear and a bee: does not hold fox, which --stopwords names; "
        "A bear and a bee: does not hold owl, which --keep-words names"
    )
    (tmp_path / "a.csv").write_text("bear,2\nbee,1\n", encoding="utf-8")
    assert told(str(tmp_path / "a.csv"), stopwords="bee") == ""
    few = told(str(tmp_path / "a.csv"), stopwords="a,b,c,d,e")
    assert few.endswith("does not hold a, b, c and 2 more, which --stopwords names")


@pytest.mark.parametrize("weight", [0, -1, float("nan"), float("inf"), "many", None])
def test_weights_of_a_dict_must_be_positive(weight) -> None:
    with pytest.raises(RecipeError, match="the weight of 'bear' must be a positive number"):
        validated(WordOptions, {"source": {"bear": weight}})


def test_an_unknown_language_says_which_there_are() -> None:
    with pytest.raises(RecipeError, match="no list for 'klingon'"):
        counted("a bear in the wood", language="klingon")


@given(st.text(max_size=200))
def test_any_text_gives_words_or_a_refusal(text: str) -> None:
    try:
        words = read_words(WordOptions(source=text + " a b"))
    except PackworkError:
        return
    assert all(word.weight > 0 and word.text.isprintable() for word in words)


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({}, {"bear", "ox"}),
        ({"min_word_length": 3}, {"bear"}),
        ({"min_word_length": 1}, {"bear", "ox", "x"}),
        ({"include_numbers": True}, {"bear", "ox", "42"}),
        ({"regexp": r"[#@]\w+"}, {"#bear", "@ox"}),
        ({"regexp": r"(b)(e)ar"}, {"bear"}),
    ],
)
def test_what_counts_as_a_word_can_be_chosen(options: dict, expected: set[str]) -> None:
    text = "the #bear and the @ox, x and 42"
    assert set(counted(text, language="en", **options)) == expected


def test_a_pattern_that_is_none_is_refused() -> None:
    with pytest.raises(RecipeError, match="regexp: is no regular expression"):
        counted("a bear", regexp="(")


def test_words_of_nothing_are_counted_and_told() -> None:
    read = ranked_words(WordOptions(source={"bear": 2, " ": 1, "\t": 3, "|": 1}))
    assert [word.text for word in read.words] == ["bear"]
    assert [str(error) for error in read.told] == ["weights: 3 words are empty, and left out"]

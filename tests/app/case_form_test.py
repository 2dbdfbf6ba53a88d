"""Holds app/new_case/case_form.toml, which `boresight new` writes, to what the program reads.

Every table and key of docs/case-file.md, itself held to the reader by case_file_doc_test.py, must
stand in the form under the comment that the document makes of it, and nothing else; keys that are
needed must be there or a blank, keys that are not must be commented out. The blanks are then filled
one by one, and every key that may be left out is tried alone.

usage: case_form_test.py PROGRAM SOURCE_FOLDER [--write]     --write renews the comments
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap
import unittest

PROGRAM, SOURCE = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2])
FORM_PATH = SOURCE / "app/new_case/case_form.toml"
DOC = (SOURCE / "docs/case-file.md").read_text(encoding="utf-8")
ROOT = "The file itself"

HEADER = re.compile(r"(#?)(\[\[?[\w.]+\]\]?)$")
KEY = re.compile(r"(#?)(\w+) = (.*?)(?:  # such as (.*))?$")
# An optional key that says the same as one that the form has: the reader takes either.
EITHER = re.compile(r"expected either|found both|found it beside|only, found it with")


def documented():
    """{table: {key: (kind, range, needed, meaning)}}"""
    tables = {}
    for title, text in re.findall(r"^### `?(.*?)`?\n(.*?)(?=^##|\Z)", DOC, re.M | re.S):
        for part in text.split("\n\n"):
            lines = [line for line in part.splitlines() if line.startswith("|")]
            rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
            if rows and rows[0] == ["key", "kind", "range", "needed", "meaning"]:
                tables[title] = {row[0].strip("`"): tuple(row[1:]) for row in rows[2:]}
    return tables


def sentence(text):
    return text[:1].upper() + text[1:].rstrip(".") + "." if text else ""


def comment(kind, extent, needed, meaning):
    """The lines above a key: what it is, then kind, range and whether it may be left out."""
    need = {"yes": "needed", "no": "may be left out"}.get(needed, "needed " + needed)
    words = f"{sentence(meaning)} {sentence(', '.join(filter(None, [kind, extent])) + '; ' + need)}"
    words = words.replace("`", "").strip()
    # What the document has below, the form has not.
    words = words.replace("(below)", "(docs/case-file.md)")
    words = words.replace("of the list below", "of the list in docs/case-file.md")
    return textwrap.wrap(words, 98, initial_indent="# ", subsequent_indent="# ",
                         break_long_words=False, break_on_hyphens=False)


def renewed(form):
    """The form with the comments that the document makes, and its keys by table."""
    tables, table, lines, seen = documented(), ROOT, [], {ROOT: {}}
    for line in form.splitlines():
        if line.startswith("# "):
            continue
        header, key = HEADER.match(line), KEY.match(line)
        if header:
            table = header.group(2)
            seen.setdefault(table, {})
        elif key:
            assert key.group(2) in tables.get(table, {}), f"{table} has no key {key.group(2)}"
            # A second entry of a list needs no second explanation.
            if key.group(2) not in seen[table]:
                lines += comment(*tables[table][key.group(2)])
            seen[table][key.group(2)] = bool(key.group(1))
        lines.append(line)
    return "\n".join(lines) + "\n", seen


FORM = FORM_PATH.read_text(encoding="utf-8")


def written():
    """The file as `boresight new` writes it."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([PROGRAM, "new", "Test dish"], cwd=folder, check=True, capture_output=True)
        return (pathlib.Path(folder) / "Test dish/case.toml").read_text(encoding="utf-8")


def filled(text, most=None):
    """The first `most` blanks filled with what stands behind "such as"."""
    lines, done = text.splitlines(), 0
    for number, line in enumerate(lines):
        key = KEY.match(line)
        if key and key.group(3) == '"?"' and (most is None or done < most):
            lines[number] = f"{key.group(2)} = {key.group(4)}"
            done += 1
    return "\n".join(lines) + "\n"


def refusal(text):
    """The program's one line about a case, empty if it takes it."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "case.toml"
        path.write_text(text, encoding="utf-8")
        run = subprocess.run([PROGRAM, "model", str(path), "--quiet"], capture_output=True,
                             text=True, check=False)
    if run.returncode not in (0, 2):
        raise AssertionError(f"exit code {run.returncode}: {run.stderr}")
    return run.stderr if run.returncode == 2 else ""


class CaseForm(unittest.TestCase):
    maxDiff = None

    def test_has_every_key_with_the_words_of_the_document(self):
        text, seen = renewed(FORM)
        self.assertEqual(FORM, text, "run this script with --write")
        for table, keys in documented().items():
            if table == ROOT:
                tables = {name.strip("[]").split(".")[0] for name in seen if name != ROOT}
                self.assertEqual(set(keys) - {"title", "axis"}, tables)
            elif table != "[pointing]":  # stands in a case by its lists only
                nested = {name.strip("[]").rsplit(".", 1)[-1] for name in seen
                          if name.strip("[]").rpartition(".")[0] == table.strip("[]")}
                self.assertEqual(set(keys), set(seen.get(table, {})) | (nested & set(keys)), table)

    def test_what_is_needed_stands_and_what_is_not_is_commented_out(self):
        _, seen = renewed(FORM)
        tables = documented()
        for table, keys in seen.items():
            optional = f"#{table}" in FORM.splitlines()
            for key, commented in keys.items():
                needed = tables[table][key][2]
                with self.subTest(table=table, key=key):
                    if optional:
                        self.assertTrue(commented)
                    elif needed == "yes":
                        self.assertFalse(commented)
                    elif needed == "no":
                        self.assertTrue(commented)

    def test_the_first_blank_is_named_by_its_line_until_none_is_left(self):
        text = written()
        blanks = [number for number, line in enumerate(text.splitlines(), 1)
                  if (key := KEY.match(line)) and key.group(3) == '"?"']
        self.assertGreater(len(blanks), 10)
        for done, number in enumerate(blanks):
            message = refusal(filled(text, done))
            key = KEY.match(text.splitlines()[number - 1]).group(2)
            self.assertRegex(message, rf"case\.toml:{number}:\d+: [\w.\[\]]*{key}: expected .*, "
                                      r"found '\?', a blank to fill in\n$")
        self.assertEqual(refusal(filled(text)), "")

    def test_every_key_that_may_be_left_out_is_taken_where_it_stands(self):
        lines = filled(written()).splitlines()
        table, optional, tried = ROOT, False, 0
        for number, line in enumerate(lines):
            header, key = HEADER.match(line), KEY.match(line)
            if header:
                table, optional = header.group(2), bool(header.group(1))
            if optional or not key or not key.group(1):
                continue
            with self.subTest(table=table, line=line):
                message = refusal("\n".join(lines[:number] + [line[1:]] + lines[number + 1:]))
                # A key that depends on another may be refused alone.
                together = documented()[table][key.group(2)][2].startswith("with ")
                if not together and not EITHER.search(message):
                    self.assertRegex(message, r"^$|beside it|key is missing|expected a readable")
                tried += 1
        self.assertGreater(tried, 20)

    def test_every_table_that_may_be_left_out_is_taken_with_its_needed_keys(self):
        lines, tables = filled(written()).splitlines(), documented()
        top = [number for number, line in enumerate(lines)
               if (header := HEADER.match(line)) and header.group(1)]
        for begin in top:
            header = HEADER.match(lines[begin]).group(2)
            outer = header.strip("[]").rpartition(".")[0]
            if any(HEADER.match(lines[number]).group(2).strip("[]") == outer for number in top):
                continue  # left out with the table that contains it
            used = list(lines)
            for number in range(begin, len(lines)):
                inner = HEADER.match(lines[number])
                if inner and number > begin and not inner.group(2).strip("[]").startswith(
                        header.strip("[]") + "."):
                    break
                if lines[number].startswith("#"):
                    key = KEY.match(lines[number])
                    if inner:
                        table = inner.group(2)
                        used[number] = lines[number][1:]
                    elif key and tables[table][key.group(2)][2] not in ("no",):
                        used[number] = lines[number][1:]
            with self.subTest(table=header):
                message = refusal("\n".join(used))
                if not EITHER.search(message):
                    self.assertRegex(message, r"^$|one of the keys|expected a density|"
                                              r"expected (an antenna|a tachometer|\[tachometer)")


if __name__ == "__main__":
    if "--write" in sys.argv:
        FORM_PATH.write_text(renewed(FORM)[0], encoding="utf-8")
    else:
        unittest.main(argv=sys.argv[:1])

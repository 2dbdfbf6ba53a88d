"""Holds docs/case-file.md against the program: it must list exactly the keys, units and ids that
the program takes, and say truly which keys may be left out.

usage: case_file_doc_test.py PROGRAM SOURCE_FOLDER
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
DOC = (SOURCE / "docs/case-file.md").read_text(encoding="utf-8")
CASE = (SOURCE / "cases/dss14-70m/case.toml").read_text(encoding="utf-8")
# That case has every table but those of a recorded campaign.
RECORDED = (SOURCE / "tests/data/campaigns/full/case.toml").read_text(encoding="utf-8")
for mark in ("[[structure.prediction]]", "[instruments]", "[record_columns]", "[[record]]"):
    if mark + "\n" not in CASE:
        begin = RECORDED.index(mark + "\n")
        CASE += "\n" + RECORDED[begin:RECORDED.find("\n[", begin) + 1]
# Nor has it the signals of the antenna's control computer.
CASE += "\n[computer]\nvalve_voltage = '10 V'\nencoder_counts = 1048576\n"
# Nor has it those that only tuning reads.
CASE += (SOURCE / "tests/data/tuning/tables.toml").read_text(encoding="utf-8")
CASE += "\n[[remark]]\nplace = 'here'\ntext = 'the last table'\n"
# Tests at steady rates stand instead of the friction curve's numbers.
TESTS = "[[friction_curve.test]]"
TESTED = re.sub(r"^\[friction_curve\]\n(?:(?!\[).*\n)*",
                f"{TESTS}\nrate = '0.1 deg/s'\ntorque = '60 N.m'\n\n", CASE, flags=re.M)

# Titles in the document of what has no header in a case.
ROOT = "The file itself"
QUANTITY = "Quantity table"


def section(title):
    return re.search(rf"^### `?{re.escape(title)}`?\n(.*?)(?=^##|\Z)", DOC, re.M | re.S).group(1)


def table_rows(text):
    rows = [[cell.strip() for cell in line.strip("|").split("|")]
            for line in text.splitlines() if line.startswith("|")]
    return rows[2:]


def documented_keys():
    """{table: {key: needed}}"""
    tables = {}
    for title in re.findall(r"^### `?(.*?)`?$", DOC, re.M):
        keys = {}
        for part in section(title).split("\n\n"):
            rows = [line for line in part.splitlines() if line.startswith("|")]
            if rows and rows[0].startswith("| key |"):
                needed = [cell.strip() for cell in rows[0].strip("|").split("|")].index("needed")
                keys = {row[0].strip("`"): row[needed] for row in table_rows(part)}
        if keys:
            tables[title] = keys
    return tables


def refusal(text, command="model"):
    """The program's one line about a case, empty if it takes it."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "case.toml"
        path.write_text(text, encoding="utf-8")
        run = subprocess.run([PROGRAM, command, str(path)], capture_output=True, text=True,
                             check=False)
    if run.returncode not in (0, 2):
        raise AssertionError(f"exit code {run.returncode}: {run.stderr}")
    return run.stderr if run.returncode == 2 else ""


def keys_of(message):
    """The keys that a refusal of nobodys_key lists."""
    assert "nobodys_key: expected one of the keys" in message, message
    return set(re.findall(r"'(\w+)'", message.split("one of the keys ")[1].split(", found")[0]))


def cases_of_gains():
    """Cases with a key of nobody in present gains, whose structures have all gains between them."""
    integrals = r'^structure = "FULL\+N\+C"\n((?:.*\n)*?)wi = .*\n((?:.*\n)*?)wip = (.*)\n'
    for structure, gains in (("FULL+N+C", None), ("FULL+L+N+C", 'wpp = "0.1 rad/s"\nwzp = "1 rad/s"\n'),
                             ("FULL+D+N+C", 'wip = \\3\ndzp = "0.1 rad"\n'),
                             ("FULL+F+N+C", 'wip = \\3\nfzp = "0.1 rad"\n')):
        text = CASE.replace("\n[gains]\n", "\n[gains]\nnobodys_key = 1\n")
        if gains is not None:
            text = re.sub(integrals, f'structure = "{structure}"\n\\1\\2{gains}', text, flags=re.M)
        yield text


def block_of(table):
    """A case that has the table, and begin and end of the keys of its first entry there."""
    case = TESTED if table == TESTS else CASE
    begin = 0 if table == ROOT else re.search(rf"^{re.escape(table)}\n", case, re.M).end()
    return case, begin, case.index("\n[", begin) + 1


class CaseFileDocument(unittest.TestCase):
    def test_every_table_has_exactly_the_keys_of_the_program(self):
        tables = documented_keys()
        self.assertGreater(len(tables), 25)
        for table, keys in tables.items():
            with self.subTest(table=table):
                if table == QUANTITY:
                    text = CASE.replace('{ value = "70 m"', '{ nobodys_key = 1, value = "70 m"')
                elif table == ROOT:
                    text = "nobodys_key = 1\n" + CASE
                elif table == "[pointing]":  # stands in the case by its lists only
                    text = CASE.replace("[[pointing.band]]", "[pointing]\nnobodys_key = 1\n\n"
                                        "[[pointing.band]]", 1)
                else:
                    case, begin, _ = block_of(table)
                    text = case[:begin] + "nobodys_key = 1\n" + case[begin:]
                cases = cases_of_gains() if table == "[gains]" else [text]
                self.assertEqual(set(keys), set().union(*(keys_of(refusal(case)) for case in cases)))

    def test_keys_may_be_left_out_where_the_document_says_so(self):
        for table, keys in documented_keys().items():
            if table in (QUANTITY, ROOT, "[pointing]"):
                continue
            case, begin, end = block_of(table)
            block = case[begin:end]
            for key, needed in keys.items():
                line = re.search(rf"^{key} = .*\n", block, re.M)
                if line is None:
                    continue
                with self.subTest(table=table, key=key):
                    message = refusal(case[:begin] + block.replace(line.group(0), "") + case[end:])
                    if needed == "yes":
                        self.assertIn(f".{key}: expected", message)
                        self.assertIn("key is missing", message)
                    elif needed == "no":
                        self.assertEqual(message, "")

    def test_tables_may_be_left_out_where_the_document_says_so(self):
        for key, needed in documented_keys()[ROOT].items():
            # A table is left out with all its subtables.
            kept = re.sub(rf"^\[\[?{key}[.\]].*?(?=^\[|\Z)", "", CASE, flags=re.M | re.S)
            kept = re.sub(rf"^{key} = .*\n", "", kept, flags=re.M)
            with self.subTest(table=key):
                self.assertNotEqual(kept, CASE)
                if needed == "yes":
                    self.assertIn(f" {key}: expected", refusal(kept))
                elif key in ("tachometer", "friction_tests", "resonance", "impulse"):
                    # Statements about the test are left out with it.
                    self.assertNotIn("missing", refusal(kept))
                else:
                    self.assertEqual(refusal(kept), "")

    def test_names_the_units_of_the_program(self):
        documented = re.findall(r"`([^`]+)`", "".join(row[1] for row in table_rows(section("Units"))))
        source = (SOURCE / "io/units/unit_names.cpp").read_text(encoding="utf-8")
        self.assertEqual(sorted(documented), sorted(re.findall(r'NamedUnit\{"(.+?)"', source)))

    def test_every_stated_id_is_taken_with_its_kind(self):
        units = {row[0]: re.findall(r"`([^`]+)`", row[2])[0] for row in table_rows(section("Kinds"))}
        ids = [row for row in table_rows(section("[[stated]]")) if row[0].startswith("`")]
        ids = [(row[0].strip("`"), row[1]) for row in ids if row[1] in units]
        self.assertGreater(len(ids), 20)
        names = {"load_inertia": "J1", "line": "longest", "impulse": "slow-ramp", "band": "Ka"}
        for name, kind in ids:
            with self.subTest(id=name):
                quantity = name.replace("NAME", names.get(name.split(".")[0], ""))
                unit = units[kind] if kind != "number" else ""
                stated = f'\n[[stated]]\nquantity = "{quantity}"\nvalue = "2.5 {unit}"\n'
                self.assertEqual(refusal(CASE + stated), "")
        self.assertIn("case-file.md", refusal(CASE + '\n[[stated]]\nquantity = "x"\nvalue = "1"\n'))

    def test_every_key_of_both_cases_is_documented(self):
        every = {key for keys in documented_keys().values() for key in keys}
        for path in sorted((SOURCE / "cases").glob("*/case.toml")):
            text = re.sub(r'"(?:[^"\\]|\\.)*"', '""', path.read_text(encoding="utf-8"))
            text = re.sub(r"#.*", "", text)
            used = set(re.findall(r"(\w+) *=", text))
            self.assertLessEqual(used, every, path)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

"""The program as people meet it: help and its examples, what a misspelt word leads to, quiet, shell
completion, the manual, progress on a terminal only.

usage: program_test.py PROGRAM SOURCE_FOLDER
"""

import json
import os
import pathlib
import pty
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]).resolve()
CASE = str(SOURCE / "cases/dss14-70m/case.toml")


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False,
                          timeout=120, **options)


def printed(*arguments):
    result = run(*arguments)
    assert result.returncode == 0, result.stderr
    return result.stdout


def listed(help_text, title):
    """The names in the left column of a part of a help text."""
    part = help_text.partition(f"\n{title}:\n")[2].partition("\n\n")[0]
    return re.findall(r"^  (\S[^\n]*?)(?=  |$)", part, re.M)


COMMANDS = listed(printed("--help"), "Commands")
HELP = {command: printed(command, "--help") for command in COMMANDS}


def options_of(command):
    return {name for line in listed(HELP[command], "Options") for name in re.findall(r"--?[\w-]+", line)}


class Help(unittest.TestCase):
    def test_names_all_exit_codes(self):
        text = " ".join(printed("--help").split())
        for code in ("0 done", "1 internal error", "2 bad input", "3 constraints infeasible",
                     "4 numerical failure", "130 interrupted"):
            self.assertIn(code, text)

    def test_every_command_has_two_or_three_examples_that_it_takes(self):
        self.assertGreater(len(COMMANDS), 12)
        for command in ["", *COMMANDS]:
            text = HELP[command] if command else printed("--help")
            examples = re.findall(r"^  (.*boresight .*)\n      (.+)$", text.partition("Examples:")[2], re.M)
            self.assertIn(len(examples), (2, 3), command)
            for call, _ in examples:
                with self.subTest(call=call), tempfile.TemporaryDirectory() as folder:
                    call = re.search(r"boresight ([^|>)]*)", call).group(1)
                    result = run(*shlex.split(call), cwd=folder)
                    # There is no such case here: what the command line says was taken.
                    self.assertNotIn("--help", result.stderr)
                    if result.returncode != 0:
                        self.assertRegex(result.stderr, r"expected a readable file, found none")

    def test_spells_out_every_structure_that_shells_complete(self):
        offered = re.search(r"from tune' -l structure -r -a '([^']+)'", printed("completion", "fish"))[1].split()
        self.assertGreater(len(offered), 10)
        text = " ".join(HELP["tune"].split())
        for part in {part for name in offered for part in re.split(r"(?=\+)", name)}:
            self.assertRegex(text, rf"(?<![\w-]){re.escape(part)} \([a-zA-Z, ]+\)")

    def test_no_line_is_wider_than_a_report(self):
        for command in COMMANDS:
            for line in HELP[command].partition("Examples:")[0].splitlines():
                self.assertLessEqual(len(line), 108, line)

    def test_every_command_that_reports_has_the_options_that_all_have(self):
        for command in set(COMMANDS) - {"new", "completion", "man", "schema"}:
            self.assertLessEqual({"--json", "--seed", "--threads", "--quiet"}, options_of(command),
                                 command)


class Misspelt(unittest.TestCase):
    def refused(self, *arguments):
        result = run(*arguments)
        self.assertEqual(result.returncode, 2, arguments)
        self.assertEqual(result.stdout, "")
        return result.stderr

    def test_suggests_what_was_meant(self):
        for arguments, meant in (
                (["tnue", CASE], "tune"), (["bench-mark", CASE], "benchmark"),
                (["Tune", CASE], "tune"), (["tune", CASE, "--strcture", "PI"], "--structure"),
                (["model", CASE, "--thread=2"], "--threads"), (["--versoin"], "--version"),
                (["tune", CASE, "--structure", "DFP"], "DPF"),
                (["tune", CASE, "--structure", "pi+c"], "PI+C"),
                (["tune", CASE, "--goal", "gain_margn=8 dB"], "gain_margin"),
                (["match", CASE, "--structure", "FUL"], "FULL"),
                (["simulate", CASE, "slow-rmap"], "slow-ramp"),
                (["completion", "bahs"], "bash"), (["schema", "benchmrk"], "benchmark")):
            with self.subTest(arguments=arguments):
                self.assertIn(f"(did you mean '{meant}'?)", self.refused(*arguments))

    def test_says_nothing_where_nothing_is_near(self):
        self.assertNotIn("did you mean", self.refused("frobnicate"))
        self.assertIn("expected one of the commands", self.refused("frobnicate"))
        self.assertIn("expected a command, found none", self.refused())
        self.assertIn("CASE", self.refused("tune"))

    def test_a_key_of_a_case_or_a_proposal(self):
        text = pathlib.Path(CASE).read_text(encoding="utf-8")
        with tempfile.TemporaryDirectory() as folder:
            case = pathlib.Path(folder) / "case.toml"
            case.write_text(text.replace("displacement =", "displacment ="), encoding="utf-8")
            self.assertIn("is 'displacment' misspelt?", self.refused("model", str(case)))
            case.write_text(text.replace("[drive]", "[drvie]"), encoding="utf-8")
            self.assertIn("is 'drvie' misspelt?", self.refused("model", str(case)))
            case.write_text(text.replace("[gear_train]\ndensity", "[gear_train]\ndensty"), encoding="utf-8")
            self.assertIn("(did you mean 'density'?)", self.refused("model", str(case)))
            proposal = pathlib.Path(folder) / "half.toml"
            proposal.write_text('name = "half"\ndescription = "half"\ncost = { amount = "1", '
                                'currency = "EUR" }\n[motor]\nflywheel_disk = "12"\n',
                                encoding="utf-8")
            self.assertIn("(did you mean 'flywheel_disks'?)",
                          self.refused("evaluate", CASE, str(proposal)))


class Quiet(unittest.TestCase):
    def test_prints_no_report_and_errors_all_the_same(self):
        for command in ("audit", "model"):
            result = run(command, CASE, "--quiet")
            self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        result = run("model", "nowhere.toml", "--quiet")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertIn("nowhere.toml: expected a readable file", result.stderr)

    def test_writes_what_was_asked_for(self):
        self.assertEqual(json.loads(printed("model", CASE, "--quiet", "--json", "-"))["command"], "model")
        with tempfile.TemporaryDirectory() as folder:
            printed("audit", CASE, "--quiet", "--json", f"{folder}/audit.json")
            self.assertTrue(pathlib.Path(folder, "audit.json").is_file())
            result = run("new", "dish", "--quiet", cwd=folder)
            self.assertEqual((result.returncode, result.stdout), (0, ""))
            self.assertTrue(pathlib.Path(folder, "dish/case.toml").is_file())


class New(unittest.TestCase):
    def test_says_what_to_do_next_and_overwrites_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            first = run("new", "sites/25-m dish/", cwd=folder)
            self.assertEqual(first.returncode, 0, first.stderr)
            path = pathlib.Path(folder, "sites/25-m dish/case.toml")
            text = path.read_text(encoding="utf-8")
            self.assertIn('title = "25-m dish"\n', text)
            blanks, line = re.search(r"(\d+) blanks .* in line (\d+)\.", first.stdout).groups()
            self.assertEqual(int(blanks), text.count('= "?"'))
            self.assertIn('= "?"', text.splitlines()[int(line) - 1])
            path.write_text("mine", encoding="utf-8")
            again = run("new", "sites/25-m dish", cwd=folder)
            self.assertEqual(again.returncode, 2)
            self.assertIn("expected no file, found one", again.stderr)
            self.assertEqual(path.read_text(encoding="utf-8"), "mine")

    def test_refuses_where_no_folder_can_be(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "file").touch()
            result = run("new", "file/dish", cwd=folder)
            self.assertEqual(result.returncode, 2)
            self.assertIn("file/dish: expected a place for a folder", result.stderr)

    def test_a_title_of_any_letters_is_toml(self):
        with tempfile.TemporaryDirectory() as folder:
            run("new", 'a "dish" \\ of\nÅ', cwd=folder)
            path = next(pathlib.Path(folder).glob("*/case.toml"))
            message = run("model", str(path)).stderr
            self.assertIn("axis: expected one of", message)


class Completion(unittest.TestCase):
    def completed(self, *words):
        """What bash offers for the last word."""
        script = (f"source <({shlex.quote(PROGRAM)} completion bash)\n"
                  f"COMP_WORDS=(boresight {shlex.join(words)}); COMP_CWORD={len(words)}\n"
                  "_boresight\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n")
        result = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True,
                                cwd=SOURCE)
        self.assertEqual(result.stderr, "")
        return set(result.stdout.split("\n")) - {""}

    def test_bash_completes_commands_options_and_names(self):
        self.assertEqual(self.completed(""), set(COMMANDS))
        self.assertEqual(self.completed("re"), {"redesign"})
        for command in COMMANDS:
            self.assertEqual(self.completed(command, "-"), options_of(command), command)
        self.assertEqual(self.completed("tune", CASE, "--st"), {"--structure", "--starts"})
        self.assertEqual(self.completed("tune", CASE, "--structure", "FULL+N"), {"FULL+N", "FULL+N+C"})
        self.assertEqual(self.completed("tune", CASE, "--structure", "PI", "DPF+N"),
                         {"DPF+N", "DPF+N+C"})
        self.assertEqual(self.completed("match", CASE, "--time-domain", ""), {"none", "few", "all"})
        self.assertEqual(self.completed("simulate", CASE, "valve-"), {"valve-steps", "valve-chirp"})
        self.assertEqual(self.completed("completion", ""), {"bash", "zsh", "fish"})

    def test_bash_completes_files_where_files_are_wanted(self):
        self.assertEqual(self.completed("tune", "READ"), {"README.md"})
        self.assertEqual(self.completed("tune", CASE, "--json", "READ"), {"README.md"})
        self.assertEqual(self.completed("tune", CASE, "--structure", "READ"), set())
        self.assertEqual(self.completed("simulate", CASE, "slosh", "--folder", "cas"), {"cases"})
        # Behind an option's one value comes the next argument.
        self.assertEqual(self.completed("tune", "--json", "report.json", "READ"), {"README.md"})

    def test_every_shell_reads_its_script(self):
        for shell, check in (("bash", ["-n"]), ("zsh", ["-n"]), ("fish", ["--no-execute"])):
            if shutil.which(shell) is None:
                continue
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder, "script")
                path.write_text(printed("completion", shell), encoding="utf-8")
                result = subprocess.run([shell, *check, str(path)], capture_output=True, text=True,
                                        check=False, env={**os.environ, "HOME": folder})
                self.assertEqual((result.returncode, result.stderr), (0, ""), shell)

    @unittest.skipUnless(shutil.which("fish"), "no fish here")
    def test_fish_completes_structures(self):
        with tempfile.TemporaryDirectory() as folder:
            script = f"{shlex.quote(PROGRAM)} completion fish | source; complete -C "
            for line, offered in (("boresight red", {"redesign"}),
                                  ("boresight tune x --structure FULL+N", {"FULL+N", "FULL+N+C"})):
                result = subprocess.run(["fish", "-c", script + shlex.quote(line)], text=True,
                                        capture_output=True, check=True,
                                        env={**os.environ, "HOME": folder})
                self.assertEqual({word.split("\t")[0] for word in result.stdout.splitlines()}, offered)

    @unittest.skipUnless(shutil.which("zsh"), "no zsh here")
    def test_zsh_completes_in_a_terminal_of_its_own(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "_boresight").write_text(printed("completion", "zsh"), encoding="utf-8")
            script = f"""zmodload zsh/zpty
zpty shell 'HOME={folder} PS1= zsh -fi'
zpty -w shell 'fpath=({folder} $fpath); autoload -U compinit; compinit -u; LISTMAX=0; echo ready'
zpty -r -m shell line '*ready*ready*'
zpty -w -n shell $'boresight simulate x valve-\\t\\t'
sleep 0.5
zpty -r -m shell line '*valve-steps*' && print -r -- $line
"""
            result = subprocess.run(["zsh", "-f", "-c", script], capture_output=True, text=True,
                                    check=False, timeout=30)
            self.assertIn("valve-chirp", result.stdout + result.stderr)


class Manual(unittest.TestCase):
    def test_has_every_command_and_option_without_a_warning(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "boresight.1")
            path.write_text(printed("man"), encoding="utf-8")
            result = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", str(path)],
                                    capture_output=True, text=True, check=True,
                                    env={**os.environ, "MANWIDTH": "200", "LC_ALL": "C.UTF-8",
                                         "MANPAGER": "cat", "PAGER": "cat", "MANROFFOPT": "-c"})
        self.assertEqual(result.stderr, "")
        text = re.sub(r".\x08", "", result.stdout)
        for command in COMMANDS:
            self.assertRegex(text, rf"boresight {command}\b")
            for option in options_of(command):
                self.assertIn(option, text)
        self.assertIn("EXIT STATUS", text)
        self.assertIn("FULL+N+C", text)


class Terminal(unittest.TestCase):
    def errors_on_a_terminal(self, *arguments):
        """What the program writes to standard error where that is a terminal."""
        ours, theirs = pty.openpty()
        with subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.DEVNULL, stderr=theirs) as process:
            os.close(theirs)
            text = b""
            while True:
                try:
                    part = os.read(ours, 4096)
                except OSError:  # the other end is closed
                    break
                if not part:
                    break
                text += part
            self.assertEqual(process.wait(), 0)
        os.close(ours)
        return text.decode()

    def test_progress_and_time_left_are_for_terminals_and_not_when_quiet(self):
        with tempfile.TemporaryDirectory() as folder:
            work = ("simulate", CASE, "slosh", "--folder", folder)
            shown = self.errors_on_a_terminal(*work)
            self.assertRegex(shown, r"simulating, percent: \d+ of 100, about \d+ s left")
            self.assertTrue(shown.endswith("\r\x1b[K"), "the line is left behind")
            self.assertEqual(self.errors_on_a_terminal(*work, "--quiet"), "")
            result = run(*work)
            self.assertEqual(result.stderr, "")
            self.assertNotIn("\x1b", result.stdout)

    def test_simulated_records_do_not_depend_on_the_threads(self):
        with tempfile.TemporaryDirectory() as folder:
            reports = []
            for threads in ("1", "3"):
                reports.append(printed("simulate", CASE, "slosh", "valve-steps", "--threads", threads,
                                       "--folder", f"{folder}/records", "--json", "-"))
                for name in ("slosh", "valve-steps"):
                    record = pathlib.Path(folder, f"records/{name}.csv")
                    record.rename(f"{folder}/{name}.{threads}")
            self.assertEqual(reports[0], reports[1])
            for name in ("slosh", "valve-steps"):
                self.assertEqual(pathlib.Path(folder, f"{name}.1").read_bytes(),
                                 pathlib.Path(folder, f"{name}.3").read_bytes())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

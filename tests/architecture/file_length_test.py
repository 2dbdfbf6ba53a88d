"""No file that people write is longer than 500 lines, but those listed here with a reason.

usage: file_length_test.py SOURCE_FOLDER
"""

import pathlib
import subprocess
import sys

LIMIT = 500
WRITTEN = {".cpp", ".hpp", ".py", ".md", ".txt", ".cmake", ".toml", ".js", ".ts", ".css", ".html",
           ".sh", ""}

REASONS = {
    "docs/case-file.md": "a reference of one format, read by searching; its test reads it whole",
    "docs/accuracy.md": "tables that ./dev accuracy writes",
    "app/new_case/case_form.toml": "the form that boresight new writes: every key of the case file",
}
# Inputs of tests, made by programs or copied whole.
DATA = ("tests/data/", "tests/fuzz/corpus/", "LICENSE")


def main(root):
    names = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True,
                           text=True, check=True).stdout.split("\0")
    long_files, failures = set(), []
    for name in filter(None, names):
        path = root / name
        if path.suffix not in WRITTEN or name.startswith(DATA) or not path.is_file():
            continue
        lines = path.read_bytes().count(b"\n")
        if lines > LIMIT:
            long_files.add(name)
            if name not in REASONS:
                failures.append(f"{name}: {lines} lines, without a reason in {__file__}")
    failures += [f"{name}: listed as long, and is not" for name in REASONS
                 if name not in long_files]
    print("\n".join(failures) or f"{len(long_files)} files are longer than {LIMIT}, with a reason")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))

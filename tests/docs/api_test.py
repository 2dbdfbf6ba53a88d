"""The headers make an API reference without a warning, and what is documented wrongly would show.

usage: api_test.py SOURCE_FOLDER
"""

import pathlib
import subprocess
import sys
import tempfile


def reference(source, output, *settings):
    """Runs Doxygen by the project's Doxyfile with these settings instead of its own."""
    file = (source / "docs/Doxyfile").read_text(encoding="utf-8")
    file += "".join(f"\n{line}" for line in (f"OUTPUT_DIRECTORY = {output}", *settings))
    return subprocess.run(["doxygen", "-"], input=file, cwd=source, capture_output=True, text=True,
                          check=False)


def main(source):
    with tempfile.TemporaryDirectory() as folder:
        result = reference(source, folder)
        if result.returncode != 0 or result.stderr:
            print(result.stderr)
            return 1
        pages = list((pathlib.Path(folder) / "html").glob("*.html"))
        text = "".join(page.read_text(encoding="utf-8") for page in pages
                       if page.name.startswith("hydraulics_8hpp"))
        assert "oil_stiffness" in text and "Oil spring at the motor shaft" in text, "the headers' text is not there"
        wrong = pathlib.Path(folder) / "wrong.hpp"
        wrong.write_text("#pragma once\n/// Twice the value.\n/// @param none what nobody takes\n"
                         "double twice(double value);\n", encoding="utf-8")
        result = reference(source, f"{folder}/wrong", f"INPUT = {wrong}", "USE_MDFILE_AS_MAINPAGE =")
        assert result.returncode != 0 and "none" in result.stderr, "a wrong comment went unseen"
    print(f"{len(pages)} pages without a warning")
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))

"""Sources share a batch only where no name of one is a word of another, and keep it while they can.

usage: source_batches_test.py SOURCE_FOLDER
"""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(sys.argv[1]) / "cmake"))
from source_batches import batch_text, batches, local_names, renamed  # noqa: E402  (its folder is an argument)

HEAD, TAIL = "namespace boresight {\nnamespace {\n", "}  // namespace\n}  // namespace boresight\n"

declared = HEAD + """
using std::string;
constexpr double limit = 2.0;
struct Row {
  int inside;
};
class Reader : public Base {
};
std::vector<double> read(int from) {
  return {};
}
MATCHER_P(IsNear, other, "") {
}
TEST(Suite, Name) {
}
""" + TAIL + "void exported() {}\n"
assert local_names(declared) == {"limit", "Row", "Reader", "read", "IsNear"}, local_names(declared)

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)

    def write(file, inside, outside=""):
        (folder / file).write_text(HEAD + inside + TAIL + outside, encoding="utf-8")
        return str(folder / file)

    first = write("first.cpp", "int one() { return 1; }\n")
    same = write("same.cpp", "int one() { return 2; }\n")
    word = write("word.cpp", "", "int uses = one;\n")
    member = write("member.cpp", "", "int uses = row.one + place->one;\n")
    other = write("other.cpp", "int two() { return 2; }\n")
    everything = [first, same, word, member, other]
    made = batches(everything, 10)
    assert made == [[first, member, other], [same], [word]], made
    assert max(len(batch) for batch in batches(everything, 2)) == 2
    # A source stays where it was, whatever is added before it, until it clashes there.
    kept = {first: 1, other: 0}
    assert batches([other, member, first], 10, kept) == [[other, member], [first]]
    write("other.cpp", "int two() { return one; }\n")
    assert batches([first, other], 10, {first: 0, other: 0}) == [[first], [other]]

    # With what headers declare known, names that are a file's own are renamed and no longer clash.
    assert batches([first, same, word, member], 10, None, set()) == [[first, same, word, member]]
    text = batch_text([first, same], set())
    assert "#define one one_of_" in text and text.count("#undef one\n") == 2, text
    # A header's name, a member's and one that a macro makes text of stay as they are.
    assert renamed(HEAD + "int one() { return 1; }\n" + TAIL, {"one"}) == set()
    assert renamed(HEAD + "int one() { return row.one; }\n" + TAIL, set()) == set()
    assert renamed(HEAD + "struct One {};\n" + TAIL + "TEST_F(One, Two) {}\n", set()) == set()
    # Includes come first, those under a condition only where the file has them.
    head = write("head.cpp", "int three() { return 3; }\n")
    pathlib.Path(head).write_text("#include <vector>\n#ifdef X\n#include <none>\n#endif\n", encoding="utf-8")
    assert batch_text([head], set()) == f'#include <vector>\n#include "{head}"\n'
    # What a file sets for the headers that follow is read by them, and by those of no other file.
    sets = write("sets.cpp", "int four() { return 4; }\n")
    pathlib.Path(sets).write_text("#include <map>\n#define X 1\n#include <vector>\n", encoding="utf-8")
    assert batches([first, sets, head], 10) == [[first, head], [sets]]
    assert batches([sets, first, head], 10) == [[sets], [first, head]]
    assert batch_text([sets], set()) == f'#include <map>\n#include "{sets}"\n'

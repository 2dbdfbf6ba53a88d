"""Sources share a batch only where no name of one is a word of another, and keep it while they can.

usage: source_batches_test.py SOURCE_FOLDER
"""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(sys.argv[1]) / "cmake"))
from source_batches import (  # noqa: E402  (its folder is an argument)
    Headers, batch_text, batches, local_names, renamed, with_names_of_its_own)

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
[[noreturn]] void refuse(int what) {
}
MATCHER_P(IsNear, other, "") {
}
TEST(Suite, Name) {
}
""" + TAIL + "void exported() {}\n"
assert local_names(declared) == {"limit", "Row", "Reader", "read", "refuse", "IsNear"}, local_names(declared)

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)

    def write(file, inside, outside=""):
        (folder / file).write_text(HEAD + inside + TAIL + outside, encoding="utf-8")
        return str(folder / file)

    first = write("first.cpp", "int one() { return 1; }\n")
    same = write("same.cpp", "int one() { return 2; }\n")
    word = write("word.cpp", "", "int uses = one;\n")
    member = write("member.cpp", "", "int uses = row.one + place->one + Scope::one;\n")
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
    (folder / "plant").mkdir()
    (folder / "plant" / "one.hpp").write_text("#include <boresight/plant/inner.hpp>\n", encoding="utf-8")
    (folder / "plant" / "inner.hpp").write_text("int declared(int);\nstruct Inner : Base {\n  int member;\n};\nstruct Base { int inherited; };\n",
                                              encoding="utf-8")
    headers = Headers(folder)
    assert headers.declared("#include <boresight/plant/one.hpp>\n") == {"declared", "Inner", "Base"}
    defines = "#include <boresight/plant/one.hpp>\ndouble Inner::at(int part) {\n}\n"
    assert {"member", "inherited"} <= headers.declared(defines), headers.declared(defines)
    assert headers.declared("#include <vector>\n") == set()
    assert batches([first, same, word, member], 10, None, headers) == [[first, same, word, member]]
    text = batch_text([first, same], headers)
    assert f'#line 1 "{first}"\n{HEAD}int one_of_' in text and "first()" in text, text
    # A header's name, that of a class's member and one that a macro makes text of stay as they are.
    assert renamed(HEAD + "int one() { return 1; }\n" + TAIL, {"one"}) == set()
    assert renamed(HEAD + "int one() { return row.one; }\n" + TAIL, set()) == {"one"}
    assert renamed(HEAD + "int one() { return row.one; }\nstruct Row {\n  int one;\n};\n" + TAIL, set()) == {"Row"}
    assert renamed(HEAD + "struct One {};\n" + TAIL + "TEST_F(One, Two) {}\n", set()) == set()
    # Comments, texts, includes and members keep the word.
    kept_words = '#include <one>\n// one\nauto a = "one\\" one" + R"(one " one)" + row.one + X::one + 1\'one;\n'
    assert with_names_of_its_own(kept_words + "int b = one - someone;", {"one"}, "x") == (
        kept_words + "int b = one_of_x - someone;")
    # Includes come first, those under a condition only where the file has them.
    head = write("head.cpp", "int three() { return 3; }\n")
    pathlib.Path(head).write_text("#include <vector>\n#ifdef X\n#include <none>\n#endif\n", encoding="utf-8")
    assert batch_text([head], headers).startswith(f'#include <vector>\n#line 1 "{head}"\n')
    # What a file sets for the headers that follow is read by them, and by those of no other file.
    sets = write("sets.cpp", "int four() { return 4; }\n")
    pathlib.Path(sets).write_text("#include <map>\n#define X 1\n#include <vector>\n", encoding="utf-8")
    assert batches([first, sets, head], 10) == [[first, head], [sets]]
    assert batches([sets, first, head], 10) == [[sets], [first, head]]
    assert batch_text([sets], headers).startswith(f'#include <map>\n#line 1 "{sets}"\n')

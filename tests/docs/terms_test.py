"""Documents, comments and names of public headers, string literals of the program and keys of its JSON use the
field's terms and not the private ones that stood for them.

usage: terms_test.py SOURCE_FOLDER
"""

import json
import pathlib
import re
import sys

import markdown

MODULES = ("numerics", "plant", "identification", "control", "design", "io", "app")

# (private term, what to write). Legitimate senses are left out by the pattern.
TERMS = (
    (r"(?<!power )laws?\b", "controller; structure and gains; model"),
    (r"held (?:on|gains?)\b", "evaluated with fixed gains"),
    (r"(?:may be|might be) the true one", "ensemble member, uncertainty set"),
    (r"hard goals?\b", "constraint"),
    (r"soft goals?\b", "objective"),
    (r"hunt(?:s|ed|ing)?\b", "limit cycle"),
    (r"(?:holds?|held) still\b", "is free of limit cycles"),
    (r"more buys\b", "relaxing this limit lowers the rms by"),
    (r"turn(?:s|ed|ing)? round\b", "velocity reversal"),
    (r"beam (?:error|rms)\b", "boresight error"),
    (r"heavy\b|heavier\b", "of high inertia"),
    (r"hangs? (?:on|upon)\b", "depends on"),
    (r"goes with\b", "scales with"),
    (r"foretold\b|foretell\w*", "predicted"),
    (r"retreats?\b", "backtrack"),
    (r"weigh(?:s|ed)?\b", "have weight, inertia"),
    (r"reckon\w*", "compute"),
    (r"in (?:the|its) (?:place|stead) of\b", "instead of"),
    (r"losses out\b", "damping-corrected"),
    (r"kept out of\b", "exclusion"),
)
# Terms that prose may use in a plain sense and a literal of the program must not.
LITERAL_TERMS = TERMS + (
    (r"(?<!they )shares?\b", "fraction"),
    (r"(?<!--)draws?\b", "samples"),
    (r"reconciled\b", "combined"),
    (r"winding\b", "encirclements"),
    (r"valve effort\b", "control effort"),
    (r"peaks? of S\b", "Ms"),
    (r"gains held\b", "with fixed gains"),
    (r"judged\b", "evaluated"),
    (r"chances?\b", "probability, realisation error"),
    (r"joint\b", "interaction"),
    (r"(?<!Pareto )front of cost\b", "Pareto front"),
)
# Words of a name, in order, as `a_name` or `AName` has them; "*": at the beginning of a name only.
NAME_TERMS = (
    (("law",), "controller"), (("laws",), "controllers"),
    (("hunting",), "limit cycle"), (("hunts",), "limit cycle"), (("unrest",), "limit cycle"),
    (("holds", "still"), "is_limit_cycle_free"), (("not", "still"), "limit cycle"),
    (("held", "gains"), "fixed gains"), (("held", "law"), "fixed gains"), (("held", "rms"), "fixed gains, flexure"),
    (("encoder", "held"), "flexure"), (("held", "candidate"), "fixed gains"),
    (("hard", "goals"), "constraints"), (("soft", "goal"), "objective"), (("goal", "ratio"), "normalised constraint"),
    (("limiting", "goal"), "active constraint"), (("active", "goals"), "active constraints"),
    (("within", "goals"), "within constraints"), (("goals", "met"), "constraints met"),
    (("beam",), "boresight"), (("share",), "fraction"), (("shares",), "fractions"),
    (("reconciled",), "combined"), (("standing",), "stability basis"), (("winding",), "encirclements"),
    (("judge",), "evaluate"), (("judged",), "evaluated"), (("judgement",), "evaluation"), (("judges",), "evaluates"),
    (("draws",), "samples"), (("chance",), "probability, realisation error"), (("joint",), "interaction"),
    (("*", "most"), "max"), (("*", "least"), "min"),
    (("valve", "effort"), "control effort"), (("nonlinear", "factor"), "simulated to linear rms"),
    (("drive", "reach"), "drive capability"), (("within", "reach"), "achievable limits"),
    (("supply", "wind", "speed"), "torque-limited wind speed"), (("torque", "for", "wind"), "available wind torque"),
    (("following", "changes"), "dependent changes"), (("consequence",), "derived quantity"),
    (("consequences",), "derived quantities"), (("retreat",), "backtrack"),
    (("carried", "members"), "active scenarios"), (("carried", "plants"), "active scenarios"),
    (("torque", "course"), "disturbance type"), (("controlled", "course"), "closed-loop response"),
    (("loop", "course"), "reference trajectory"), (("test", "value"), "sample information"),
    (("grey", "box", "doubts"), "model adequacy"), (("motion", "doubts"), "unidentifiable directions"),
    (("price", "of"), "cost of"), (("knowing", "everything"), "perfect information"),
)
# Names that are right, and why.
ALLOWED_NAMES = {
    "beam_weight": "key of the case file", "bull_gear_beam_weight": "key of the case file",
    "case_leakage_share": "key of the case file", "null_leakage_share": "key of the case file",
    "joint_intensity": "of a joint distribution", "standing_": "that stands, of an event's state",
    "least_squares": "the method", "least_favourable": "of responses, in statistics",
    "least_of": "of several values", "most_moved": "what is moved most", "power_law": "a power law",
    "LeastSquaresOptions": "the method", "LeastSquaresResult": "the method", "LeastSquaresStatus": "the method",
}
# Literals that are right, and why.
ALLOWED_LITERALS = {"draws": "key of the case file, argument of evaluate()"}
# Files that hold the names and keys of an earlier version to read them.
OF_OLD_NAMES = ("io/files/renamed_keys.cpp", "python/renamed_names.cpp")
LITERAL = re.compile(r'R"(?P<end>\w*)\((?P<raw>.*?)\)(?P=end)"|"(?P<plain>(?:[^"\\\n]|\\.)*)"|//[^\n]*|/\*.*?\*/|'
                     r"#[ ]*include[^\n]*|(?<!\w)'(?:[^'\\\n]|\\.)'", re.S)
SCRIPT_LITERAL = re.compile(r'"(?P<plain>(?:[^"\\\n]|\\.)*)"|`(?P<raw>[^`]*)`|//[^\n]*|/\*.*?\*/', re.S)
NAME = re.compile(r"[A-Za-z_]\w*")
WORD = re.compile(r"[A-Z]+(?=[A-Z][a-z])|[A-Z]?[a-z]+|[A-Z]+|\d+")

PATTERNS = [(re.compile(r"\b(?:" + term + ")", re.I), instead) for term, instead in TERMS]
LITERAL_PATTERNS = [(re.compile(r"\b(?:" + term + ")", re.I), instead) for term, instead in LITERAL_TERMS]
QUOTED = re.compile(r"`[^`]*`|\"[^\"]*\"")
COMMENT = re.compile(r"//.*")


def found_in(text):
    """[(term as it stands, what to write)] of a line, quotations and code aside."""
    prose = QUOTED.sub(" ", text)
    return [(hit.group(), instead) for pattern, instead in PATTERNS for hit in pattern.finditer(prose)]


def found_in_literal(text):
    """The same of a string literal's text."""
    if text in ALLOWED_LITERALS:
        return []
    return [(hit.group(), instead) for pattern, instead in LITERAL_PATTERNS for hit in pattern.finditer(text)]


def found_in_name(name):
    """The same of an identifier or a key."""
    if name in ALLOWED_NAMES:
        return []
    words = ["*"] + [word.lower() for word in WORD.findall(name)]
    return [(name, instead) for term, instead in NAME_TERMS
            if any(tuple(words[k:k + len(term)]) == term for k in range(len(words)))]


def literals_of(source, pattern):
    """(line number, text) of the string literals of a source, adjacent ones as the one that they are."""
    text, begin, end = "", 0, 0
    for hit in pattern.finditer(source):
        part = hit.group("raw") or hit.group("plain")
        if not part:
            continue
        if text and not source[end:hit.start()].strip():
            text += part
        else:
            if text:
                yield source.count("\n", 0, begin) + 1, text
            text, begin = part, hit.start()
        end = hit.end()
    if text:
        yield source.count("\n", 0, begin) + 1, text


def wrong_literals(root):
    """Of all literals of the program, the libraries and the Python module; and how many there are."""
    wrong, count = [], 0
    files = [file for module in MODULES + ("python",) for ending in ("*.cpp", "*.hpp", "*.js")
             for file in sorted((root / module).rglob(ending))]
    for file in files:
        name = str(file.relative_to(root))
        if name in OF_OLD_NAMES:
            continue
        pattern = SCRIPT_LITERAL if name.endswith(".js") else LITERAL
        for number, text in literals_of(file.read_text(encoding="utf-8"), pattern):
            count += 1
            wrong += [f"{name}:{number}: '{term}' in a literal: write '{instead}'"
                      for term, instead in found_in_literal(text)]
    return wrong, count


def keys_of(schema):
    """All keys of an object that a JSON schema describes."""
    if isinstance(schema, dict):
        properties = schema.get("properties")
        if isinstance(properties, dict):
            yield from properties
        for value in schema.values():
            yield from keys_of(value)
    elif isinstance(schema, list):
        for value in schema:
            yield from keys_of(value)


def wrong_keys(root):
    """Of docs/*.schema.json; and how many there are."""
    keys = {(file.name, key) for file in sorted((root / "docs").glob("*.schema.json"))
            for key in keys_of(json.loads(file.read_text(encoding="utf-8")))}
    return [f"docs/{name}: key '{term}': write '{instead}'" for name, key in sorted(keys)
            for term, instead in found_in_name(re.sub(r"_1$", "", key))], len(keys)


def wrong_names(root):
    """Of the identifiers of public headers; and how many there are."""
    wrong, count = [], 0
    for module in MODULES:
        for header in sorted((root / module).rglob("*.hpp")):
            names = set(NAME.findall(LITERAL.sub(" ", header.read_text(encoding="utf-8"))))
            count += len(names)
            wrong += [f"{header.relative_to(root)}: name '{term}': write '{instead}'"
                      for name in sorted(names) for term, instead in found_in_name(name)]
    return wrong, count


def lines_of(root):
    """(file, line number, text) of all prose of documents and all comments of public headers."""
    for document in markdown.documents(root):
        name = str(document.relative_to(root))
        if name.startswith("docs/") or name == "README.md":
            for number, line in markdown.split(document)[0]:
                yield name, number, line
    for module in MODULES:
        for header in sorted((root / module).rglob("*.hpp")):
            for number, line in enumerate(header.read_text(encoding="utf-8").splitlines(), 1):
                if comment := COMMENT.search(line):
                    yield str(header.relative_to(root)), number, comment.group()


def check_itself():
    """A planted term of each kind is found, and a legitimate name is not."""
    planted = 'fmt::format("no stable law on {} draws", R"(gains )"\n  "held"); // a law\nint x = \'"\';'
    assert len(list(literals_of(planted, LITERAL))) == 2
    assert sum(len(found_in_literal(text)) for _, text in literals_of(planted, LITERAL)) == 3
    assert not found_in_literal("a power law of 30 samples, --draws 100")
    assert [term for name in ("ControlLaw", "beam_rms", "least_cost", "HardGoals", "within_reach", "least")
            for term, _ in found_in_name(name)] == ["ControlLaw", "beam_rms", "least_cost", "HardGoals", "within_reach",
                                                    "least"]
    assert not any(map(found_in_name, ("beam_weight", "beamwidth", "lawful", "at_least", "controller", "min_cost")))
    assert set(keys_of({"properties": {"laws": {"items": {"properties": {"beam_rms_mdeg": {}}}}}})) == {"laws",
                                                                                                     "beam_rms_mdeg"}


def main(root):
    # The patterns find what they are for, and leave a legitimate sense alone.
    assert found_in("the law that holds still on plants that may be the true one")
    assert not found_in("the power law of mean speed, `law` and \"hard goal\"")
    check_itself()
    wrong, lines = [], 0
    for name, number, line in lines_of(root):
        lines += 1
        wrong += [f"{name}:{number}: '{term}': write '{instead}'" for term, instead in found_in(line)]
    assert lines > 5000, f"only {lines} lines were read"
    for found, least in ((wrong_literals(root), 5000), (wrong_keys(root), 500), (wrong_names(root), 5000)):
        wrong += found[0]
        assert found[1] > least, f"only {found[1]} were read"
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"{lines} lines without a private term")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))

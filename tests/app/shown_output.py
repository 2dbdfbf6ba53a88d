"""What pages of the documentation show of a command's output, against what the program prints."""

import re
import shlex
import subprocess

figure = re.compile(r"\d+(?:\.\d+)?")


def unit_of_whole(word, digits):
    """Of the last digit of a whole number that is rounded to so many digits: 10 for 1230 and 3."""
    zeros = len(word) - len(word.rstrip("0"))
    return 10**max(0, min(zeros, len(word) - digits))


def same(shown, printed, whole=0, digits=99):
    """Whether two texts differ by no more than blanks and another processor's rounding: two units of
    the last digit of a number with a decimal point, `whole` units of a number without one, which may
    be rounded to `digits` digits."""
    if figure.sub("#", shown).split() != figure.sub("#", printed).split():
        return False
    for x, y in zip(figure.findall(shown), figure.findall(printed)):
        places = min(len(word.partition(".")[2]) for word in (x, y))
        unit = min(unit_of_whole(word, digits) for word in (x, y))
        if abs(float(x) - float(y)) > (2.001 * 10.0**-places if places else whole * unit):
            return False
    return True


def not_printed(shown, printed):
    """Those of the lines shown that none of the lines printed is the same as."""
    exact = {line.strip() for line in printed}
    return [line for line in shown
            if line.strip() not in exact and not any(same(line, one) for one in printed)]


def printed_by(program, source, command):
    """The lines that a command such as "boresight model cases/*/case.toml" prints."""
    words = shlex.split(command)
    assert words[0] == "boresight", command
    arguments = []
    for word in words[1:]:
        arguments += sorted(str(p.relative_to(source)) for p in source.glob(word)) \
            if "*" in word else [word]
    result = subprocess.run([program, *arguments], cwd=source, capture_output=True, text=True,
                            check=True)
    return result.stdout.splitlines()


def check_blocks(program, source, page):
    """Holds each line of a page's indented blocks against the output of the command that heads them:
    the output of each command, and how many lines were checked."""
    outputs, current, lines = {}, None, 0
    for line in page.splitlines():
        if not line.startswith("    "):
            continue
        text = line.strip()
        if text.startswith("boresight "):
            if text not in outputs:
                outputs[text] = printed_by(program, source, text)
            current = outputs[text]
        elif text:
            assert current is not None, f"no command stands before: {line}"
            assert not not_printed([text], current), f"the program does not print: {line}"
            lines += 1
    return outputs, lines

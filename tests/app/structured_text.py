"""An interpreter of a strict subset of IEC 61131-3 (3rd edition) Structured Text, so that tests can
hold an exported controller against the program without a PLC.

    block = structured_text.parse(text)["SERVO_CONTROLLER"]
    instance = block.instance()
    instance.call(RUN=True, TARGET_ANGLE=1.0)
    instance["VALVE_COMMAND"]

The subset holds:
- FUNCTION_BLOCK with VAR_INPUT, VAR_OUTPUT, VAR, VAR CONSTANT and VAR_TEMP, each declaration
  `name : TYPE;` or `name : TYPE := literal;` of BOOL, DINT, REAL or LREAL; both kinds of comments,
- assignments, IF with ELSIF and ELSE, RETURN; no branch is empty,
- parentheses, unary - and NOT, * /, + -, < > <= >=, = <>, AND, XOR, OR, which evaluate both sides,
- ABS, SQRT, EXP, MIN, MAX, LIMIT, SEL, TRUNC and the conversions in CONVERSIONS of
  structured_text_syntax.py. Those to BOOL are left out, because compilers disagree on them: write
  X <> 0.

parse() refuses text that a strict compiler may refuse: no type is converted implicitly, neither
widened nor narrowed, and an untyped real literal takes the type that its place needs. It raises
StructuredTextError with the line number.

REAL is rounded to binary32 after each operation, LREAL is binary64. Division of reals by zero and
overflow give infinity or NaN; with NaN only <> is TRUE. SQRT and EXP of a REAL are those of
binary64, rounded; a PLC may differ in the last bit of EXP. These raise StructuredTextError at the
call, with the line number: DINT overflow, DINT division by zero, TRUNC and conversions beyond DINT,
and NaN in MIN, MAX or LIMIT, whose result the standard leaves open.

structured_text_tokens.py splits the text, structured_text_syntax.py checks it and writes Python
text, and this file compiles and runs that. structured_text_test.py tests all three.
"""

import ast
import ctypes
import math

from structured_text_syntax import Parser, to_binary32
from structured_text_tokens import StructuredTextError

# What the Python text of a block calls.

def dint(value):
    if not -2**31 <= value < 2**31:
        raise ArithmeticError("the value is beyond DINT")
    return value


def dint_quotient(dividend, divisor):
    quotient = abs(dividend) // abs(divisor)
    return quotient if (dividend < 0) == (divisor < 0) else -quotient


def dint_of(rounding, value):
    if not math.isfinite(value):
        raise ArithmeticError(f"no DINT stands for {value}")
    return dint(rounding(value))


def real_quotient(dividend, divisor):
    if divisor != 0:
        return dividend / divisor
    if dividend == 0 or math.isnan(dividend):
        return math.nan
    return math.copysign(math.inf, dividend) * math.copysign(1.0, divisor)


def exponential(value):
    try:
        return math.exp(value)
    except OverflowError:
        return math.inf


def extreme(choice, *values):
    if any(math.isnan(value) for value in values):
        raise ArithmeticError("NaN in MIN, MAX or LIMIT")
    return choice(values)


RUN_TIME = {
    "binary32": ctypes.c_float, "dint": dint, "dint_quotient": dint_quotient, "dint_of": dint_of,
    "real_quotient": real_quotient, "exponential": exponential, "extreme": extreme,
    "square_root": lambda value: math.nan if value < 0 else math.sqrt(value),
    "select": lambda choice, first, second: second if choice else first,
}


def compiled(block):
    """The Python function of a ParsedBlock, whose line numbers are those of Structured Text."""
    tree = ast.parse("\n".join(text for _, text in block.lines))
    for node in ast.walk(tree):
        if hasattr(node, "lineno"):
            node.lineno = node.end_lineno = block.lines[node.lineno - 1][0]
    scope = dict(RUN_TIME)
    exec(compile(tree, f"<{block.name}>", "exec"), scope)
    return scope["body"]


class Block:
    """A function block: its `variables` by their names in capitals, each with its section (such as
    "VAR_INPUT"), its type and its initial value."""

    def __init__(self, name, variables, initial, body):
        self.name, self.variables, self.initial, self.body = name, variables, initial, body

    def instance(self):
        return Instance(self)


class Instance:
    """An instance of a function block, with values of its own. instance[name] reads any variable
    but those of VAR_TEMP."""

    def __init__(self, block):
        self.block = block
        self.values = dict(block.initial)

    def __getitem__(self, name):
        return self.values[name.upper()]

    def call(self, **inputs):
        """Executes the block once. An input that is not given keeps its value."""
        for name, value in inputs.items():
            variable = self.block.variables.get(name.upper())
            if not variable or variable.section != "VAR_INPUT":
                raise TypeError(f"{self.block.name} has no input {name}")
            self.values[name.upper()] = input_value(name, variable.type, value)
        try:
            self.block.body(self.values)
        except ArithmeticError as error:
            line = error.__traceback__.tb_next.tb_lineno
            raise StructuredTextError(line, str(error)) from error


def input_value(name, type, value):
    takes = {"BOOL": bool, "DINT": int}.get(type, (int, float))
    if not isinstance(value, takes) or isinstance(value, bool) != (type == "BOOL"):
        raise TypeError(f"{name} is {type} and does not take {value!r}")
    return {"BOOL": bool, "DINT": dint, "REAL": to_binary32, "LREAL": float}[type](value)


def parse(text):
    """The function blocks of the text by their names in capitals."""
    return {block.name: Block(block.name, block.variables, block.initial, compiled(block))
            for block in Parser(text).blocks()}

"""The parser and type checker of the Structured Text subset: writes the Python text of each
function block, or raises StructuredTextError with the line number.

Imported by structured_text.py, whose docstring describes the subset. The Python text calls the
functions of RUN_TIME there.
"""

import ast
import collections
import ctypes
import fractions
import math
import re
import struct

from structured_text_tokens import (CONVERSION_NAME, LONGEST_NAME, RESERVED, StructuredTextError,
                                    tokens_of)

TYPES = {"BOOL": False, "DINT": 0, "REAL": 0.0, "LREAL": 0.0}  # with their initial values
ANY_REAL = "untyped real"
REALS = {"REAL", "LREAL", ANY_REAL}
NUMBERS = REALS | {"DINT"}
SECTIONS = {"VAR_INPUT", "VAR_OUTPUT", "VAR", "VAR_TEMP"}

Variable = collections.namedtuple("Variable", "section type value")
# A checked expression. python(type) writes its Python text; the type only counts for ANY_REAL.
Expression = collections.namedtuple("Expression", "type python")
# A checked function block: its variables by their names, the initial values of those that keep a
# value between calls, and the lines of its Python text, each after its line of Structured Text.
ParsedBlock = collections.namedtuple("ParsedBlock", "name variables initial lines")

# The Python text of operations and functions.
ROUNDED = {"DINT": "dint({})", "REAL": "binary32({}).value", "LREAL": "({})"}
CONVERSIONS = {
    "BOOL_TO_DINT": "int({})", "BOOL_TO_REAL": "float({})", "BOOL_TO_LREAL": "float({})",
    "DINT_TO_REAL": "binary32({}).value", "DINT_TO_LREAL": "float({})",
    "REAL_TO_LREAL": "{}", "LREAL_TO_REAL": "binary32({}).value",
    "REAL_TO_DINT": "dint_of(round, {})", "LREAL_TO_DINT": "dint_of(round, {})",
}
# Functions that return the type of their arguments: the types they take, how many arguments, the
# text. "..." stands for two arguments or more.
FUNCTIONS = {
    "ABS": (NUMBERS, 1, "abs({})"),
    "SQRT": (REALS, 1, "square_root({})"),
    "EXP": (REALS, 1, "exponential({})"),
    "MIN": (NUMBERS, None, "extreme(min, ...)"),
    "MAX": (NUMBERS, None, "extreme(max, ...)"),
    "LIMIT": (NUMBERS, 3, "extreme(min, extreme(max, {1}, {0}), {2})"),
}
# From the weakest to the strongest.
BINARY_OPERATORS = [{"OR": "|"}, {"XOR": "^"}, {"AND": "&"}, {"=": "==", "<>": "!="},
                    {"<": "<", ">": ">", "<=": "<=", ">=": ">="}, {"+": "+", "-": "-"},
                    {"*": "*", "/": "/"}]


def to_binary32(value):
    return ctypes.c_float(value).value


def real_value(text, type):
    """The value nearest to a decimal number. A binary64 that is rounded to odd before it is rounded
    to binary32 gives the same as one rounding."""
    value = float(text)
    if type == "REAL" and 0 < value < math.inf:
        error = fractions.Fraction(text) - fractions.Fraction(value)
        if error and struct.pack("<d", value)[0] % 2 == 0:
            value = math.nextafter(value, math.inf if error > 0 else 0.0)
        value = to_binary32(value)
    return value


class Parser:
    """Reads and checks one text. It writes the Python text of a block while it reads."""

    def __init__(self, text):
        self.tokens = tokens_of(text)
        self.position = 0

    @property
    def next(self):
        return self.tokens[self.position]

    def fail(self, message, token=None):
        raise StructuredTextError((token or self.next).line, message)

    def take(self, *texts):
        """Takes the next token, which must be one of the texts if any are given."""
        token = self.next
        if texts and token.text not in texts:
            self.fail(f"{' or '.join(texts)} expected, but found {token.text}")
        self.position += token.kind != "end"
        return token

    def found(self, *texts):
        """Takes the next token if it is one of the texts."""
        return self.take() if self.next.text in texts else None

    def new_name(self, taken):
        token = self.take()
        name = token.text
        if token.kind != "name":
            self.fail(f"a name expected, but found {name}", token)
        if name in RESERVED or CONVERSION_NAME.fullmatch(name):
            self.fail(f"{name} is reserved", token)
        if "__" in name or name.endswith("_"):
            self.fail(f"{name} has two underscores in a row or one at its end", token)
        if len(name) > LONGEST_NAME:
            self.fail(f"{name} has more than {LONGEST_NAME} characters", token)
        if name in taken:
            self.fail(f"{name} is declared twice", token)
        return name

    def blocks(self):
        """Yields each function block as a ParsedBlock."""
        names = set()
        while not names or self.next.kind != "end":
            block = self.block(names)
            names.add(block.name)
            yield block

    def block(self, names):
        line = self.take("FUNCTION_BLOCK").line
        name = self.new_name(names)
        self.variables = {}
        while self.next.text in SECTIONS:
            self.section(name)
        self.temporary = {name for name, one in self.variables.items() if one.section == "VAR_TEMP"}
        initial = {name: one.value for name, one in self.variables.items()}
        self.assigned = {name for name in self.temporary if initial[name] is not None}
        self.lines = [(line, "def body(values):")]
        self.lines += [(line, f"    {self.python_name(name)} = {initial[name]!r}")
                       for name in self.assigned]
        self.statements("    ", "END_FUNCTION_BLOCK")
        self.take()
        static = {name: initial[name] for name in initial if name not in self.temporary}
        return ParsedBlock(name, self.variables, static, self.lines)

    def section(self, block):
        section = self.take().text
        if section == "VAR" and self.found("CONSTANT"):
            section = "VAR CONSTANT"
        while not self.found("END_VAR"):
            name = self.new_name({block, *self.variables})
            self.take(":")
            type = self.take(*TYPES).text
            value = None if section == "VAR_TEMP" else TYPES[type]
            if self.found(":="):
                value = self.initial_value(type)
            elif section == "VAR CONSTANT":
                self.fail(f"the constant {name} has no value")
            self.take(";")
            self.variables[name] = Variable(section, type, value)

    def initial_value(self, type):
        minus = self.found("-")
        token = self.next
        if token.kind == "number":
            literal = self.number(minus)
        elif token.text in ("TRUE", "FALSE") and not minus:
            literal = self.primary()
        else:
            self.fail(f"a literal expected, but found {token.text}")
        return ast.literal_eval(self.of_type(literal, type, token))

    # Statements.

    def statements(self, indent, *ends):
        if self.next.text in ends:
            self.fail(f"no statement before {self.next.text}")
        while self.next.text not in ends:
            self.statement(indent)

    def statement(self, indent):
        token = self.take()
        if token.text == "IF":
            self.choice(indent, token)
        elif token.text == "RETURN":
            self.lines.append((token.line, f"{indent}return"))
            self.assigned = self.temporary  # no path goes on from here
        else:
            variable = self.variable(token)
            if variable.section in ("VAR_INPUT", "VAR CONSTANT"):
                self.fail(f"{token.text} of {variable.section} is assigned", token)
            self.take(":=")
            value = self.of_type(self.expression(), variable.type, token)
            self.lines.append((token.line, f"{indent}{self.python_name(token.text)} = {value}"))
            if variable.section == "VAR_TEMP":
                self.assigned = self.assigned | {token.text}
        self.take(";")

    def choice(self, indent, token):
        before, after = self.assigned, []
        while token.text != "END_IF":
            self.assigned = before
            if token.text == "ELSE":
                header, ends = "else", ["END_IF"]
                before = self.temporary  # there is no path around the branches
            else:
                condition = self.of_type(self.expression(), "BOOL", token)
                header = f"{'if' if token.text == 'IF' else 'elif'} {condition}"
                ends = ["ELSIF", "ELSE", "END_IF"]
                self.take("THEN")
            self.lines.append((token.line, f"{indent}{header}:"))
            self.statements(indent + "    ", *ends)
            after.append(self.assigned)
            token = self.take()
        self.assigned = before.intersection(*after)

    # Expressions.

    def variable(self, token):
        if token.text not in self.variables:
            unknown = token.kind == "name" and token.text not in RESERVED
            what = "is not declared" if unknown else "is not expected here"
            self.fail(f"{token.text} {what}", token)
        return self.variables[token.text]

    def python_name(self, name):
        return f"temporary_{name}" if name in self.temporary else f"values[{name!r}]"

    def of_type(self, expression, type, token):
        """The Python text of an expression that must have the type."""
        if expression.type != type and not (expression.type == ANY_REAL and type in REALS):
            self.fail(f"{type} needed, but this is {expression.type}", token)
        return expression.python(type)

    def common_type(self, operands, allowed, token):
        types = {operand.type for operand in operands}
        if types & {"REAL", "LREAL"}:
            types -= {ANY_REAL}
        if len(types) != 1 or not types <= allowed:
            self.fail(f"{token.text} does not take {' with '.join(sorted(types))}", token)
        return types.pop()

    def same_type(self, operands, allowed, token, pattern):
        """An expression that has the type of its operands."""
        type = self.common_type(operands, allowed, token)

        def python(wanted):
            actual = wanted if type == ANY_REAL else type
            text = pattern.format(*(operand.python(actual) for operand in operands))
            return ROUNDED.get(actual, "({})").format(text)
        return Expression(type, python)

    def expression(self, level=0):
        if level == len(BINARY_OPERATORS):
            return self.unary()
        left = self.expression(level + 1)
        while token := self.found(*BINARY_OPERATORS[level]):
            operands = [left, self.expression(level + 1)]
            left = self.binary(token, operands, f"{{}} {BINARY_OPERATORS[level][token.text]} {{}}")
        return left

    def binary(self, token, operands, pattern):
        if token.text in ("AND", "XOR", "OR"):
            return self.same_type(operands, {"BOOL"}, token, pattern)
        if token.text == "/":
            whole = self.common_type(operands, NUMBERS, token) == "DINT"
            pattern = "dint_quotient({}, {})" if whole else "real_quotient({}, {})"
        if token.text in ("+", "-", "*", "/"):
            return self.same_type(operands, NUMBERS, token, pattern)
        allowed = {"DINT", "REAL", "LREAL"} | ({"BOOL"} if token.text in ("=", "<>") else set())
        type = self.common_type(operands, allowed, token)
        text = pattern.format(*(operand.python(type) for operand in operands))
        return Expression("BOOL", lambda _: f"({text})")

    def unary(self):
        token = self.found("-", "NOT")
        if not token:
            return self.primary()
        if token.text == "NOT":
            return self.same_type([self.primary()], {"BOOL"}, token, "not {}")
        if self.next.kind == "number":
            return self.number(token)
        return self.same_type([self.primary()], NUMBERS, token, "-{}")

    def primary(self):
        token = self.next
        if token.kind == "number":
            return self.number(None)
        self.take()
        if token.text == "(":
            inside = self.expression()
            self.take(")")
            return inside
        if token.text in ("TRUE", "FALSE"):
            return Expression("BOOL", lambda _: token.text.capitalize())
        if self.next.text == "(":
            return self.call(token)
        variable = self.variable(token)
        if token.text in self.temporary - self.assigned:
            self.fail(f"{token.text} is not assigned on every path to here", token)
        return Expression(variable.type, lambda _: self.python_name(token.text))

    def number(self, minus):
        token = self.take()
        prefix, _, digits = token.text.rpartition("#")
        sign = -1 if bool(minus) != digits.startswith("-") else 1
        digits = digits.lstrip("+-")
        type = prefix or (ANY_REAL if "." in digits else "DINT")
        if type not in NUMBERS or (type == "DINT") == ("." in digits):
            self.fail(f"{token.text} is no literal of BOOL, DINT, REAL or LREAL", token)

        def python(wanted):
            actual = wanted if type == ANY_REAL else type
            value = sign * (int(digits) if actual == "DINT" else real_value(digits, actual))
            vanished = value == 0 and re.search("[1-9]", digits.partition("E")[0])
            beyond = math.isinf(value) or actual == "DINT" and not -2**31 <= value < 2**31
            if vanished or beyond:
                self.fail(f"{token.text} is out of the range of {actual}", token)
            return f"({value!r})"
        return Expression(type, python)

    def call(self, token):
        self.take("(")
        arguments = [self.expression()]
        while self.found(","):
            arguments.append(self.expression())
        self.take(")")
        name, count = token.text, len(arguments)
        if name in FUNCTIONS:
            allowed, needed, pattern = FUNCTIONS[name]
            pattern = pattern.replace("...", ", ".join(["{}"] * count))
        elif name in CONVERSIONS or name in ("TRUNC", "SEL"):
            needed = 3 if name == "SEL" else 1
        else:
            self.fail(f"{name} is no function of this subset", token)
        if count != needed and not (needed is None and count >= 2):
            self.fail(f"{name} does not take {count} arguments", token)
        if name in FUNCTIONS:
            return self.same_type(arguments, allowed, token, pattern)
        if name == "SEL":
            text = f"select({self.of_type(arguments[0], 'BOOL', token)}, {{}}, {{}})"
            return self.same_type(arguments[1:], NUMBERS | {"BOOL"}, token, text)
        if name == "TRUNC":
            type = self.common_type(arguments, {"REAL", "LREAL"}, token)
            text = f"dint_of(int, {arguments[0].python(type)})"
            return Expression("DINT", lambda _: text)
        source, target = name.split("_TO_")
        text = CONVERSIONS[name].format(self.of_type(arguments[0], source, token))
        return Expression(target, lambda _: text)

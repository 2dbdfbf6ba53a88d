"""Tests of the Structured Text interpreter: what it refuses, and what the accepted text computes.

usage: structured_text_test.py
"""

import math
import struct
import sys
import unittest

from structured_text import StructuredTextError, parse

DECLARATIONS = """FUNCTION_BLOCK Sample
VAR_INPUT A : BOOL; B : BOOL; I : DINT; X : REAL; L : LREAL; END_VAR
VAR_OUTPUT Yes : BOOL; Whole : DINT; Short : REAL; Long : LREAL; END_VAR
VAR Count : DINT := -1; END_VAR
VAR CONSTANT Third : REAL := 0.333333333; END_VAR
VAR_TEMP T1 : DINT; T2 : LREAL; END_VAR
"""  # six lines: the statements begin in line 7


def sample(statements):
    return parse(f"{DECLARATIONS}{statements}\nEND_FUNCTION_BLOCK")["SAMPLE"].instance()


def result(output, expression, **inputs):
    instance = sample(f"{output} := {expression};")
    instance.call(**inputs)
    return instance[output]


def binary32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


class StructuredTextTest(unittest.TestCase):
    def refused(self, statements, message, line=7):
        with self.assertRaisesRegex(StructuredTextError, f"^line {line}: .*(?:{message})"):
            sample(statements)

    def declaration_refused(self, declaration, message):
        with self.assertRaisesRegex(StructuredTextError, f"^line 2: .*{message}"):
            parse(f"FUNCTION_BLOCK F VAR X : DINT; END_VAR\nVAR {declaration} END_VAR\n"
                  "X := 1; END_FUNCTION_BLOCK")

    def test_precedence(self):
        self.assertEqual(result("Whole", "2 + 3 * 4 - 6 / 2 - 1"), 10)
        self.assertEqual(result("Whole", "(2 + 3) * -I", I=4), -20)
        self.assertEqual(result("Whole", "100 / 10 / 5"), 2)
        self.assertIs(result("Yes", "TRUE OR TRUE AND FALSE"), True)
        self.assertIs(result("Yes", "TRUE OR TRUE XOR TRUE"), True)
        self.assertIs(result("Yes", "TRUE XOR FALSE AND FALSE"), True)
        self.assertIs(result("Yes", "NOT A = B", A=False, B=True), True)
        self.assertIs(result("Yes", "NOT A OR B", A=True, B=True), True)
        self.assertIs(result("Yes", "A = 1 + 1 < 3", A=True), True)
        self.refused("Long := L * - - L;", "- is not expected")

    def test_types_are_not_converted(self):
        for statement in ("Short := L;", "Long := X;", "Long := X + L;", "Short := I;",
                          "Long := L * 2;", "Long := L + I;", "Short := LREAL#1.5;",
                          "Whole := 1.0;", "Yes := I;", "Whole := SEL(I, 1, 2);",
                          "Short := MIN(X, L);", "Short := REAL_TO_LREAL(X);",
                          "Short := LREAL_TO_REAL(X);", "Whole := TRUNC(I);", "Yes := A < B;",
                          "Yes := 1.0 < 2.0;", "Yes := NOT I;", "Whole := A AND B;",
                          "Long := SQRT(I);", "IF I THEN Whole := 1; END_IF;", "Short := REAL#1;",
                          "Whole := DINT#1.0;", "Short := -A;", "Yes := X = L;"):
            with self.subTest(statement):
                self.refused(statement, "needed|does not take|is no literal")

    def test_untyped_literal_takes_type_of_its_place(self):
        self.assertEqual(result("Short", "X + 0.1", X=0.0), binary32(0.1))
        self.assertEqual(result("Long", "L + 0.1", L=0.0), 0.1)
        self.assertEqual(result("Long", "MAX(0.1, 0.2) + LREAL#1.5E-3"), 0.2 + 0.0015)
        self.assertEqual(result("Short", "1.0 / 3.0"), binary32(1.0 / 3.0))
        self.assertEqual(result("Short", "-REAL#1.5"), -1.5)

    def test_real_rounds_after_each_operation(self):
        self.assertEqual(result("Short", "X + 1.0 - X", X=16777216.0), 0.0)
        self.assertEqual(result("Long", "L + 1.0 - L", L=16777216.0), 1.0)
        self.assertEqual(result("Short", "X * X", X=0.1), binary32(binary32(0.1) * binary32(0.1)))
        self.assertEqual(result("Short", "DINT_TO_REAL(I)", I=16777217), 16777216.0)
        self.assertEqual(result("Short", "LREAL_TO_REAL(L)", L=0.1), binary32(0.1))
        self.assertEqual(result("Short", "X * X", X=1e30), math.inf)
        # Just above the middle of two neighbours, which binary64 cannot tell from the middle.
        self.assertEqual(result("Short", "1.00000005960464477539062500001"), 1.0 + 2.0**-23)
        self.assertEqual(sample("Whole := 1;")["third"], binary32(0.333333333))

    def test_reals_follow_ieee(self):
        self.assertEqual(result("Long", "1.0 / L", L=-0.0), -math.inf)
        self.assertTrue(math.isnan(result("Long", "L / L", L=0.0)))
        self.assertTrue(math.isnan(result("Short", "SQRT(X)", X=-1.0)))
        self.assertEqual(result("Long", "EXP(L)", L=1000.0), math.inf)
        self.assertEqual([result("Yes", f"L {operator} L", L=math.nan)
                          for operator in ("=", "<", ">", "<=", ">=", "<>")], [False] * 5 + [True])

    def test_dint_raises_beyond_32_bits(self):
        self.assertEqual(result("Whole", "-2147483648"), -2**31)
        self.assertEqual(result("Whole", "I / 2", I=-7), -3)
        self.assertEqual(result("Whole", "TRUNC(L)", L=-2.7), -2)
        self.assertEqual([result("Whole", "REAL_TO_DINT(X)", X=value)
                          for value in (1.5, 2.5, -1.6)], [2, 2, -2])
        for expression in ("I + 1", "ABS(-I - 1)", "I * I", "I / (I - I)", "TRUNC(L / L)",
                           "TRUNC(2147483648.0 + L)", "LREAL_TO_DINT(1.0 / L)"):
            with self.subTest(expression):
                with self.assertRaisesRegex(StructuredTextError, "^line 7: "):
                    result("Whole", expression, I=2**31 - 1)
        self.refused("Whole := 2147483648;", "out of the range of DINT")
        self.refused("Short := 1.0E39;", "out of the range of REAL")
        self.refused("Short := 1.0E-60;", "out of the range of REAL")

    def test_functions(self):
        self.assertEqual([result("Whole", "LIMIT(-2, I, 3)", I=value) for value in (-5, 1, 5)],
                         [-2, 1, 3])
        self.assertEqual(result("Whole", "MAX(1, I, 2) - MIN(1, I, 2)", I=9), 8)
        self.assertEqual([result("Whole", "SEL(A, 1, 2)", A=value) for value in (False, True)],
                         [1, 2])
        self.assertEqual(result("Long", "SQRT(ABS(L))", L=-4.0), 2.0)
        self.assertEqual(result("Whole", "BOOL_TO_DINT(A)", A=True), 1)
        with self.assertRaisesRegex(StructuredTextError, "^line 7: NaN"):
            result("Long", "LIMIT(0.0, L, 1.0)", L=math.nan)
        self.refused("Long := SIN(L);", "no function")
        self.refused("Whole := MIN(I);", "does not take 1 arguments")
        self.refused("Whole := LIMIT(I, I);", "does not take 2 arguments")

    def test_both_sides_are_evaluated(self):
        for expression in ("FALSE AND 1 / I = 1", "TRUE OR 1 / I = 1",
                           "SEL(FALSE, TRUE, 1 / I = 1)"):
            with self.subTest(expression), self.assertRaises(StructuredTextError):
                result("Yes", expression, I=0)

    def test_if_takes_the_first_true_branch(self):
        instance = sample("IF I < 0 THEN Whole := 1; ELSIF I < 5 THEN Whole := 2;\n"
                          "ELSIF I < 9 THEN IF A THEN Whole := 3; END_IF; ELSE Whole := 4; END_IF;")
        results = []
        for value in (-1, 0, 6, 9):
            instance.call(I=value)
            results.append(instance["Whole"])
        self.assertEqual(results, [1, 2, 2, 4])

    def test_return_ends_the_call(self):
        instance = sample("Whole := 1; IF A THEN RETURN; END_IF; Whole := 2;")
        instance.call(A=True)
        self.assertEqual(instance["Whole"], 1)
        instance.call(A=False)
        self.assertEqual(instance["Whole"], 2)

    def test_temporary_is_assigned_before_use(self):
        use = "\nWhole := T1;"
        for statements in ("T2 := 1.0;", "IF A THEN T1 := 1; END_IF;",
                           "IF A THEN T1 := 1; ELSIF B THEN T1 := 2; END_IF;",
                           "IF A THEN T1 := 1; ELSE T2 := 2.0; END_IF;"):
            with self.subTest(statements):
                self.refused(statements + use, "T1 is not assigned", line=8)
        self.refused("T1 := T1 + 1;", "T1 is not assigned")
        self.refused("IF A THEN T1 := 1; ELSE Whole := T1; END_IF;", "T1 is not assigned")
        for statements in ("IF A THEN T1 := 1; ELSE T1 := 2; END_IF;",
                           "IF A THEN RETURN; ELSE T1 := 2; END_IF;",
                           "IF A THEN T1 := 1; ELSIF B THEN RETURN; ELSE T1 := 3; END_IF;"):
            with self.subTest(statements):
                sample(statements + use)

    def test_static_variables_keep_their_values(self):
        block = parse(DECLARATIONS + "count := COUNT + I; END_FUNCTION_BLOCK")["SAMPLE"]
        first, second = block.instance(), block.instance()
        first.call(I=3)
        first.call()
        self.assertEqual((first["Count"], second["Count"]), (5, -1))
        with self.assertRaises(KeyError):
            first["T1"]

    def test_names_are_checked(self):
        for name in ("DT", "limit", "Step", "END_IF", "INT_TO_REAL", "REAL_TRUNC_DINT", "TO_DINT"):
            with self.subTest(name):
                self.declaration_refused(f"{name} : REAL;", "is reserved")
        self.declaration_refused("a__b : REAL;", "underscores")
        self.declaration_refused("a_ : REAL;", "underscores")
        self.declaration_refused(f"{'a' * 65} : REAL;", "more than 64")
        self.declaration_refused("x : REAL;", "declared twice")
        self.declaration_refused("f : REAL;", "declared twice")
        self.declaration_refused("y : INT;", "expected")
        self.declaration_refused("y : DINT := X;", "literal expected")
        self.declaration_refused("CONSTANT y : DINT;", "has no value")
        self.declaration_refused("y : LREAL := REAL#1.0;", "LREAL needed")
        self.refused("Whole := Unknown;", "UNKNOWN is not declared")
        parse(f"FUNCTION_BLOCK F VAR {'a' * 64} : REAL; Rate_To_Real : REAL := -1.5; END_VAR "
              "RETURN; END_FUNCTION_BLOCK")

    def test_inputs_and_constants_are_not_assigned(self):
        self.refused("I := 1;", "I of VAR_INPUT is assigned")
        self.refused("Third := 1.0;", "THIRD of VAR CONSTANT is assigned")

    def test_text_outside_the_subset(self):
        for statement in ("Whole := 1", "IF A THEN END_IF;", "WHILE A DO Whole := 1; END_WHILE;",
                          "Whole := 16#FF;", "Long := 1E3;", "Long := L ** L;", ";",
                          "Yes := A & B;", "(* (* *) *) Whole := 1;", "Whole = 1;"):
            with self.subTest(statement):
                self.refused(statement, "", line="[78]")
        for text in ("", DECLARATIONS + "Whole := (1", DECLARATIONS + "(* Whole := 1;"):
            with self.subTest(text), self.assertRaises(StructuredTextError):
                parse(text)
        sample("Whole (* a\ncomment *) := 1; // END_FUNCTION_BLOCK")
        self.refused("(* a\n\ncomment *)\n\n  Whole := Unknown;", "UNKNOWN", line=11)

    def test_inputs_of_a_call_are_checked(self):
        for inputs in ({"Z": 1}, {"Whole": 1}, {"A": 1}, {"I": 1.0}, {"X": True}):
            with self.subTest(inputs), self.assertRaises(TypeError):
                sample("Whole := 1;").call(**inputs)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

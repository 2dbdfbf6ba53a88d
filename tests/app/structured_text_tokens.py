"""The lexer of the Structured Text subset: splits a text into tokens, and lists the words that no
declared name may be.

Imported by structured_text_syntax.py.
"""

import collections
import re

LONGEST_NAME = 64

# Words that no name may be: keywords, then types, standard functions and function blocks, and
# operators of Instruction List, which some compilers reserve in Structured Text too.
RESERVED = set("""
    ABSTRACT ACTION AND ARRAY AT BY CASE CLASS CONFIGURATION CONSTANT CONTINUE DO ELSE ELSIF EN ENO
    END_ACTION END_CASE END_CLASS END_CONFIGURATION END_FOR END_FUNCTION END_FUNCTION_BLOCK END_IF
    END_INTERFACE END_METHOD END_NAMESPACE END_PROGRAM END_REPEAT END_RESOURCE END_STEP END_STRUCT
    END_TRANSITION END_TYPE END_VAR END_WHILE EXIT EXTENDS FALSE FINAL FOR FROM FUNCTION
    FUNCTION_BLOCK F_EDGE IF IMPLEMENTS INITIAL_STEP INTERFACE INTERNAL INTERVAL METHOD MOD
    NAMESPACE NON_RETAIN NOT NULL OF ON OR OVERLAP OVERRIDE PRIORITY PRIVATE PROGRAM PROTECTED
    PUBLIC READ_ONLY READ_WRITE REF REF_TO REPEAT RESOURCE RETAIN RETURN R_EDGE SINGLE STEP STRUCT
    SUPER TASK THEN THIS TO TRANSITION TRUE TYPE UNTIL USING VAR VAR_ACCESS VAR_CONFIG VAR_EXTERNAL
    VAR_GLOBAL VAR_INPUT VAR_IN_OUT VAR_OUTPUT VAR_TEMP WHILE WITH XOR

    BOOL BYTE CHAR DATE DATE_AND_TIME DINT DT DWORD INT LDATE LDATE_AND_TIME LDT LINT LREAL LTIME
    LTIME_OF_DAY LTOD LWORD REAL SINT STRING TIME TIME_OF_DAY TOD UDINT UINT ULINT USINT WCHAR WORD
    WSTRING

    ABS ACOS ADD ADD_DT_TIME ADD_TIME ADD_TOD_TIME ASIN ATAN ATAN2 CEIL CONCAT CONCAT_DATE
    CONCAT_DATE_TOD CONCAT_DT CONCAT_TOD COS CTD CTU CTUD DAY_OF_WEEK DELETE DIV DIVTIME EQ EXP EXPT
    FIND FLOOR F_TRIG GE GT INSERT IS_VALID IS_VALID_BCD LE LEFT LEN LIMIT LN LOG LOWER_BOUND LT MAX
    MID MIN MOVE MUL MULTIME MUX NE REPLACE RIGHT ROL ROR ROUND RS R_TRIG SEL SEMA SHL SHR SIN
    SPLIT_DATE SPLIT_DT SPLIT_TOD SQRT SR SUB SUB_DATE_DATE SUB_DT_DT SUB_DT_TIME SUB_TIME
    SUB_TOD_TIME SUB_TOD_TOD TAN TO_BIG_ENDIAN TO_LITTLE_ENDIAN TOF TON TP TRUNC UPPER_BOUND

    ANDN CAL CALC CALCN JMP JMPC JMPCN LD LDN ORN R RET RETC RETCN S ST STN XORN
    """.split())
ANY_TYPE = ("(?:BOOL|BYTE|D?WORD|LWORD|U?[SDL]?INT|L?REAL|L?TIME|L?DATE|L?DT|L?TOD|TIME_OF_DAY"
            "|DATE_AND_TIME|W?STRING|W?CHAR)")
CONVERSION_NAME = re.compile(f"(?:{ANY_TYPE}_)?(?:BCD_)?(?:TO|TRUNC)_(?:BCD_)?{ANY_TYPE}")

TOKEN = re.compile(r"""
    (?P<blank> \s+ )
  | (?P<comment> \(\* .*? \*\) | //[^\n]* )
  | (?P<number> (?:[A-Z]+\#[-+]?)? [0-9]+ (?:\.[0-9]+ (?:E[-+]?[0-9]+)? )? (?![\w.\#]) )
  | (?P<name> [A-Z_]\w* )
  | (?P<symbol> := | <= | >= | <> | [-+*/<>=():;,] )""", re.X | re.S | re.A | re.I)

Token = collections.namedtuple("Token", "kind text line")


class StructuredTextError(ValueError):
    def __init__(self, line, message):
        super().__init__(f"line {line}: {message}")
        self.line = line


def tokens_of(text):
    tokens, begin, line = [], 0, 1
    while begin < len(text):
        match = TOKEN.match(text, begin)
        if not match:
            raise StructuredTextError(line, f"unreadable: {text[begin:begin + 20].split()[0]}")
        if match.lastgroup in ("number", "name", "symbol"):
            tokens.append(Token(match.lastgroup, match.group().upper(), line))
        elif match.group().startswith("(*") and "(*" in match.group()[2:]:
            raise StructuredTextError(line, "a comment is inside a comment")
        line += match.group().count("\n")
        begin = match.end()
    return tokens + [Token("end", "the end of the text", line)]

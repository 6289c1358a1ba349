"""Rules E1 about the text itself: characters, names, strings, numbers, and what is in the file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Violation


@dataclass(frozen=True)
class LimitExceeded(Violation):
    """Something is longer, larger or deeper than a controller can hold.

    Names have up to 32 characters, strings up to 80, numbers fit a dnum. Blocks, brackets and
    chains of operators may nest up to 200 deep in all, which is a limit of this program; what goes
    deeper is not read.

    ## Example

        MODULE example
          VAR num a_name_with_far_too_many_letters_in_it;
        ENDMODULE

    ## Fix

        MODULE example
          VAR num a_name_with_enough_letters;
        ENDMODULE
    """

    code: ClassVar[str] = "E108"
    name: ClassVar[str] = "limit-exceeded"
    template: ClassVar[str] = "{what} {extent}; the limit is {limit}"

    what: str
    extent: str
    limit: str


@dataclass(frozen=True)
class UnterminatedString(Violation):
    r"""A string is not closed on its line.

    Strings cannot go on in the next line; put two together with `+`. A backslash before a quote
    does not make it part of the string; two quotes do.

    ## Example

        MODULE example
          PROC main()
            TPWrite "part picked;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            TPWrite "part picked";
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E109"
    name: ClassVar[str] = "unterminated-string"
    template: ClassVar[str] = 'the closing `"` of the string is missing'


@dataclass(frozen=True)
class TextOutsideModule(Violation):
    """Text stands before MODULE or after ENDMODULE.

    It is not read, and a controller refuses the file.

    ## Example

        MODULE example
        ENDMODULE
        Remember to teach the home position!

    ## Fix

        MODULE example
          ! Remember to teach the home position!
        ENDMODULE
    """

    code: ClassVar[str] = "E110"
    name: ClassVar[str] = "text-outside-module"
    template: ClassVar[str] = "text outside MODULE ... ENDMODULE"

    @property
    def help(self) -> str:
        """How to keep the text."""
        return "take it out, or make it a comment with `!`"


@dataclass(frozen=True)
class NoModule(Violation):
    """The file holds no module: nowhere does a line begin with MODULE and a name.

    Either it is no RAPID file, or its first line is lost. Nothing of it is read.

    ## Example

        PROC main()
          Stop;
        ENDPROC

    ## Fix

        MODULE example
          PROC main()
            Stop;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E111"
    name: ClassVar[str] = "no-module"
    template: ClassVar[str] = "no line begins with MODULE and a name, so this is no RAPID module"


@dataclass(frozen=True)
class BadEscape(Violation):
    r"""A backslash in a string begins none of the escapes.

    In a string a backslash is written `\\`, and any character by its code in two hexadecimal
    digits, such as `\0D`. A single backslash is refused by the controller.

    ## Example

        MODULE example
          PROC main()
            TPWrite "C:\temp";
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            TPWrite "C:\\temp";
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E116"
    name: ClassVar[str] = "bad-escape"
    template: ClassVar[str] = (
        "a `\\` in a string must be doubled or followed by two hexadecimal digits"
    )


@dataclass(frozen=True)
class UnknownCharacter(Violation):
    """A character has no meaning in RAPID outside strings and comments.

    Typographic quotes from a word processor are the usual case. Names begin with a letter.

    ## Example

        MODULE example
          PROC main()
            SetDO doGrip,1;#
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            SetDO doGrip,1;!
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E118"
    name: ClassVar[str] = "unknown-character"
    template: ClassVar[str] = "`{characters}` has no meaning in RAPID"

    characters: str


@dataclass(frozen=True)
class ReservedName(Violation):
    """A reserved word is used as a name.

    ## Example

        MODULE example
          VAR num step;
        ENDMODULE

    ## Fix

        MODULE example
          VAR num stepWidth;
        ENDMODULE
    """

    code: ClassVar[str] = "E121"
    name: ClassVar[str] = "reserved-name"
    template: ClassVar[str] = "`{word}` is a reserved word and cannot be a name"
    cf: ClassVar[str | None] = "ABB 40147"

    word: str


@dataclass(frozen=True)
class NameWithParentheses(Violation):
    """A name has something in parentheses behind it.

    Names consist of letters, digits and underscores. The part in parentheses is not read.

    ## Example

        MODULE example
          PERS num grip(open):=1;
        ENDMODULE

    ## Fix

        MODULE example
          PERS num grip_open:=1;
        ENDMODULE
    """

    code: ClassVar[str] = "E122"
    name: ClassVar[str] = "name-with-parentheses"
    template: ClassVar[str] = "`{written}` is no name: only letters, digits and `_` make one"

    written: str

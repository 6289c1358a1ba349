"""Titles, in our own words, of the controller's events that findings and errors cite.

Source of the numbers: the names of the kernel's events and the event log messages of RobotWare.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

_LOADING = """\
40001 an optional argument is given twice
40002 arguments that exclude each other are given
40003 a required argument is expected
40004 the argument is no reference to data
40005 the argument cannot be written
40006 an optional argument lacks its value
40007 an optional argument is in the wrong place
40008 an optional parameter is named for a required argument
40009 the conditional argument names a required parameter
40010 a required parameter is named for an optional argument
40011 a required argument is in the wrong place
40012 a switch has a value
40013 too few arguments
40014 too many arguments
40015 the dimension of an array is not positive
40016 an array has too many dimensions
40017 the data are no array
40018 the data are no record
40020 the expression is not constant
40021 RETURN of a function lacks its value
40022 operands that `*` does not accept
40023 GOTO leads into a block
40024 the left operand of `+` or `-` has a wrong type
40025 the operand of a sign, or of `+`, has a wrong type
40026 the right operand of `+` or `-` has a wrong type
40027 the left operand of `/`, DIV or MOD has a wrong type
40028 the right operand of `/`, DIV or MOD has a wrong type
40029 the left operand of `<` or `>` has a wrong type
40030 the right operand of `<` or `>` has a wrong type
40031 the left operand of `*` has a wrong type
40032 the right operand of `*` has a wrong type
40033 the operand of NOT has a wrong type
40034 the left operand of AND, OR or XOR has a wrong type
40035 the right operand of AND, OR or XOR has a wrong type
40036 the number of indices is wrong
40037 LOCAL before a constant of a routine
40038 LOCAL before a variable of a routine
40039 the name of a constant is taken in its routine or module
40040 the name of a global constant is taken
40041 the name of a global persistent is taken
40042 the name of a global routine is taken
40043 the name of a global variable is taken
40044 the name of a label is taken
40045 the name of a module is taken
40046 the name of a parameter is taken
40047 the name of a persistent is taken in its module
40048 the name of a routine is taken in its module
40049 the name of a variable is taken in its routine or module
40050 the operands of `+` or `-` have different types
40051 compared values have different types
40052 RETURN with a value outside a function
40054 the sizes of arrays differ
40055 data of a type without values are assigned
40056 the left side of a comparison has no value
40057 the right side of a comparison has no value
40058 TEST of something without a value
40059 a placeholder where a value is needed
40060 a placeholder where the dimension of data is needed
40061 a placeholder where the dimension of a parameter is needed
40062 a placeholder where the name of a parameter is needed
40063 a placeholder where the value of a persistent is needed
40064 a placeholder where a parameter is needed
40065 a placeholder where a type is needed
40066 a placeholder where the value of a variable is needed
40067 an aggregate has too few components
40068 an aggregate has too many components
40069 the reference to data is ambiguous
40070 the reference to a function is ambiguous
40071 the reference to a label is ambiguous
40072 the reference to a procedure is ambiguous
40073 the reference to a trap is ambiguous
40074 the name does not refer to data
40075 the name does not refer to a function
40076 the name does not refer to a label
40077 the name in a conditional argument is no optional parameter
40078 the name does not refer to an optional parameter
40079 the name does not refer to a procedure
40080 the name does not refer to a required parameter
40081 the name does not refer to a trap
40082 the name does not refer to a type
40083 the type has no values
40086 the label is unknown
40087 the optional parameter is unknown
40089 the component of a record is unknown
40090 the required parameter is unknown
40092 the type is unknown
40093 the target of an assignment is read-only
40094 a persistent is declared in a routine
40095 RAISE without a number outside an ERROR clause
40096 RETRY outside an ERROR clause
40097 TRYNEXT outside an ERROR clause
40098 a switch that is not passed by value
40099 a switch with dimensions
40100 a switch that is not optional
40101 the type does not match
40102 the type of an aggregate does not match
40103 a persistent that tasks share has different types
40104 the dimension of an array depends on itself
40105 the type of a constant depends on itself
40106 the value of a constant depends on itself
40107 the type of a variable depends on itself
40108 the type of an aggregate is unknown
40109 the type of a component depends on itself
40110 the name of a record is taken in its module
40111 the name of a global record is taken
40112 the name of an alias is taken in its module
40113 the name of a global alias is taken
40114 an alias of an alias
40115 the definition of an alias depends on itself
40116 the name of a component is taken
40117 a placeholder where a component is needed
40119 a component of a type that stands for a signal
40120 the reference to data of a task is not allowed
40121 an array of a type that stands for a signal
40122 the name in a call does not refer to a procedure, found when linking
40123 the argument is no persistent, found when linking
40124 the argument is no variable or persistent, found when linking
40125 CONNECT names no variable, found when linking
40126 an integer is too large, found when linking
40127 a number is no integer, found when linking
40128 unknown data, found when linking
40129 an unknown function, found when linking
40130 an unknown procedure, found when linking
40131 an unknown trap, found when linking
40135 something else is expected here
40136 this is not expected here
40137 something else is expected than what stands here
40140 a number is out of range
40141 a string is too long
40144 an integer is out of range
40147 a reserved word is used as a name
40148 a name is too long
40152 TASK before data of a routine
"""
_RUNNING = """\
40155 the argument is no persistent
40156 the argument is no variable or persistent
40157 CONNECT names no variable
40158 an integer is too large
40159 a number is no integer
40161 an option is missing
40165 unknown data
40166 an unknown function
40168 an unknown procedure
40170 an unknown trap
40171 an unknown symbol
40172 an unknown module
40173 the name does not refer to a module
40174 the reference to a module is ambiguous
40175 the reference to a procedure is ambiguous
40191 the interrupt variable is connected already
40192 arguments that exclude each other are present
40193 a late-bound call cannot be made
40194 division by zero
40195 RETRY was executed more often than allowed
40196 a placeholder is executed
40197 a function ends without RETURN
40198 an orientation is no unit quaternion
40199 RAISE with a number out of range
40200 no interrupt number is free
40202 the sizes of arrays differ
40203 an absent optional parameter is used
40204 an index is outside its array
40205 a string becomes too long
40206 the interrupt queue is full
40207 an error is raised on that cannot be
40208 the queue of error events is full
40209 the context of an error is gone
40210 interrupts were removed from the queue
40221 execution is aborted
40222 the execution stack overflows
40223 a fatal error
40224 a number that is none
40225 the program cannot be restarted
40226 the name of a procedure is no identifier
40227 the run-time stack overflows
40228 an error that no clause handles
40229 an error raised by RAISE that no clause handles
40230 an unknown error that no clause handles
40241 an array has no such dimension
40242 the data are no array
40243 the interrupt number is unknown
40244 the data have no value
40245 arguments do not match the parameters of a late-bound procedure
40246 a safe interrupt cannot be changed
40501 a wait ended by its time limit
40512 a target lacks the value of an active external axis
41822 no data come from the device of a sensor
41826 an EGM instruction is of another mode than its setup
"""
_MOVING = """\
50024 a corner is executed as a stop: the next move is not known in time
50026 the arm comes close to a singularity
50027 a joint is out of its range
50050 a position is out of reach
50063 the points of a circle are too close or in line
50065 the motion is not possible with this arm
50076 an orientation is no unit quaternion
50080 the position cannot be reached in its configuration
50143 axes are too far from the configuration of the target
50436 a line or arc cannot be made in the configurations of its ends
"""

EVENT_TITLES: Final[Mapping[int, str]] = MappingProxyType(
    {
        int(number): title
        for line in (_LOADING + _RUNNING + _MOVING).splitlines()
        for number, _, title in (line.partition(" "),)
    }
)
"""Titles by number."""

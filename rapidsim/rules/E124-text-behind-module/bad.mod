MODULE example
ENDMODULE
WaitTime 1; ! found
! ---
MODULE example
ENDMODULE
Remember to teach the home position! ! found

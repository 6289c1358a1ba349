Remember to teach the home position! ! found
MODULE example
ENDMODULE
! ---
MODULE example
ENDMODULE
PROC lost() ! found
ENDPROC

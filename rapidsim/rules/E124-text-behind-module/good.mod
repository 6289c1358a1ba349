MODULE example
ENDMODULE
! WaitTime 1;

MODULE double_that_is_no_number
  ! The result is a dnum that is not a number: check takes the argument for unknown, the run stops with ERR_OVERFLOW.
  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;
    TryInt (1E38*1E38*1E38*1E38*1E38*1E38*1E38*1E38*1E38)-(1E38*1E38*1E38*1E38*1E38*1E38*1E38*1E38*1E38);
  ENDPROC
ENDMODULE

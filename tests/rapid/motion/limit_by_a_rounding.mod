! Field practice, axis limits: what exceeds a limit by 0.0 degrees does not exceed it.
MODULE limit_by_a_rounding
  PROC main()
    MoveAbsJ [[0,0,55.04,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
    ! One tenth is told as such.
    MoveAbsJ [[0,0,55.07,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;  ! stops: `[[...]]` exceeds the axis limits of ABB IRB 1600-6/1.2: axis 3 at 55.1 deg, 0.1 deg past its limit
  ENDPROC
ENDMODULE

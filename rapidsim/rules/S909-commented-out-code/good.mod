MODULE example
  PROC main()
    ! The glue needs a second;
    WaitTime 1;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  ! Note: wait for the glue;
  ! The next target is p10, reached with MoveL
  ! if nothing is there
  !****************;
  PROC main()
    WaitTime 1; ! seconds
  ENDPROC
ENDMODULE

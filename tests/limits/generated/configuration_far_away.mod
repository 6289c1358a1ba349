MODULE farConfiguration
  ! Confdata that no arm comes near, and some that are no numbers: the move is judged, not the run ended.
  CONST robtarget far:=[[735,-80,601],[0,0.7071068,0.7071068,0],[1E38,-1E38,1E38,1E38],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    VAR robtarget none:=[[735,-80,601],[0,0.7071068,0.7071068,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR num much:=1E38;
    none.robconf.cf1:=much*much-much*much;
    MoveJ none,v1000,fine,tool0;
    MoveJ far,v1000,fine,tool0;
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE

MODULE example
  VAR num count;
  PROC main()
    count_part 1;
  ENDPROC
  PROC count_part(num n)
    IDisable; ! found
    IF n=0 RETURN;
    count:=count+n;
    IEnable;
  ENDPROC
ENDMODULE
! ---
MODULE bad
  VAR num count;
  PROC main()
    IDisable;                         ! found
    count:=count+1;
    IF count>3 THEN
      IEnable;
    ENDIF
  ENDPROC
ENDMODULE
! ---
MODULE nobody_lets_go
  VAR num count;
  PROC main()
    IDisable;                         ! found
    count:=count+1;
  ENDPROC
ENDMODULE
! ---
MODULE jumps_past
  VAR num count;
  PROC main()
    IDisable;                         ! found
    IF count>3 GOTO over;
    IEnable;
  over:
    count:=count+1;
  ENDPROC
ENDMODULE

! Field practice, RobotWare 6: what came later is refused, each at its place.
MODULE refused_by_six
  PROC main()
    VAR num n;
    FOR i FROM 1 TO 2 DO
      IF i=1 CONTINUE;                      ! error: N219
      n:=Max(i,2);                          ! error: N219
    ENDFOR
    UIMsgBox "?"\Icon:=iconQuestion;        ! error: N219
  ENDPROC
ENDMODULE

! RAPID Overview, CONTINUE: the next turn of the loop around it begins at once (RobotWare 7).
MODULE newer_continue
  PROC main()
    VAR num k:=0;
    FOR i FROM 1 TO 4 DO
      IF i=2 CONTINUE;
      TPWrite ValToStr(i);                  ! -> 1 ! -> 3 ! -> 4
    ENDFOR
    WHILE k<5 DO
      k:=k+1;
      TEST k
      CASE 1,3:
        CONTINUE;
      ENDTEST
      IF k=4 THEN
        CONTINUE;
      ENDIF
      TPWrite ValToStr(k);                  ! -> 2 ! -> 5
    ENDWHILE
  ENDPROC
ENDMODULE

! Field practice, RobotWare 7: the station says that its controller has it.
MODULE known_in_seven
  PROC main()
    FOR i FROM 1 TO 2 DO
      IF i=1 CONTINUE;
      TPWrite ValToStr(Max(i,1));           ! -> 2
      TPWrite ValToStr(Min(i,1));           ! -> 1
    ENDFOR
  ENDPROC
ENDMODULE

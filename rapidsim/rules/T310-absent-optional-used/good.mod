MODULE example
  PROC main()
    wait_a_little;
  ENDPROC
  PROC wait_a_little(\num seconds)
    IF Present(seconds) THEN
      WaitTime seconds;
    ENDIF
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  PROC main()
    wait_for_part\seconds:=3;
    forward\seconds:=2\fast;
  ENDPROC
  PROC wait_for_part(\num seconds|num minutes)
    IF Present(minutes) THEN
      WaitTime 60*minutes;
    ELSE
      WaitTime seconds;
    ENDIF
  ENDPROC
  PROC forward(\num seconds\switch fast)
    wait_for_part\seconds?seconds;
    IF Present(fast) WaitTime 0.1;
  ENDPROC
ENDMODULE

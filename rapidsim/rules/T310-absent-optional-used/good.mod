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
! ---
MODULE callers_know
  VAR bool far;
  PROC main()
    check_axis\with_track\limit:=3;
    slow_down\percent:=50;
    perhaps\speed:=3;
  ENDPROC
  PROC check_axis(\switch with_track\num limit)
    IF Present(with_track) far:=reg1>limit;
  ENDPROC
  PROC perhaps(\num speed)
    IF Present(speed) THEN
      slow_down\percent?speed;
    ENDIF
  ENDPROC
  PROC slow_down(\num percent)
    VelSet percent,500;
    WaitTime 1;
    VelSet 100,5000;
  ENDPROC
ENDMODULE

! RAPID Functions, Max: the larger of two numbers, and Min the smaller (RobotWare 7).
MODULE max_and_min
  PROC main()
    TPWrite ValToStr(Max(2,-3))+" "+ValToStr(Min(2,-3)); ! -> 2 -3
    TPWrite ValToStr(Max(0.1,0.1)=0.1);     ! -> TRUE
  ENDPROC
ENDMODULE

MODULE job
  PROC main()
    VAR pos centre;
    VAR num radius;
    TPWrite doLamp;
    FitCircle doPoints,centre,radius,centre;
    Reset lamp;
    TPWrite lamp;
  ENDPROC
ENDMODULE

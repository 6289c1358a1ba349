MODULE job
  VAR pos points{4}:=[[0,0,0],[1,0,0],[2,0,0],[3E38,3E38,3E38]];
  VAR robtarget targets{3};
  VAR pos centre;
  VAR pos normal;
  VAR num radius;
  VAR num most;
  VAR num mean;
  VAR pose frame;
  PROC main()
    FitCircle points\NumPoints:=0,centre,radius,normal;
    FitCircle points\NumPoints:=-1,centre,radius,normal;
    FitCircle points\NumPoints:=3,centre,radius,normal;
    FitCircle points\NumPoints:=9,centre,radius,normal;
    FitCircle points,centre,radius,normal;
    FitSphere points,centre,radius;
    frame:=CalcRotAxFrameZ(targets,3,targets{1},most,mean);
    frame:=DefAccFrame(targets,targets,-3,most,mean);
    frame:=DefAccFrame(targets,targets,3,most,mean);
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE

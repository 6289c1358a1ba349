! RAPID Instructions, FitCircle and FitSphere: centre and radius, and what is wrong with the points.
MODULE circles_and_spheres
  VAR pos points{5}:=[[100,0,50],[-100,0,50],[0,100,50],[0,-100,50],[0,0,150]];
  VAR pos centre;
  VAR pos normal;
  VAR num radius;
  VAR num worst;
  VAR pos many{101};

  PROC main()
    FitCircle points\NumPoints:=4,centre,radius,normal\MaxErr:=worst;
    TPWrite NumToStr(radius,3)+" "\Num:=Round(centre.z);           ! -> 100.000 50
    TPWrite ValToStr(Abs(normal.z))+ValToStr(worst<0.001);         ! -> 1TRUE
    FitSphere points,centre,radius\RMS:=worst;
    TPWrite NumToStr(radius,3)+" "\Num:=Round(centre.z);           ! -> 100.000 50
    TPWrite ValToStr(worst<0.001);                                 ! -> TRUE
    FitSphere points\NumPoints:=3,centre,radius;
    FitCircle points\NumPoints:=2,centre,radius,normal;
    FitCircle many,centre,radius,normal;
    points{3}:=[50,0,50];
    FitCircle points\NumPoints:=3,centre,radius,normal;
  ERROR
    TPWrite why();    ! -> too few ! -> too few ! -> too many ! -> in line
    TRYNEXT;
  ENDPROC

  FUNC string why()
    IF ERRNO=ERR_FIT_TOO_FEW_POINTS RETURN "too few";
    IF ERRNO=ERR_FIT_TOO_MANY_POINTS RETURN "too many";
    IF ERRNO=ERR_FIT_POINTS_IN_LINE RETURN "in line";
    RETURN "another";
  ENDFUNC
ENDMODULE

! RAPID Functions, DefFrame: frames from points, vectors, mirrored positions.
MODULE frames_of_points
  CONST robtarget p1:=[[100,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[100,50,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p3:=[[50,20,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR pose f;
    VAR robtarget m;
    f:=DefFrame(p1,p2,p3);
    TPWrite ValToStr(f.trans)+ValToStr(Round(EulerZYX(\Z,f.rot))); ! -> [100,0,0]90
    f:=DefFrame(p1,p2,p3\Origin:=2);
    TPWrite ValToStr(f.trans);              ! -> [100,50,0]
    f:=DefFrame(p1,p2,p3\Origin:=3);
    TPWrite ValToStr(f.trans);              ! -> [100,20,0]
    TPWrite ValToStr(CrossProd([1,0,0],[0,1,0])); ! -> [0,0,1]
    TPWrite ValToStr(DotProd([1,1,1],[1,2,3])); ! -> 6
    TPWrite ValToStr(VectMagn([3,4,0]));    ! -> 5
    TPWrite ValToStr(PoseVect([[1,2,3],[1,0,0,0]],[1,1,1])); ! -> [2,3,4]
    f:=PoseMult([[10,0,0],[0.707106781,0,0,0.707106781]],[[5,0,0],[1,0,0,0]]);
    TPWrite ValToStr(Round(f.trans.x))+","+ValToStr(Round(f.trans.y)); ! -> 10,5
    f:=PoseInv(f);
    TPWrite ValToStr(Round(f.trans.x))+","+ValToStr(Round(f.trans.y)); ! -> -5,10
    m:=MirPos(p3,wobj0);
    TPWrite ValToStr(m.trans);              ! -> [50,20,0]
    TPWrite ValToStr(EulerZYX(\X,OrientZYX(10,20,30))); ! -> 30
    f:=DefFrame(p1,p1,p3);
    TPWrite "end";                          ! -> end
  ERROR
    IF ERRNO=ERR_FRAME TPWrite "frame";     ! -> frame
    TRYNEXT;
  ENDPROC
ENDMODULE

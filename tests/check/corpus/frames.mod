MODULE frames
  PERS wobjdata wA:=[FALSE,TRUE,"",[[500,0,0],[1,0,0,0]],[[0,0,10],[0.9659258,0,0,0.2588190]]];
  VAR pose shift;
  VAR robtarget p:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    VAR num rx;
    shift.trans:=[10,20,30];
    shift.rot:=OrientZYX(30,0,180);
    p:=CRobT(\Tool:=tool0\WObj:=wA);
    p.trans:=PoseVect(PoseInv(shift),p.trans);
    p.rot:=NOrient(p.rot*shift.rot);
    rx:=EulerZYX(\X,p.rot);
    PDispSet PoseMult(shift,PoseInv(shift));
    MoveJ p,v100,fine,tool0\WObj:=wA;
    PDispOff;
    wA.oframe:=DefFrame(p,Offs(p,100,0,0),Offs(p,0,100,0));
    IF Distance(p.trans,[0,0,0])>500 OR Abs(rx)>90 TPWrite "far";
  ENDPROC
ENDMODULE

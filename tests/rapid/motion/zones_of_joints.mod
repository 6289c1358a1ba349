! RAPID Instructions, WZHomeJointDef and WZLimJointDef: zones of axis positions, not of places.
MODULE zones_of_joints
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget least:=[[-10,-90,-90,-90,-90,-90],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget most:=[[10,90,90,90,90,90],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget about:=[[2,2,2,2,2,2],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR wztemporary home;
  VAR wztemporary turned;
  VAR signaldo doHome;
  VAR signaldo doTurned;

  PROC main()
    VAR shapedata near;
    VAR shapedata far;
    AliasIO "doHome",doHome;
    AliasIO "doTurned",doTurned;
    MoveJ p1,v500,fine,tool0;
    WZHomeJointDef\Inside,near,CJointT(),about;
    WZDOSet\Temp,home\Inside,near,doHome,1;
    WZLimJointDef\Outside,far,least,most;
    WZDOSet\Temp,turned\Inside,far,doTurned,1;
    WaitTime 0.1;
    TPWrite ValToStr(DOutput(doHome))+ValToStr(DOutput(doTurned)); ! -> 10
    MoveL Offs(p1,0,300,0),v200,fine,tool0;
    TPWrite ValToStr(DOutput(doHome))+ValToStr(DOutput(doTurned)); ! -> 01
  ENDPROC
ENDMODULE

! RAPID Instructions, PathLengthStart: a counter of what the TCP travels, on and off.
MODULE path_length
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget aside:=[[90,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget p;
  VAR pos here;
  VAR num length;

  PROC main()
    TPWrite ValToStr(PathLengthGet());      ! -> 0
    MoveAbsJ home,v500,fine,tool0;
    TPWrite ValToStr(PathLengthGet());      ! -> 0
    p:=CRobT();
    PathLengthReset;
    PathLengthStart;
    MoveL Offs(p,0,100,0),v200,fine,tool0;
    MoveL Offs(p,0,50,0),v200,fine,tool0;
    ! Back and forth both count.
    TPWrite ValToStr(Round(PathLengthGet()\Dec:=3)); ! -> 150
    ! A turn without travel does not.
    MoveL RelTool(Offs(p,0,50,0),0,0,0\Rz:=20),v200,fine,tool0;
    TPWrite ValToStr(Round(PathLengthGet()\Dec:=3)); ! -> 150
    PathLengthStop;
    MoveL p,v200,fine,tool0;
    TPWrite ValToStr(Round(PathLengthGet()\Dec:=3)); ! -> 150
    ! Start continues with the value it had.
    PathLengthStart;
    MoveL Offs(p,0,0,-20),v200,fine,tool0;
    TPWrite ValToStr(Round(PathLengthGet()\Dec:=3)); ! -> 170
    ! Reset leaves the counter on.
    PathLengthReset;
    TPWrite ValToStr(PathLengthGet());      ! -> 0
    MoveL Offs(p,0,0,0),v200,fine,tool0;
    TPWrite ValToStr(Round(PathLengthGet()\Dec:=3)); ! -> 20
    ! A quarter turn of axis 1 alone: the arc that the TCP draws.
    MoveAbsJ home,v500,fine,tool0;
    here:=CPos(\Tool:=tool0\WObj:=wobj0);
    PathLengthReset;
    MoveAbsJ aside,v500,fine,tool0;
    TPWrite ValToStr(Abs(PathLengthGet()-3.14159265*here.x/2)<0.01); ! -> TRUE
    ! A corner that is cut is shorter.
    MoveAbsJ home,v500,fine,tool0;
    PathLengthReset;
    MoveL Offs(p,0,100,0),v200,z20,tool0;
    MoveL Offs(p,0,100,-100),v200,fine,tool0;
    length:=PathLengthGet();
    TPWrite ValToStr(length>180 AND length<199); ! -> TRUE
  ENDPROC
ENDMODULE

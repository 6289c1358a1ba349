! RAPID Functions, PathLengthGet: read while the robot moves, and switched within a fly-by path.
MODULE path_length_on_the_way
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget p;
  VAR pos start;
  VAR intnum underway;
  VAR num reads;

  PROC main()
    MoveAbsJ home,v500,fine,tool0;
    p:=CRobT();
    start:=p.trans;
    PathLengthStart;
    CONNECT underway WITH look;
    ITimer 0.2,underway;
    MoveL Offs(p,0,200,0),v200,fine,tool0;
    IDelete underway;
    TPWrite ValToStr(reads>3);              ! -> TRUE
    ! The program is ahead of the robot: after a fly-by move it goes on when the robot begins that.
    PathLengthStop;
    PathLengthReset;
    MoveL Offs(p,0,100,0),v200,z0,tool0;
    PathLengthStart;
    MoveL Offs(p,0,0,0),v200,fine,tool0;
    TPWrite ValToStr(Abs(PathLengthGet()-200)<1); ! -> TRUE
  ENDPROC

  TRAP look
    ! The length travelled is the distance from where the line began.
    IF Abs(PathLengthGet()-Distance(CPos(\Tool:=tool0\WObj:=wobj0),start))<0.05 Incr reads;
  ENDTRAP
ENDMODULE

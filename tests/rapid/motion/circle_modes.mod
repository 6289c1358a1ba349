! RAPID Instructions, CirPathMode: who leads the orientation on an arc.
MODULE circle_modes
  CONST robtarget start:=[[1000,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget top:=[[900,100,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget last:=[[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfL \Off;
    CirPathMode \ObjectFrame;
    arc;
    TPWrite "object frame";   ! -> object frame
    CirPathMode \CirPointOri;
    arc;
    TPWrite "circle point";   ! -> circle point
    CirPathMode \PathFrame;
    arc;
    TPWrite "path frame";     ! -> path frame
  ENDPROC

  PROC arc()
    MoveJ start,v500,fine,tool0;
    MoveC top,last,v200,fine,tool0;
  ENDPROC
ENDMODULE

! RAPID Overview, Stationary TCPs: the robot brings the work object to a tool that stands.
MODULE stationary_tool
  PERS tooldata glue:=[FALSE,[[900,0,700],[0,1,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  PERS wobjdata part:=[TRUE,TRUE,"",[[0,0,50],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget p:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget here;

  PROC main()
    ConfJ \Off;
    ConfL \Off;
    MoveJ p,v500,fine,glue\WObj:=part;
    MoveL Offs(p,50,0,0),v100,z5,glue\WObj:=part;
    MoveC Offs(p,75,25,0),Offs(p,50,50,0),v100,z5,glue\WObj:=part;
    MoveL Offs(p,0,50,0),v100,fine,glue\WObj:=part;
    here:=CRobT(\Tool:=glue\WObj:=part);
    TPWrite "on the part "\Pos:=[Round(here.trans.x),Round(here.trans.y),Round(here.trans.z)];  ! -> on the part [0,50,0]
    ! The tool stands 700 mm above the floor, pointing down; the flange is 50 mm over it.
    here:=CRobT(\Tool:=tool0\WObj:=wobj0);
    TPWrite "flange "\Num:=Round(here.trans.z);   ! -> flange 750
  ENDPROC
ENDMODULE

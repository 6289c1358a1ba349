MODULE example
  CONST robtarget p10:=[[0.6,0,0.6],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  PERS tooldata gripper:=[TRUE,[[0,0,0.12],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]]; ! found
  CONST jointtarget home:=[[0,-1.5708,1.5708,0,0.5,0],[9E9,9E9,9E9,9E9,9E9,9E9]];    ! found
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget p20;
  VAR orient turned;
  PROC main()
    MoveAbsJ home,v500,fine,gripper;
    MoveL Offs([[0.6,0,0.6],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],0,0,50),v500,fine,gripper\WObj:=wobj0; ! found
    MoveL RelTool(p10,0,0,0\Rz:=3.1416),v500,fine,gripper;  ! found
    p20:=RelTool(p10,0,0,0\Rx:=-pi/2);                     ! found
    turned:=OrientZYX(0,pi*reg1/180,0);                    ! found
    reg1:=100*Sin(2*pi*reg2);                              ! found
  ENDPROC
ENDMODULE
! ---
MODULE slow
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST speeddata gentle:=[0.25,500,5000,1000]; ! found
  PROC main()
    MoveJ p10,gentle,fine,tool0;
    MoveL Offs(p10,50,0,0),v100\V:=0.1,fine,tool0; ! found
    MoveL p10,[0.2,500,5000,1000],fine,tool0;      ! found
  ENDPROC
ENDMODULE

! RAPID Functions, RelTool: the tool turns about its tip, at the programmed reorientation speed.
MODULE pure_reorientation
  CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST speeddata slow:=[200,30,5000,1000];
  VAR clock watch;
  VAR robtarget here;

  PROC main()
    ConfL \Off;
    MoveJ p,v500,fine,tool0;
    ClkStart watch;
    MoveL RelTool(p,0,0,0\Rz:=60),slow,fine,tool0;
    ClkStop watch;
    here:=CRobT(\Tool:=tool0\WObj:=wobj0);
    TPWrite "moved "\Num:=Round(Distance(here.trans,p.trans)\Dec:=3);  ! -> moved 0
    ! 60 degrees at 30 deg/s are 2 s, and the ramps.
    TPWrite "as slow as said: "\Bool:=ClkRead(watch)>2 AND ClkRead(watch)<2.4;  ! -> as slow as said: TRUE
  ENDPROC
ENDMODULE

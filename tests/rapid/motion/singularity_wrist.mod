! RAPID Instructions, SingArea: with \Wrist the wrist axes are interpolated, the TCP keeps its line.
MODULE singularity_wrist
  VAR robtarget above;
  VAR robtarget below;
  VAR robtarget here;

  PROC main()
    MoveAbsJ [[0,0,0,0,15,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
    above:=CRobT(\Tool:=tool0\WObj:=wobj0);
    below:=CalcRobT([[0,10,0,0,-15,0],[9E9,9E9,9E9,9E9,9E9,9E9]],tool0);
    SingArea \Wrist;
    MoveL below,v200,z10,tool0;
    MoveL above,v200,fine,tool0;
    here:=CRobT(\Tool:=tool0\WObj:=wobj0);
    TPWrite "back within "\Num:=Round(Distance(here.trans,above.trans)\Dec:=3);  ! -> back within 0
  ENDPROC
ENDMODULE

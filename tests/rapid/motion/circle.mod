! RAPID Instructions, MoveC: a full circle takes two arcs, and comes back to where it began.
MODULE circle
  CONST robtarget start:=[[1000,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget here;

  PROC main()
    MoveJ start,v500,fine,tool0;
    MoveC Offs(start,-100,100,0),Offs(start,-200,0,0),v200,z10,tool0;
    MoveC Offs(start,-100,-100,0),start,v200,fine,tool0;
    here:=CRobT(\Tool:=tool0\WObj:=wobj0);
    TPWrite "back within "\Num:=Round(Distance(here.trans,start.trans)\Dec:=3);  ! -> back within 0
  ENDPROC
ENDMODULE

! RAPID Overview, Positioning during program execution: another tool in a corner needs no stop.
MODULE tool_change
  PERS tooldata short:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  PERS tooldata long:=[TRUE,[[0,0,250],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  CONST robtarget p:=[[900,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget here;

  PROC main()
    ConfL \Off;
    ConfJ \Off;
    MoveJ p,v500,fine,short;
    MoveL Offs(p,0,200,0),v300,z20,short;
    MoveL Offs(p,-100,200,0),v300,fine,long;
    here:=CRobT(\Tool:=long\WObj:=wobj0);
    TPWrite "at "\Pos:=[Round(here.trans.x),Round(here.trans.y),Round(here.trans.z)];  ! -> at [800,200,500]
  ENDPROC
ENDMODULE

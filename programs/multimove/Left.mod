MODULE Left
  ! Two robots carry a beam: they meet, move together, and each goes its own way again.
  !
  !   rapidsim run programs/multimove/Left.mod

  PERS tasks both{2}:=[["T_LEFT"],["T_RIGHT"]];
  VAR syncident carry;
  VAR syncident apart;

  TASK PERS tooldata tGrip:=[TRUE,[[0,0,150],[1,0,0,0]],[3,[0,0,70],[1,0,0,0],0,0,0.01]];
  TASK PERS wobjdata wTable:=[FALSE,TRUE,"",[[800,0,300],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  CONST robtarget pEnd:=[[-150,0,100],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    MoveJ Offs(pEnd,0,0,200), v1000, z50, tGrip\WObj:=wTable;
    MoveL pEnd, v300, fine, tGrip\WObj:=wTable;
    SyncMoveOn carry, both;
    MoveL Offs(pEnd,0,0,250)\ID:=10, v200, z50, tGrip\WObj:=wTable;
    MoveL Offs(pEnd,0,250,250)\ID:=20, v200, z50, tGrip\WObj:=wTable;
    MoveL Offs(pEnd,0,250,50)\ID:=30, v200, fine, tGrip\WObj:=wTable;
    SyncMoveOff apart;
    MoveL Offs(pEnd,0,250,250), v500, fine, tGrip\WObj:=wTable;
  ENDPROC
ENDMODULE

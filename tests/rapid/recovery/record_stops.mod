! RAPID Instructions, PathRecStop: what is driven after it is no part of the record.
MODULE record_stops
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR pathrecid begin;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    MoveL Offs(p1,0,20,0),v500,fine,tool0;
    PathRecStart begin;
    MoveL p2,v500,fine,tool0;
    PathRecStop;
    StorePath;
    TPWrite "back "\Bool:=PathRecValidBwd();     ! -> back TRUE
    PathRecMoveBwd;
    TPWrite "at "\Pos:=CPos(\Tool:=tool0);       ! -> at [700,20,600]
    RestoPath;
    StartMove;
  ENDPROC
ENDMODULE

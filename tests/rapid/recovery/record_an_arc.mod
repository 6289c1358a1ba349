! RAPID Instructions, PathRecMoveBwd: an arc is gone back on as an arc.
MODULE record_an_arc
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR pathrecid begin;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    PathRecStart begin;
    MoveC Offs(p1,100,100,0),p2,v200,fine,tool0;
    StorePath;
    PathRecMoveBwd;
    TPWrite "at "\Pos:=here();       ! -> at [700,0,600]
    PathRecMoveFwd;
    TPWrite "at "\Pos:=here();       ! -> at [700,200,600]
    RestoPath;
    StartMove;
  ENDPROC
  FUNC pos here()
    VAR pos now;
    now:=CPos(\Tool:=tool0);
    RETURN [Round(now.x),Round(Abs(now.y)),Round(now.z)];
  ENDFUNC
ENDMODULE

! RAPID Instructions, PathRecMoveBwd: \ToolOffs keeps the tool off the path by so much.
MODULE record_with_an_offset
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR pathrecid begin;
  VAR pathrecid middle;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    PathRecStart begin;
    MoveL p2,v500,fine,tool0;
    PathRecStart middle;
    MoveL Offs(p2,100,0,0),v500,fine,tool0;
    StorePath;
    PathRecMoveBwd \ID:=middle \ToolOffs:=[0,0,-20];
    TPWrite "middle "\Pos:=CPos(\Tool:=tool0);   ! -> middle [700,200,620]
    PathRecMoveBwd \Speed:=v1000;
    TPWrite "begin "\Pos:=CPos(\Tool:=tool0);    ! -> begin [700,0,600]
    PathRecMoveFwd \ID:=middle;
    TPWrite "middle "\Pos:=CPos(\Tool:=tool0);   ! -> middle [700,200,600]
    PathRecMoveFwd;
    TPWrite "end "\Pos:=CPos(\Tool:=tool0);      ! -> end [800,200,600]
    RestoPath;
    StartMove;
  ENDPROC
ENDMODULE

! RAPID Instructions, PathRecMoveBwd: back on the recorded path, and forth to where it was left.
MODULE record_back_and_forth
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR pathrecid begin;
  VAR intnum trouble;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    PathRecStart begin;
    MoveL p2,v500,z10,tool0;
    MoveL Offs(p2,100,0,0),v500,fine,tool0;
    CONNECT trouble WITH on_trouble;
    ITimer \Single,0.5,trouble;
    MoveL Offs(p2,100,100,0),v100,fine,tool0;
    TPWrite "end "\Pos:=CPos(\Tool:=tool0);      ! -> end [800,300,600]
  ENDPROC

  TRAP on_trouble
    VAR pos left_at;
    StopMove;
    StorePath;
    left_at:=CPos(\Tool:=tool0);
    TPWrite "back "\Bool:=PathRecValidBwd(\ID:=begin);      ! -> back TRUE
    TPWrite "forth "\Bool:=PathRecValidFwd();    ! -> forth FALSE
    PathRecMoveBwd \ID:=begin;
    TPWrite "at "\Pos:=CPos(\Tool:=tool0);       ! -> at [700,0,600]
    TPWrite "forth "\Bool:=PathRecValidFwd();    ! -> forth TRUE
    PathRecMoveFwd;
    TPWrite "off by "\Num:=Round(Distance(left_at,CPos(\Tool:=tool0))\Dec:=2);      ! -> off by 0
    RestoPath;
    StartMove;
  ENDTRAP
ENDMODULE

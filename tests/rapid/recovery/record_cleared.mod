! RAPID Instructions, PathRecStop: \Clear forgets the path, and there is no way back any more.
MODULE record_cleared
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR pathrecid begin;
  VAR pathrecid never;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    TPWrite "back "\Bool:=PathRecValidBwd();     ! -> back FALSE
    PathRecStart begin;
    MoveL p2,v500,fine,tool0;
    TPWrite "back "\Bool:=PathRecValidBwd();     ! -> back TRUE
    TPWrite "never set "\Bool:=PathRecValidBwd(\ID:=never); ! -> never set FALSE
    PathRecStop \Clear;
    TPWrite "back "\Bool:=PathRecValidBwd();     ! -> back FALSE
    StorePath;
    PathRecMoveBwd;
  ERROR
    TPWrite "path "\Bool:=ERRNO=ERR_PATH;        ! -> path TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE

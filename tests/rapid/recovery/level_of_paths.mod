! RAPID Functions, PathLevel: 1 on the program's own path, one more for each that is stored.
MODULE level_of_paths
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ p1,v500,fine,tool0;
    TPWrite "level "\Num:=PathLevel();  ! -> level 1
    StorePath;
    TPWrite "level "\Num:=PathLevel();  ! -> level 2
    MoveL p2,v500,fine,tool0;
    MoveL p1,v500,fine,tool0;
    RestoPath;
    TPWrite "level "\Num:=PathLevel();  ! -> level 1
    StartMove;
  ENDPROC
ENDMODULE

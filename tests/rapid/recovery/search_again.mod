! RAPID Instructions, SearchL: without a hit the robot goes back, forgets its path and searches again.
MODULE search_again
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS bool felt:=FALSE;
  VAR robtarget found;
  VAR num tries;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    find;
    TPWrite "tries "\Num:=tries;        ! -> tries 2
    TPWrite "at "\Pos:=here();       ! -> at [700,0,600]
  ENDPROC

  PROC find()
    SearchL \PStop,felt,found,p2,v200,tool0;
  ERROR
    IF ERRNO=ERR_WHLSEARCH THEN
      Incr tries;
      TPWrite "nothing at "\Pos:=here();
      ! -> nothing at [700,200,600]
      ! -> nothing at [700,200,600]
      StopMove;
      StorePath;
      MoveL p1,v500,fine,tool0;
      RestoPath;
      ClearPath;
      StartMove;
      IF tries<2 RETRY;
      TRYNEXT;
    ENDIF
  ENDPROC
  FUNC pos here()
    VAR pos now;
    now:=CPos(\Tool:=tool0);
    RETURN [Round(now.x),Round(Abs(now.y)),Round(now.z)];
  ENDFUNC
ENDMODULE

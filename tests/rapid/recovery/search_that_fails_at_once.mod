! RAPID Instructions, SearchL: a persistent that is set already, and one that never is.
MODULE search_that_fails_at_once
  CONST robtarget p1:=[[600,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS bool felt:=TRUE;
  VAR robtarget found;

  PROC main()
    MoveJ p1,v1000,fine,tool0;
    search;
    felt:=FALSE;
    search;
  ENDPROC

  PROC search()
    SearchL\Stop,felt,found,Offs(p1,0,50,0),v100,tool0;
    TPWrite "never";
  ERROR
    TEST ERRNO
    CASE ERR_PERSSUPSEARCH:
      TPWrite "set already at "\Pos:=CPos(\Tool:=tool0);        ! -> set already at [600,0,800]
    CASE ERR_WHLSEARCH:
      TPWrite "nothing up to "\Pos:=CPos(\Tool:=tool0);        ! -> nothing up to [600,50,800]
    ENDTEST
    ClearPath;
    StartMove;
    RETURN;
  ENDPROC
ENDMODULE

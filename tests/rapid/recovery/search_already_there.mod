! RAPID Instructions, SearchL: what is there already when the search begins is an error of its own.
MODULE search_already_there
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS bool felt:=TRUE;
  VAR robtarget found;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    SearchL \PStop,felt,found,p2,v200,tool0;
    TPWrite "at "\Num:=Round(moved());  ! -> at 0
  ERROR
    TPWrite "there "\Bool:=ERRNO=ERR_PERSSUPSEARCH;         ! -> there TRUE
    TRYNEXT;
  ENDPROC

  FUNC num moved()
    VAR pos now;
    now:=CPos(\Tool:=tool0);
    RETURN now.y;
  ENDFUNC
ENDMODULE
